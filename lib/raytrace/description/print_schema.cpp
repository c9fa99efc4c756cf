#include "raytrace/description/print_schema.h"

#include <climits>
#include <cstddef>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "raytrace/cameras/registry.h"
#include "raytrace/cameras/view_plane.h"
#include "raytrace/description/parse_value.h"
#include "raytrace/description/read_keys.h"
#include "raytrace/description/scene_layout.h"
#include "raytrace/lights/registry.h"
#include "raytrace/materials/registry.h"
#include "raytrace/math/type_list.h"
#include "raytrace/shapes/registry.h"

namespace raytrace {
namespace {

// Numbers of each kind, for each range: the least value that is allowed.
struct RangeLimits {
  std::string_view prefix;
  double least_number;
  int least_integer;
};
constexpr RangeLimits any_number = {"", -largest_number, INT_MIN};
constexpr RangeLimits not_negative_number = {"notnegative", 0, 0};
constexpr RangeLimits positive_number = {"positive", smallest_size, 1};

const RangeLimits& limits(Range range) {
  if (range == Range::positive) return positive_number;
  return range == Range::not_negative ? not_negative_number : any_number;
}

/// Of a number in an attribute.
std::string number_name(Range range) { return std::string(limits(range).prefix) + "number"; }

std::string type_name(Range range, double) { return number_name(range) + "orkeys"; }
std::string type_name(Range range, int) { return std::string(limits(range).prefix) + "integer"; }
std::string type_name(Range, bool) { return "boolean"; }
std::string type_name(Range, const std::string&) { return "text"; }
std::string type_name(Range range, const Vec3d&) { return std::string(limits(range).prefix) + "vector"; }
std::string type_name(Range range, const Rgb<double>&) { return std::string(limits(range).prefix) + "color"; }

class SchemaPrinter {
 public:
  std::string print() {
    line(R"(<?xml version="1.0" encoding="UTF-8"?>)");
    line("<!-- The scene format of raytrace. Made by print_schema() from the registries: do not edit, run the target");
    line("     update_schema instead. docs/ has the meaning of the elements. -->");
    open(R"(xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema" elementFormDefault="qualified")");
    print_root();
    print_section(lights_element, Lights{}, {});
    print_section(materials_element, Materials{}, {R"(<xs:element name="name" type="text"/>)"});
    print_section(
        objects_element, Shapes{},
        {R"(<xs:element name="name" type="text" minOccurs="0"/>)", R"(<xs:element name="material" type="text"/>)"});
    print_item<ViewPlane>({});
    for_each_type(Cameras{}, [&]<class T>(std::type_identity<T>) { print_item<T>({}); });
    print_value_types();
    close("xs:schema");
    return std::move(text_);
  }

 private:
  using Labels = std::vector<std::string_view>;

  // Sections in any order and number, but one view plane and one camera.
  void print_root() {
    open(R"(xs:element name="raytracer")");
    open("xs:complexType");
    open("xs:sequence");
    print_sections();
    open("xs:choice");
    print_pair(true);
    print_pair(false);
    close("xs:choice");
    close("xs:sequence");
    close("xs:complexType");
    line("<!-- Names are unique among all materials, and among all objects. -->");
    print_constraint("key", R"(name="materials")", "materials/*/*", "name");
    print_constraint("unique", R"(name="objects")", "objects/*/*", "name");
    close("xs:element");
  }

  void print_pair(bool viewplane_first) {
    open("xs:sequence");
    if (viewplane_first)
      element(ViewPlane::element);
    else
      print_cameras();
    print_sections();
    if (viewplane_first)
      print_cameras();
    else
      element(ViewPlane::element);
    print_sections();
    close("xs:sequence");
  }

  void print_sections() {
    open(R"(xs:choice minOccurs="0" maxOccurs="unbounded")");
    for (const std::string_view section : {lights_element, materials_element, objects_element}) element(section);
    close("xs:choice");
  }

  void print_cameras() {
    open("xs:choice");
    for_each_type(Cameras{}, [&]<class T>(std::type_identity<T>) { element(T::element); });
    close("xs:choice");
  }

  void print_constraint(std::string_view kind, std::string_view attributes, std::string_view selector,
                        std::string_view field) {
    const std::string name = "xs:" + std::string(kind);
    open(name + " " + std::string(attributes));
    line("<xs:selector xpath=\"" + std::string(selector) + "\"/>");
    line("<xs:field xpath=\"" + std::string(field) + "\"/>");
    close(name);
  }

  template <class List>
  void print_section(std::string_view section, List list, const Labels& labels) {
    print_choice(section, [&] {
      for_each_type(list, [&]<class T>(std::type_identity<T>) { element(T::group.empty() ? T::element : T::group); });
    });
    for_each_type(list, [&]<class T>(std::type_identity<T>) {
      if (!T::group.empty()) print_choice(T::group, [&] { element(T::element); });
      print_item<T>(labels);
    });
  }

  /// The type of an element that has any number of other elements, in any order.
  template <class PrintChildren>
  void print_choice(std::string_view name, PrintChildren print_children) {
    open("xs:complexType name=\"" + std::string(name) + "\"");
    open(R"(xs:choice minOccurs="0" maxOccurs="unbounded")");
    print_children();
    close("xs:choice");
    close("xs:complexType");
  }

