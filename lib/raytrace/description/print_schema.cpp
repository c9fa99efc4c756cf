#include <algorithm>
#include <climits>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "raytrace/description/include.h"
#include "raytrace/description/keyframes.h"
#include "raytrace/description/parse_value.h"
#include "raytrace/description/read_transform.h"
#include "raytrace/description/scene_description.h"
#include "raytrace/description/scene_layout.h"
#include "raytrace/xml/xml_writer.h"

namespace raytrace {
namespace {

struct RangeLimits {
  std::string_view prefix;  ///< of the types' names
  double least_number;
  int least_integer;
};

RangeLimits limits(Range range) {
  if (range == Range::positive) return {"positive", smallest_size, 1};
  if (range == Range::not_negative) return {"notnegative", 0, 0};
  return {"", -largest_number, INT_MIN};
}

/// Of a number in an attribute.
std::string number_name(Range range) { return std::string(limits(range).prefix) + "number"; }

template <class Value>
std::string type_name(Range range) {
  if constexpr (std::is_same_v<Value, double>) return number_name(range) + "orkeys";
  if constexpr (std::is_same_v<Value, int>) return std::string(limits(range).prefix) + "integer";
  if constexpr (std::is_same_v<Value, Vec3d>) return std::string(limits(range).prefix) + "vector";
  if constexpr (std::is_same_v<Value, Vec2d>) return std::string(limits(range).prefix) + "pair";
  if constexpr (std::is_same_v<Value, Rgb<double>>) return std::string(limits(range).prefix) + "color";
}

std::string type_name(const Field& field) {
  if (field.is<double>()) return type_name<double>(field.range);
  if (field.is<int>()) return type_name<int>(field.range);
  if (field.is<bool>()) return "boolean";
  if (field.is<Vec3d>()) return type_name<Vec3d>(field.range);
  if (field.is<Vec2d>()) return type_name<Vec2d>(field.range);
  if (field.is<Rgb<double>>()) return type_name<Rgb<double>>(field.range);
  return "text";
}

class SchemaPrinter : private XmlWriter {
 public:
  std::string print() {
    line(R"(<?xml version="1.0" encoding="UTF-8"?>)");
    line("<!-- The scene format of raytrace. Made by print_schema() from the registries: do not edit, run the target");
    line("     update_schema instead. docs/ has the meaning of the elements. -->");
    element(R"(xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema" elementFormDefault="qualified")", [&] {
      element(R"(xs:element name="raytracer")", [&] { print_root(); });
      for_each_type(Sections{}, [&]<class Section>(std::type_identity<Section>) { print_section<Section>(); });
      print_item(element_type<ViewPlane>(), {});
      for_each_type(Cameras{}, [&]<class T>(std::type_identity<T>) { print_item(element_type<T>(), {}); });
      element(named("complexType", integrator_element), [&] { print_one_of(Integrators{}); });
      for_each_type(Integrators{}, [&]<class T>(std::type_identity<T>) { print_item(element_type<T>(), {}); });
      print_item(element_type<Include>(), {});
      print_transform();
      print_choice(groups_element, [&] { child(group_element); });
      print_choice(group_element, [&] {
        child("name", "text", true);
        child(ObjectsSection::element);
      });
      print_value_types();
    });
    return take();
  }

 private:
  static constexpr std::string_view any_number_of = R"(xs:choice minOccurs="0" maxOccurs="unbounded")";

  void print_root() {
    element("xs:complexType", [&] {
      // Sections in any order and number, but one view plane and one camera, or none: they may be in files that are
      // included. That there is one integrator at most would take as many sequences again.
      element("xs:sequence", [&] {
        print_sections();
        element(R"(xs:choice minOccurs="0")", [&] {
          print_pair([&] { child(ViewPlane::element); }, [&] { print_one_of(Cameras{}); });
          print_pair([&] { print_one_of(Cameras{}); }, [&] { child(ViewPlane::element); });
        });
      });
    });
    line("<!-- Names are unique among all textures, among all materials, and among all objects. -->");
    print_constraint(R"(xs:key name="textures")", "textures/*/*", "name");
    print_constraint(R"(xs:key name="materials")", "materials/*/*", "name");
    print_constraint(R"(xs:unique name="objects")", "objects/*/*", "name");
  }

  template <class PrintFirst, class PrintSecond>
  void print_pair(const PrintFirst& print_first, const PrintSecond& print_second) {
    element("xs:sequence", [&] {
      print_first();
      print_sections();
      element(R"(xs:sequence minOccurs="0")", [&] {
        print_second();
        print_sections();
      });
    });
  }

