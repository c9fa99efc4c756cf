// The parameters of a scene element, as a table: each type lists its own, and one reader serves them all.
//
//   struct Sphere {
//     struct Parameters { Vec3d center; double radius = 0; };
//     static Fields<Parameters> fields() {
//       return {required("center", &Parameters::center), required("radius", &Parameters::radius, Range::positive)};
//     }
//   };
//
// The reader (description/read_fields.h) turns child elements into the members, and reports every unknown, repeated,
// missing or malformed child with its file, line and column. The default of an optional member is its initialiser.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "raytrace/math/color.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

/// Which values a field takes. Whatever the range: finite numbers, at most `largest_number` in magnitude.
enum class Range {
  any,
  not_negative,  ///< numbers, and each component of vectors and colours: 0 or more
  positive,      ///< the same: at least `smallest_size`; integers: 1 or more
  nonzero,       ///< vectors: a direction, so not all of x, y, z are 0 (or below `smallest_size`)
};

/// Scene coordinates, sizes and coefficients must lie within +-largest_number, so that no float computation on them
/// (bounds up to 3 sizes wide, squares) overflows and Embree's limit of 1.8e18 is kept; sizes are at least
/// smallest_size, so that their squares do not vanish in float.
inline constexpr double largest_number = 1e17;
inline constexpr double smallest_size = 1e-17;

/// One child element: its name and where its value goes.
/// double, int, bool, string: the element's text. Vec3d: attributes x, y, z. Rgb: attributes red, green, blue.
template <class Parameters>
struct Field {
  using Member = std::variant<double Parameters::*, int Parameters::*, bool Parameters::*, std::string Parameters::*,
                              Vec3d Parameters::*, Rgb<double> Parameters::*>;
  std::string_view name;
  Member member;
  bool required;
  Range range;
};

template <class Parameters>
using Fields = std::vector<Field<Parameters>>;

template <class Parameters, class Value>
Field<Parameters> required(std::string_view name, Value Parameters::* member, Range range = Range::any) {
  return {name, member, true, range};
}

template <class Parameters, class Value>
Field<Parameters> optional(std::string_view name, Value Parameters::* member, Range range = Range::any) {
  return {name, member, false, range};
}

/// What a type finds wrong with a combination of its parameters, each of which is fine alone. A type that has such
/// conditions declares `static std::optional<ParameterDiagnostic> check(const Parameters&)`.
struct ParameterDiagnostic {
  enum class Effect {
    error,  ///< the scene is refused
    skip,   ///< objects and lights: a warning, and the thing is left out of the scene; elsewhere an error
  };
  Effect effect;
  std::string message;
};

}  // namespace raytrace
