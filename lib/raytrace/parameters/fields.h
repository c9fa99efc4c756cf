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
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "raytrace/math/color.h"
#include "raytrace/math/vec2.h"
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
  std::string_view in_place_of{};  ///< of a shorthand: the required field that it stands for
};

/// An enumeration that fields may have: the words that scene files spell its values with, in their order from 0.
///
///   enum class Falloff { none, inverse_square };
///   template <>
///   struct Choices<Falloff> {
///     static constexpr std::array<std::string_view, 2> words = {"none", "inversesquare"};
///   };
template <class Value>
struct Choices;
template <class Value>
concept HasChoices = requires { Choices<Value>::words; };

/// A reference to a value of such an enumeration, whichever it is.
class ChoiceReference {
 public:
  template <HasChoices Value>
  explicit ChoiceReference(Value& value) : value_(&value), type_(&type_of<Value>) {}

  std::span<const std::string_view> words() const { return type_->words; }
  /// Of the value's word; of a value that is none of the enumeration's, beyond them.
  std::size_t index() const { return type_->get(value_); }
  void set(std::size_t index) const { type_->set(value_, index); }

 private:
  struct Type {
    std::span<const std::string_view> words;
    std::size_t (*get)(const void* value);
    void (*set)(void* value, std::size_t index);
  };
  template <class Value>
  static constexpr Type type_of = {
      Choices<Value>::words,
      [](const void* value) { return static_cast<std::size_t>(*static_cast<const Value*>(value)); },
      [](void* value, std::size_t index) { *static_cast<Value*>(value) = static_cast<Value>(index); }};

  void* value_;
  const Type* type_;
};

/// The name of a file that a scene reads. The scene's file gives it relative to its own folder; here it is as the
/// program opens it.
struct FileName {
  std::string path;
  std::uint32_t line = 0, column = 0;  ///< where the scene's file has it; 0: nowhere

  friend bool operator==(const FileName& a, const FileName& b) { return a.path == b.path; }
};

/// The name of something else in the scene.
struct Reference {
  std::string name;
  std::uint32_t line = 0, column = 0;  ///< where the scene's file has it; 0: nowhere

  friend bool operator==(const Reference& a, const Reference& b) { return a.name == b.name; }
};

/// Numbers in groups, such as the corners of faces: white space between the numbers, commas between the groups.
struct NumberGroups {
  std::vector<double> numbers;
  std::vector<std::uint32_t> ends;  ///< of each group, among the numbers; no group is empty

  bool empty() const { return numbers.empty(); }
  friend bool operator==(const NumberGroups&, const NumberGroups&) = default;
};

/// One of some words, or numbers in place of it.
struct WordOrGroups {
  std::span<const std::string_view> words;
  std::size_t word = 0;  ///< index in words; where there are numbers, it does not count
  NumberGroups groups = {};

  friend bool operator==(const WordOrGroups& a, const WordOrGroups& b) {
    return a.groups == b.groups && (!a.groups.empty() || a.word == b.word);
  }
};

/// The same, and where its value goes.
/// double, int, bool, FileName, Reference, NumberGroups, WordOrGroups, enumerations with Choices: the element's text.
/// Vec3d, Vec2d and Rgb: attributes (see Components).
template <class Parameters>
struct Field : FieldInfo {
  using Choice = std::function<ChoiceReference(Parameters&)>;
  using Member = std::variant<double Parameters::*, int Parameters::*, bool Parameters::*, Choice, Vec3d Parameters::*,
                              Vec2d Parameters::*, Rgb<double> Parameters::*, FileName Parameters::*,
                              NumberGroups Parameters::*, WordOrGroups Parameters::*, Reference Parameters::*>;
  Member member;

  template <class Value>
  Field(const FieldInfo& info, Value Parameters::* value) : FieldInfo(info) {
    if constexpr (HasChoices<Value>)
      member = Choice([value](Parameters& parameters) { return ChoiceReference(parameters.*value); });
    else
      member = value;
  }

  /// visit(a reference to the value), which of a choice is a ChoiceReference; what it returns. parameters: may be
  /// constant, if `visit` sets no choice.
  template <class AnyParameters, class Visit>
  decltype(auto) visit(AnyParameters& parameters, const Visit& visit) const {
    return std::visit(
        [&]<class Any>(const Any& any) -> decltype(auto) {
          if constexpr (std::is_same_v<Any, Choice>)
            return visit(any(const_cast<Parameters&>(parameters)));
          else
            return visit(parameters.*any);
        },
        member);
  }
};

/// Whether a texture that multiplies the field gives one number, and no colour.
template <class Parameters>
bool is_number(const Field<Parameters>& field) {
  return std::holds_alternative<double Parameters::*>(field.member);
}

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
struct Components<Vec2d> {
  static constexpr std::array<std::string_view, 2> names = {"x", "y"};
  static constexpr std::array members = {&Vec2d::x, &Vec2d::y};
};
template <>
struct Components<Rgb<double>> {
  static constexpr std::array<std::string_view, 3> names = {"red", "green", "blue"};
  static constexpr std::array members = {&Rgb<double>::red, &Rgb<double>::green, &Rgb<double>::blue};
};
template <class Value>
concept HasComponents = requires { Components<Value>::names; };

/// Whether a material's field of this type may be multiplied by a texture.
template <class Value>
inline constexpr bool may_be_textured = std::is_same_v<Value, double> || std::is_same_v<Value, Rgb<double>>;

template <class Parameters, class Value>
Field<Parameters> required(std::string_view name, Value Parameters::* member, Range range = Range::any) {
  return {FieldInfo{name, true, range}, member};
}

template <class Parameters, class Value>
Field<Parameters> optional(std::string_view name, Value Parameters::* member, Range range = Range::any) {
  return {FieldInfo{name, false, range}, member};
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

/// Of a scene file alone: it may have this one in place of the required field `other`, which the reader then sets by
/// it. A type lists such fields in shorthands(); descriptions are printed and checked without them.
template <class Parameters, class Value>
Field<Parameters> shorthand(std::string_view name, Value Parameters::* member, Range range, std::string_view other) {
  return {{name, false, range, false, other}, member};
}

/// All fields that scene files may have.
template <class Type>
Fields<typename Type::Parameters> fields_in_files() {
  Fields<typename Type::Parameters> fields = Type::fields();
  if constexpr (requires { Type::shorthands(); })
    for (const auto& field : Type::shorthands()) fields.push_back(field);
  return fields;
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
