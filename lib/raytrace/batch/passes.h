// A picture that is rendered in passes, each of which adds a few samples to all of its pixels.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "raytrace/tracing/error_estimate.h"

namespace raytrace {

/// Of samples that are traced together: of fewer, each would cost more.
inline constexpr std::uint32_t least_pass = 4;

/// How many samples the pass after the first `done` of all adds: early passes are short, so that there is a whole
/// picture soon.
inline std::uint32_t samples_of_pass(std::uint32_t done, std::uint32_t all) {
  constexpr std::uint32_t most = 32;
  return std::min(std::clamp(done, least_pass, most), all - done);
}

/// Those of `samples` that end in time. Fewer than least_pass only where that many do not fit; each of them is taken to
/// cost half as much again.
inline std::uint32_t samples_in_time(std::uint32_t samples, double seconds_left, double seconds_a_sample) {
  const double fitting = seconds_a_sample > 0 ? std::max(0.0, seconds_left / seconds_a_sample)
                         : seconds_left > 0   ? least_pass
                                              : 0.0;
  if (fitting >= samples) return samples;
  const auto whole = static_cast<std::uint32_t>(fitting);
  constexpr double cost_of_few = 1.5;
  return whole >= least_pass ? whole / least_pass * least_pass : static_cast<std::uint32_t>(fitting / cost_of_few);
}

/// The error of a picture, from the estimates of its passes, whose errors are taken for independent.
class ErrorOfPasses {
 public:
  /// Of a part of the pass at hand.
  void add(const ErrorEstimate& part) { pass_ += part; }

  /// The pass at hand has added so many samples to each pixel.
  void end_pass(std::uint32_t samples) {
    const double weight = samples;
    if (!pass_.empty()) {
      variance_ += weight * weight * pass_.relative_variance();
      samples_ += weight;
    }
    pass_ = {};
  }

  /// What is known of the passes that have ended, for another process to go on with.
  struct Sums {
    double variance = 0, samples = 0;
  };
  Sums sums() const { return {variance_, samples_}; }
  void set_sums(const Sums& sums) {
    variance_ = sums.variance;
    samples_ = sums.samples;
  }

  /// The root of the relative mean squared error: of all passes that have ended; or, of the first one, of what it has
  /// rendered, with this more. None where nothing is known.
  std::optional<double> estimate(const ErrorEstimate& more = {}) const {
    if (samples_ > 0) return std::sqrt(variance_) / samples_;
    ErrorEstimate first = pass_;
    first += more;
    return first.empty() ? std::nullopt : std::optional(std::sqrt(first.relative_variance()));
  }

 private:
  ErrorEstimate pass_;
  double variance_ = 0, samples_ = 0;  ///< sums over passes: of samples^2 x relative variance, and of samples
};

}  // namespace raytrace
