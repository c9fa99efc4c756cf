// The parameters of a scene element, as a table: each type lists its own, and one reader serves them all.
//
//   struct Sphere {
//     struct Parameters { Vec3d center; double radius = 0; };
//     static Fields fields() {
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
#include <utility>
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
  temperature,   ///< numbers: of a black body (math/blackbody.h)
  identifier,    ///< references: letters, digits, _ and -; or none
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
  bool prefers_alpha = false;      ///< of a texture without a channel: alpha where it has it, else red
  /// Of a number that means nothing without a texture: the attribute beside the texture's that it stands in.
  std::string_view number_attribute{};
  bool whole_color = false;  ///< it takes the texture's colour, and no channel of it
  bool is_constant = false;  ///< of a material's number: no texture may multiply it

  /// Whether there is nothing to say of it without a texture.
  bool is_of_texture() const { return whole_color || !number_attribute.empty(); }
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

/// A field's value in the parameters of some type, whichever its own.
using FieldValue = std::variant<double*, int*, bool*, ChoiceReference, Vec3d*, Vec2d*, Rgb<double>*, FileName*,
                                NumberGroups*, WordOrGroups*, Reference*>;

/// The same, and where its value is. It knows the member by its offset, so that what reads, checks and prints
/// parameters is one function for all types.
/// double, int, bool, FileName, Reference, NumberGroups, WordOrGroups, enumerations with Choices: the element's text.
/// Vec3d, Vec2d and Rgb: attributes (see Components).
class Field : public FieldInfo {
 public:
  template <class Parameters, class Value>
  Field(const FieldInfo& info, Value Parameters::* member)
      : FieldInfo(info), offset_(offset_of(member)), value_at_(&value_at<Value>), index_(index_of<Value>()) {
    if constexpr (HasChoices<Value>) words_ = Choices<Value>::words;
  }

  // parameters: of the type whose field this is.

  FieldValue value(void* parameters) const { return value_at_(static_cast<std::byte*>(parameters) + offset_); }

  /// visit(a reference to the value), which of a choice is a ChoiceReference; what it returns.
  template <class Visit>
  decltype(auto) visit(void* parameters, const Visit& visit) const {
    return std::visit(
        [&]<class Any>(const Any& any) -> decltype(auto) {
          if constexpr (std::is_same_v<Any, ChoiceReference>)
            return visit(any);
          else
            return visit(*any);
        },
        value(parameters));
  }
  /// The same of a value that does not change.
  template <class Visit>
  decltype(auto) visit(const void* parameters, const Visit& visit) const {
    return this->visit(const_cast<void*>(parameters),
                       [&]<class Value>(Value& value) -> decltype(auto) { return visit(std::as_const(value)); });
  }

  template <class Value>
  bool is() const {
    return index_ == index_of<Value>();
  }
  /// The value, which is of that type.
  template <class Value>
  Value& get(void* parameters) const {
    return *reinterpret_cast<Value*>(static_cast<std::byte*>(parameters) + offset_);
  }

  /// Whether a texture may multiply the field of a material: one number, or a colour.
  bool may_be_textured() const { return !is_constant && (is<double>() || is<Rgb<double>>()); }
  std::size_t offset() const { return offset_; }
  /// Of an enumeration; none of others.
  std::span<const std::string_view> words() const { return words_; }

 private:
  /// In FieldValue.
  template <class Value>
  static constexpr std::size_t index_of() {
    if constexpr (HasChoices<Value>)
      return 3;
    else
      return FieldValue(static_cast<Value*>(nullptr)).index();
  }
  static_assert(std::is_same_v<std::variant_alternative_t<3, FieldValue>, ChoiceReference>);

  template <class Value>
  static FieldValue value_at(std::byte* at) {
    auto* const value = reinterpret_cast<Value*>(at);
    if constexpr (HasChoices<Value>)
      return ChoiceReference(*value);
    else
      return value;
  }

