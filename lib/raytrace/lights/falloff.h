// How the light of a point grows weaker with distance.
#pragma once

#include <optional>
#include <string>

#include "raytrace/parameters/fields.h"

namespace raytrace {

/// The values of <falloff>. "none": the same radiance at every distance, as in the seed. "inversesquare": divided by
/// the square of the distance, as light does.
inline constexpr std::string_view falloff_none = "none", falloff_inverse_square = "inversesquare";

inline std::optional<ParameterDiagnostic> check_falloff(const std::string& falloff) {
  if (falloff == falloff_none || falloff == falloff_inverse_square) return std::nullopt;
  return ParameterDiagnostic{ParameterDiagnostic::Effect::error,
                             "its <falloff> '" + falloff + "' is unknown; write none or inversesquare"};
}

}  // namespace raytrace