  template <class T>
  void print_item(const Labels& labels) {
    open("xs:complexType name=\"" + std::string(T::element) + "\"");
    open("xs:all");
    for (const std::string_view label : labels) line(std::string(label));
    for (const auto& field : T::fields()) {
      const std::string type = std::visit(
          [&]<class Value>(Value T::Parameters::*) { return type_name(field.range, Value()); }, field.member);
      line("<xs:element name=\"" + std::string(field.name) + "\" type=\"" + type +
           (field.required ? "\"/>" : "\" minOccurs=\"0\"/>"));
    }
    close("xs:all");
    close("xs:complexType");
  }

  void print_value_types() {
    line("<!-- A variable, anywhere in a value. -->");
    print_restriction("variable", "xs:token", {{"pattern", R"(.*[$].*)"}});
    print_restriction("interpolation", "xs:token", {{"pattern", R"(linear|smooth|.*[$].*)"}});
    for (const Range range : {Range::any, Range::not_negative, Range::positive}) {
      const RangeLimits& limit = limits(range);
      print_value_or_variable(number_name(range), "xs:double",
                              {{"minInclusive", number_text(limit.least_number)},
                               {"maxInclusive", number_text(largest_number)},
                               {"pattern", R"([+\-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][+\-]?[0-9]+)?)"}});
      // Not of xs:int, for which xmllint forgets to take white space away.
      print_value_or_variable(
          type_name(range, int()), "xs:integer",
          {{"minInclusive", std::to_string(limit.least_integer)}, {"maxInclusive", std::to_string(INT_MAX)}});
      print_number_or_keys(range);
      print_components(type_name(range, Vec3d()), number_name(range), {"x", "y", "z"});
      print_components(type_name(range, Rgb<double>()), number_name(range), {"red", "green", "blue"});
    }
    line("<!-- A stray > before the value is a slip that is forgiven. -->");
    print_restriction("boolean", "xs:token", {{"pattern", R"(>? ?(true|false|1|0)|.*[$].*)"}});
    print_restriction("text", "xs:token", {{"minLength", "1"}});
  }

  using Facets = std::vector<std::pair<std::string_view, std::string>>;

  void print_restriction(const std::string& name, std::string_view base, const Facets& facets) {
    open("xs:simpleType name=\"" + name + "\"");
    print_facets(base, facets);
    close("xs:simpleType");
  }

  void print_value_or_variable(const std::string& name, std::string_view base, const Facets& facets) {
    open("xs:simpleType name=\"" + name + "\"");
    open(R"(xs:union memberTypes="variable")");
    open("xs:simpleType");
    print_facets(base, facets);
    close("xs:simpleType");
    close("xs:union");
    close("xs:simpleType");
  }

  void print_facets(std::string_view base, const Facets& facets) {
    open("xs:restriction base=\"" + std::string(base) + "\"");
    for (const auto& [facet, value] : facets) line("<xs:" + std::string(facet) + " value=\"" + value + "\"/>");
    close("xs:restriction");
  }

  /// XML Schema 1.0 cannot say "a number or elements", so the text is any.
  void print_number_or_keys(Range range) {
    open("xs:complexType name=\"" + type_name(range, double()) + "\" mixed=\"true\"");
    print_keys(number_name(range), {number_component});
    close("xs:complexType");
  }

  void print_components(const std::string& name, const std::string& type,
                        const std::vector<std::string_view>& components) {
    open("xs:complexType name=\"" + name + "\"");
    // Nor can it say "attributes or elements".
    print_keys(type, components);
    for (const std::string_view component : components) attribute(component, type, false);
    close("xs:complexType");
  }

  void print_keys(const std::string& type, const std::vector<std::string_view>& components) {
    open("xs:sequence");
    open(R"(xs:element name="key" minOccurs="0" maxOccurs="unbounded")");
    open("xs:complexType");
    attribute("frame", number_name(Range::any), true);
    for (const std::string_view component : components) attribute(component, type, true);
    attribute("interpolation", "interpolation", false);
    close("xs:complexType");
    close("xs:element");
    close("xs:sequence");
  }

  void attribute(std::string_view name, const std::string& type, bool required) {
    line("<xs:attribute name=\"" + std::string(name) + "\" type=\"" + type +
         (required ? "\" use=\"required\"/>" : "\"/>"));
  }

  /// An element whose type has its name.
  void element(std::string_view name) {
    line("<xs:element name=\"" + std::string(name) + "\" type=\"" + std::string(name) + "\"/>");
  }

  void open(std::string_view tag) {
    line("<" + std::string(tag) + ">");
    ++depth_;
  }

  void close(std::string_view name) {
    --depth_;
    line("</" + std::string(name) + ">");
  }

  void line(std::string_view content) { text_.append(2 * depth_, ' ').append(content).append("\n"); }

  std::string text_;
  std::size_t depth_ = 0;
};

}  // namespace

std::string print_schema() { return SchemaPrinter().print(); }

}  // namespace raytrace