  void print_sections() {
    element(any_number_of, [&] {
      for_each_type(Sections{}, [&]<class Section>(std::type_identity<Section>) { child(Section::element); });
      child(integrator_element);
      child(groups_element);
      child(Include::element);
    });
  }

  template <class List>
  void print_one_of(List list) {
    element("xs:choice", [&] { for_each_type(list, [&]<class T>(std::type_identity<T>) { child(T::element); }); });
  }

  void print_constraint(std::string_view tag, const std::string& selector, const std::string& field) {
    element(tag, [&] {
      line("<xs:selector xpath=\"" + selector + "\"/>");
      line("<xs:field xpath=\"" + field + "\"/>");
    });
  }

  template <class Section>
  void print_section() {
    using Types = typename Section::Types;
    print_choice(Section::element, [&] {
      for_each_type(Types{}, [&]<class T>(std::type_identity<T>) { child(T::group.empty() ? T::element : T::group); });
    });
    for_each_type(Types{}, [&]<class T>(std::type_identity<T>) {
      if (!T::group.empty()) print_choice(T::group, [&] { child(T::element); });
      print_item(element_type<T>(), labels_of<Section, T>(), std::is_same_v<Section, MaterialsSection>);
    });
  }

  /// The type of an element that has any number of other elements, in any order.
  template <class PrintChildren>
  void print_choice(std::string_view name, const PrintChildren& print_children) {
    element(named("complexType", name), [&] { element(any_number_of, print_children); });
  }

  static std::string_view type_of_label(std::string_view label) {
    if (label == transform_element) return label;
    return label == shadowcatcher_element || label == visible_element ? "boolean" : "text";
  }

  void print_item(const ElementType& type, std::span<const FieldInfo> labels, bool may_have_textures = false) {
    // Without fields it would have to be empty, white space included, were it not mixed.
    const bool empty = labels.empty() && type.fields.empty();
    element(named("complexType", type.element) + (empty ? " mixed=\"true\"" : ""), [&] {
      element("xs:all", [&] {
        for (const FieldInfo& label : labels) child(label.name, type_of_label(label.name), label.required);
        const auto has_shorthand = [&](std::string_view name) {
          return std::any_of(type.fields_in_files.begin(), type.fields_in_files.end(),
                             [&](const Field& field) { return field.in_place_of == name; });
        };
        for (const Field& field : type.fields_in_files) {
          const bool required = field.required && !has_shorthand(field.name);
          if (!field.words().empty())
            print_choice_of_words(field, field.words());
          else if (field.is_of_texture())
            print_number_of_texture(field);
          else
            child(field.name, (may_have_textures && field.may_be_textured() ? "textured" : "") + type_name(field),
                  required);
        }
      });
    });
  }

  void print_number_of_texture(const FieldInfo& info) {
    element(named("element", info.name) + R"( minOccurs="0")", [&] {
      element("xs:complexType", [&] {
        attribute(texture_attribute, "text", true);
        if (!info.whole_color) attribute(channel_attribute, "channel", false);
        if (!info.number_attribute.empty()) attribute(info.number_attribute, number_name(info.range), false);
      });
    });
  }

  void print_transform() {
    print_choice(transform_element, [&] {
      for (std::size_t type = 0; type < TransformStep::elements.size(); ++type) child(TransformStep::elements[type]);
    });
    for (std::size_t type = 0; type < TransformStep::elements.size(); ++type) {
      const auto attributes = step_attributes(static_cast<TransformStep::Type>(type));
      if (attributes.empty()) {
        print_restriction(TransformStep::elements[type], "text", {});
        continue;
      }
      element(named("complexType", TransformStep::elements[type]), [&] {
        print_keys(number_name(Range::any), attributes);
        for (const std::string_view name : attributes) attribute(name, number_name(Range::any), false);
      });
    }
  }

