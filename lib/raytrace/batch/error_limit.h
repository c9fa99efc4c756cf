// When a picture has as little noise as was asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "raytrace/batch/passes.h"

namespace raytrace {

class ErrorLimit {
 public:
  /// RenderJob::error_limit
  explicit ErrorLimit(const std::optional<double>& most) : most_(most) {}

  /// Whether `done` samples per pixel are enough. Of a few, the estimate knows little.
  bool is_reached(const ErrorOfPasses& error, std::uint32_t done) const;

  /// About which part of the samples that it takes there are, while a pass goes on of which this is known; 0 where
  /// nothing is.
  double share(const ErrorOfPasses& error, const ErrorEstimate& pass) const;

  /// What there is to say once all samples were rendered and it was not reached; none without a limit.
  std::optional<std::string> warning(const ErrorOfPasses& error) const;

 private:
  std::optional<double> most_;
};

}  // namespace raytrace
