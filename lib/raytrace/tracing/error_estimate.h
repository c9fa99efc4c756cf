// How far a picture is from its expectation, estimated from its own samples.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace raytrace {

/// The relative mean squared error of pixels (Rousselle et al. 2011): the mean of variance / (mean^2 + 0.01), a pixel's
/// value being the mean of its three channels.
///
/// Of independent samples, half as many have twice the variance; of well distributed ones, more. How much more is
/// taken from the next step down: what quarters of the samples say of their half's variance, beside what the halves say
/// of that of all. Sums are integers, so that the order of pixels changes nothing.
class ErrorEstimate {
 public:
  /// A pixel of that mean. by_halves: the mean's variance, estimated from the difference of halves that are taken for
  /// independent. by_quarters: the same of the means of the halves, from differences of quarters. What is not finite
  /// is left out.
  void add(double mean, double by_halves, double by_quarters) {
    const double square = mean * mean + 0.01;
    if (!std::isfinite(by_halves / square) || !std::isfinite(by_quarters / square)) return;
    halves_ += units_of(by_halves / square);
    quarters_ += units_of(by_quarters / square);
    ++pixels_;
  }

  ErrorEstimate& operator+=(const ErrorEstimate& other) {
    halves_ += other.halves_;
    quarters_ += other.quarters_;
    pixels_ += other.pixels_;
    return *this;
  }

  /// Of a picture of which this is a part: one of its passes, with that share of its samples.
  ErrorEstimate of_pass(double share) const {
    ErrorEstimate part;
    part.halves_ = static_cast<std::uint64_t>(static_cast<double>(halves_) * share * share);
    part.quarters_ = static_cast<std::uint64_t>(static_cast<double>(quarters_) * share * share);
    part.pixels_ = static_cast<std::uint64_t>(std::ceil(static_cast<double>(pixels_) * share));
    return part;
  }

  bool empty() const { return pixels_ == 0; }

  /// The mean; 0 of no pixels.
  double relative_variance() const {
    if (halves_ == 0) return 0;
    const auto halves = static_cast<double>(halves_), quarters = static_cast<double>(quarters_);
    constexpr double least =
        0.25;  // variance falls with the cube of the samples: so it does only where nothing is noisy
    const double correlation = 2 * halves < quarters ? std::max(2 * halves / quarters, least) : 1;
    return correlation * halves / units / static_cast<double>(pixels_);
  }

 private:
  static constexpr double units = 0x1p30;
  static constexpr double most = 4;  ///< what is above 1 says no more than that nothing is known
  static std::uint64_t units_of(double term) { return static_cast<std::uint64_t>(std::min(term, most) * units); }

  std::uint64_t halves_ = 0, quarters_ = 0, pixels_ = 0;
};

}  // namespace raytrace
