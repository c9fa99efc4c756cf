#include "raytrace/batch/error_limit.h"

#include "raytrace/text/message.h"

namespace raytrace {

bool ErrorLimit::is_reached(const ErrorOfPasses& error, std::uint32_t done) const {
  constexpr std::uint32_t least = 16;
  const std::optional<double> estimate = error.estimate();
  return most_ && done >= least && estimate && *estimate <= *most_;
}

double ErrorLimit::share(const ErrorOfPasses& error, const ErrorEstimate& pass) const {
  if (!most_ || error.sums().samples == 0) return 0;
  // Four times the samples have half the error.
  const double ratio = *most_ / error.estimate(pass).value_or(0);
  return ratio < 1 ? ratio * ratio : 0;
}

std::optional<std::string> ErrorLimit::warning(const ErrorOfPasses& error) const {
  if (!most_) return std::nullopt;
  const std::optional<double> estimate = error.estimate();
  if (!estimate) return "the error limit has no effect: of this picture's error nothing is known";
  return formatted("the error is %.3g %% after all samples, above the limit of %.3g %%", 100 * *estimate, 100 * *most_);
}

}  // namespace raytrace