  void print_value_types() {
    line("<!-- A variable, anywhere in a value. -->");
    print_restriction("variable", "xs:token", {{"pattern", R"(.*[$].*)"}});
    print_restriction("interpolation", "xs:token", word_facets(Choices<Interpolation>::words));
    print_restriction("channel", "xs:token", word_facets(Choices<TextureChannel>::words));
    for (const Range range : {Range::any, Range::not_negative, Range::positive}) {
      const RangeLimits limit = limits(range);
      print_value_or_variable(number_name(range), "xs:double",
                              {{"minInclusive", number_text(limit.least_number)},
                               {"maxInclusive", number_text(largest_number)},
                               {"pattern", R"([+\-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+\-]?[0-9]+)?)"}});
      // Not of xs:int, for which xmllint forgets to take white space away.
      print_value_or_variable(
          type_name<int>(range), "xs:integer",
          {{"minInclusive", std::to_string(limit.least_integer)}, {"maxInclusive", std::to_string(INT_MAX)}});
      // XML Schema 1.0 cannot say "a number or elements", so the text is any.
      element(named("complexType", type_name<double>(range)) + " mixed=\"true\"",
              [&] { print_keys(number_name(range), {&number_component, 1}); });
      print_components<Vec3d>(range);
      print_components<Vec2d>(range);
      print_components<Rgb<double>>(range);
      print_textured<double>(range, R"( mixed="true")");
      print_textured<Rgb<double>>(range, "");
    }
    line("<!-- A stray > before the value is a slip that is forgiven. -->");
    print_restriction("boolean", "xs:token", {{"pattern", R"(>? ?(true|false|1|0)|.*[$].*)"}});
    print_restriction("text", "xs:token", {{"minLength", "1"}});
  }

  /// The same with a texture.
  template <class Value>
  void print_textured(Range range, std::string_view mixed) {
    const std::string type = type_name<Value>(range);
    element(named("complexType", "textured" + type) + std::string(mixed), [&] {
      element("xs:complexContent" + std::string(mixed), [&] {
        element("xs:extension base=\"" + type + "\"", [&] {
          attribute(texture_attribute, "text", false);
          if (std::is_same_v<Value, double>) attribute(channel_attribute, "channel", false);
        });
      });
    });
  }

  using Facets = std::vector<std::pair<std::string_view, std::string>>;

  static Facets word_facets(std::span<const std::string_view> words) {
    std::string pattern;
    for (const std::string_view word : words) pattern.append(word).append("|");
    return {{"pattern", pattern + ".*[$].*"}};
  }

  void print_choice_of_words(const FieldInfo& info, std::span<const std::string_view> words) {
    element(named("element", info.name) + (info.required ? "" : R"( minOccurs="0")"),
            [&] { element("xs:simpleType", [&] { print_facets("xs:token", word_facets(words)); }); });
  }

  void print_restriction(std::string_view name, std::string_view base, const Facets& facets) {
    element(named("simpleType", name), [&] { print_facets(base, facets); });
  }

  void print_value_or_variable(std::string_view name, std::string_view base, const Facets& facets) {
    element(named("simpleType", name), [&] {
      element(R"(xs:union memberTypes="variable")",
              [&] { element("xs:simpleType", [&] { print_facets(base, facets); }); });
    });
  }

  void print_facets(std::string_view base, const Facets& facets) {
    element("xs:restriction base=\"" + std::string(base) + "\"", [&] {
      for (const auto& [facet, value] : facets) line("<xs:" + std::string(facet) + " value=\"" + value + "\"/>");
    });
  }

  template <class Value>
  void print_components(Range range) {
    const std::string type = number_name(range);
    element(named("complexType", type_name<Value>(range)), [&] {
      // Nor can it say "attributes or elements", or "these attributes or that one".
      constexpr bool is_color = std::is_same_v<Value, Rgb<double>>;
      print_keys(type, Components<Value>::names, is_color);
      for (const std::string_view component : Components<Value>::names) attribute(component, type, false);
      if (is_color) attribute(temperature_attribute, number_name(Range::positive), false);
    });
  }

  void print_keys(const std::string& type, std::span<const std::string_view> components, bool or_temperature = false) {
    element("xs:sequence", [&] {
      element(R"(xs:element name="key" minOccurs="0" maxOccurs="unbounded")", [&] {
        element("xs:complexType", [&] {
          attribute("frame", number_name(Range::any), true);
          for (const std::string_view component : components) attribute(component, type, !or_temperature);
          if (or_temperature) attribute(temperature_attribute, number_name(Range::positive), false);
          attribute("interpolation", "interpolation", false);
        });
      });
    });
  }

  void attribute(std::string_view name, const std::string& type, bool required) {
    line("<" + named("attribute", name) + " type=\"" + type + (required ? "\" use=\"required\"/>" : "\"/>"));
  }

  void child(std::string_view name, std::string_view type, bool required) {
    line("<" + named("element", name) + " type=\"" + std::string(type) + (required ? "\"/>" : "\" minOccurs=\"0\"/>"));
  }

  /// An element whose type has its name.
  void child(std::string_view name) { child(name, name, true); }

  /// xs:what name="name"
  static std::string named(std::string_view what, std::string_view name) {
    return "xs:" + std::string(what) + " name=\"" + std::string(name) + "\"";
  }
};

}  // namespace

std::string print_schema() { return SchemaPrinter().print(); }

}  // namespace raytrace
