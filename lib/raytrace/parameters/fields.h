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

#include <array>
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

/// One child element.
struct FieldInfo {
  std::string_view name;
  bool required = true;
  Range range = Range::any;
  bool is_point = false;  ///< of world space: it moves with the world's origin, as no direction, edge or size does
};

/// The same, and where its value goes.
/// double, int, bool, string: the element's text. Vec3d and Rgb: attributes (see Components).
template <class Parameters>
struct Field : FieldInfo {
  using Member = std::variant<double Parameters::*, int Parameters::*, bool Parameters::*, std::string Parameters::*,
                              Vec3d Parameters::*, Rgb<double> Parameters::*>;
  Member member;
};

template <class Parameters>
using Fields = std::vector<Field<Parameters>>;

/// Vectors and colors: their attributes, and the member for each.
template <class Value>
struct Components;
template <>
struct Components<Vec3d> {
  static constexpr std::array<std::string_view, 3> names = {"x", "y", "z"};
  static constexpr std::array members = {&Vec3d::x, &Vec3d::y, &Vec3d::z};
};
template <>
struct Components<Rgb<double>> {
  static constexpr std::array<std::string_view, 3> names = {"red", "green", "blue"};
  static constexpr std::array members = {&Rgb<double>::red, &Rgb<double>::green, &Rgb<double>::blue};
};
template <class Value>
concept HasComponents = requires { Components<Value>::names; };

template <class Parameters, class Value>
Field<Parameters> required(std::string_view name, Value Parameters::* member, Range range = Range::any) {
  return {{name, true, range}, member};
}

template <class Parameters, class Value>
Field<Parameters> optional(std::string_view name, Value Parameters::* member, Range range = Range::any) {
  return {{name, false, range}, member};
}

// The same of a point: required("center", &Parameters::center, a_point).

inline constexpr struct PointTag {
} a_point;

template <class Parameters>
Field<Parameters> required(std::string_view name, Vec3d Parameters::* member, PointTag) {
  return {{name, true, Range::any, true}, member};
}

template <class Parameters>
Field<Parameters> optional(std::string_view name, Vec3d Parameters::* member, PointTag) {
  return {{name, false, Range::any, true}, member};
}

/// The members of a type that are points.
template <class Type>
std::vector<Vec3d Type::Parameters::*> point_members() {
  std::vector<Vec3d Type::Parameters::*> members;
  for (const auto& field : Type::fields())
    if (field.is_point) members.push_back(std::get<Vec3d Type::Parameters::*>(field.member));
  return members;
}

/// Why a combination of a type's parameters, each of which is fine alone, is refused. A type that has such conditions
/// declares `static std::optional<ParameterDiagnostic> check(const Parameters&)`.
struct ParameterDiagnostic {
  enum class Effect {
    error,  ///< the scene is refused
    skip,   ///< objects and lights: a warning, and the thing is left out of the scene; elsewhere an error
  };
  Effect effect;
  std::string message;
};

}  // namespace raytrace