  template <class Parameters, class Value>
  static std::size_t offset_of(Value Parameters::* member) {
    alignas(Parameters) static constexpr std::byte storage[sizeof(Parameters)] = {};
    const auto* const parameters = reinterpret_cast<const Parameters*>(storage);
    return static_cast<std::size_t>(reinterpret_cast<const std::byte*>(&(parameters->*member)) - storage);
  }

  std::size_t offset_;
  FieldValue (*value_at_)(std::byte* at);
  std::size_t index_;
  std::span<const std::string_view> words_;
};

using Fields = std::vector<Field>;

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

template <class Parameters, class Value>
Field required(std::string_view name, Value Parameters::* member, Range range = Range::any) {
  return {FieldInfo{name, true, range}, member};
}

template <class Parameters, class Value>
Field optional(std::string_view name, Value Parameters::* member, Range range = Range::any) {
  return {FieldInfo{name, false, range}, member};
}

/// The same of a number or colour that textures do not multiply.
template <class Parameters, class Value>
Field constant(std::string_view name, Value Parameters::* member, Range range = Range::any) {
  FieldInfo info{name, false, range};
  info.is_constant = true;
  return {info, member};
}

// The same of a point: required("center", &Parameters::center, a_point).

inline constexpr struct PointTag {
} a_point;

template <class Parameters>
Field required(std::string_view name, Vec3d Parameters::* member, PointTag) {
  return {{name, true, Range::any, true}, member};
}

template <class Parameters>
Field optional(std::string_view name, Vec3d Parameters::* member, PointTag) {
  return {{name, false, Range::any, true}, member};
}

/// Of a scene file alone: it may have this one in place of the required field `other`, which the reader then sets by
/// it. A type lists such fields in shorthands(); descriptions are printed and checked without them.
template <class Parameters, class Value>
Field shorthand(std::string_view name, Value Parameters::* member, Range range, std::string_view other) {
  return {{name, false, range, false, other}, member};
}

/// All fields that scene files may have.
template <class Type>
Fields fields_in_files() {
  Fields fields = Type::fields();
  if constexpr (requires { Type::shorthands(); })
    for (const Field& field : Type::shorthands()) fields.push_back(field);
  return fields;
}

/// Those of a type that are points.
template <class Type>
Fields point_fields() {
  Fields fields = Type::fields();
  std::erase_if(fields, [](const Field& field) { return !field.is_point; });
  return fields;
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

/// What scenes may have but hardly mean, and what to write instead. A type that has such declares
/// `static std::vector<ParameterWarning> warnings(const Parameters&, const IsTextured&)` for parameters without errors.
struct ParameterWarning {
  std::string_view field;
  std::string message;
};
/// Whether the field of that name has a texture.
using IsTextured = std::function<bool(std::string_view field)>;

/// What readers, checkers and printers know of a type of elements.
struct ElementType {
  std::string_view element;
  Fields fields;
  Fields fields_in_files;
  /// Null: any parameters go together.
  std::optional<ParameterDiagnostic> (*check)(const void* parameters) = nullptr;
  /// Null: there are none.
  std::vector<ParameterWarning> (*warnings)(const void* parameters, const IsTextured& is_textured) = nullptr;
};

template <class Type>
const ElementType& element_type() {
  static const ElementType type = [] {
    ElementType made{Type::element, Type::fields(), fields_in_files<Type>()};
    if constexpr (requires(const typename Type::Parameters& parameters) { Type::check(parameters); })
      made.check = [](const void* parameters) {
        return Type::check(*static_cast<const typename Type::Parameters*>(parameters));
      };
    if constexpr (requires { &Type::warnings; })
      made.warnings = [](const void* parameters, const IsTextured& is_textured) {
        return Type::warnings(*static_cast<const typename Type::Parameters*>(parameters), is_textured);
      };
    return made;
  }();
  return type;
}

}  // namespace raytrace
