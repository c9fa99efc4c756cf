#include "raytrace/description/read_value.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "raytrace/description/parse_text.h"
#include "raytrace/description/parse_value.h"
#include "raytrace/description/read_attributes.h"
#include "raytrace/description/read_keys.h"
#include "raytrace/description/refuse_content.h"
#include "raytrace/text/quoted.h"
#include "raytrace/xml/report.h"

namespace raytrace {
namespace {

constexpr std::array<std::string_view, 3> vector_components = {"x", "y", "z"};
constexpr std::array<std::string_view, 3> color_components = {"red", "green", "blue"};

using Components = std::array<std::string_view, 3>;

std::array<AttributeField, 3> fields_of(const Components& names, const std::array<double*, 3>& values, Range range) {
  return {{{names[0], values[0], range}, {names[1], values[1], range}, {names[2], values[2], range}}};
}

std::string example_of(std::string_view name, const Components& components) {
  return raytrace::example_of(name, fields_of(components, {}, Range::any));
}

/// Reads one child into its target. Each function gives false where it has reported an error.
class ValueReader {
 public:
  ValueReader(Element element, const FieldInfo& info, Diagnostics& diagnostics)
      : element_(element), info_(info), diagnostics_(diagnostics) {}

  bool operator()(double* value) const {
    const Node text_node = single_text();
    if (!text_node && has_keys(element_))
      return read_keys(element_, {&number_component, 1}, {&value, 1}, info_.range, diagnostics_);
    return read_text(text_node, [&](std::string_view text) { return parse_number(text, info_.range, *value); });
  }

  bool operator()(int* value) const {
    return read_text(single_text(), [&](std::string_view text) { return parse_integer(text, info_.range, *value); });
  }

  bool operator()(bool* value) const {
    return read_text(single_text(), [&](std::string_view text) {
      // The slip of the seed's sample: <shadows>>true</shadows>.
      const bool stray = text.starts_with('>');
      const DiagnosticText diagnostic = parse_boolean(stray ? text.substr(1) : text, *value);
      if (stray && !diagnostic) {
        report_warning(diagnostics_, element_.first_child(), [&] {
          return "stray '>' before " + in_quotes(trimmed(text.substr(1))) + " in " + tag(info_.name) +
                 " is ignored; remove it";
        });
      }
      return diagnostic;
    });
  }

  bool operator()(std::string_view* value) const {
    const bool fine = read_text<Dollars::may_fit>(single_text(), [&](std::string_view text) -> DiagnosticText {
      *value = text;
      return check_label(text);
    });
    // With a variable that is not set it is no label, and nothing more is to be said about it.
    if (!fine && value->find('$') != std::string_view::npos) *value = {};
    return fine;
  }

  bool operator()(std::string* value) const {
    std::string_view text;
    if (!(*this)(&text)) return false;
    *value = text;
    return true;
  }

  bool operator()(Vec3d* value) const {
    if (!read_components(vector_components, {&value->x, &value->y, &value->z})) return false;
    if (info_.range != Range::nonzero || is_direction(*value)) return true;
    report_error(diagnostics_, element_, [&] {
      return tag(info_.name) + " is a direction, so x, y and z must not all be 0; write one such as <" +
             printable(info_.name) + " x=\"0\" y=\"1\" z=\"0\"/>" + at_frame();
    });
    return false;
  }

  bool operator()(Rgb<double>* value) const {
    return read_components(color_components, {&value->red, &value->green, &value->blue});
  }

 private:
  /// node: single_text(). parse: text -> DiagnosticText
  template <Dollars dollars = Dollars::never_fit, class Parse>
  bool read_text(Node node, const Parse& parse) const {
    const std::string_view text = node ? node.text() : std::string_view();
    const Attribute attribute = element_.first_attribute();
    if (text.empty() && attribute && !attribute.next() && !element_.first_child()) {
      report_error(diagnostics_, attribute, [&] {
        return "unexpected attribute " + in_quotes(attribute.name()) + " in " + tag(info_.name) +
               "; write its value between its tags: " + tag(info_.name) + printable(attribute.value()) +
               closing_tag(info_.name);
      });
      return false;
    }
    const bool no_attributes = refuse_attributes(element_, {}, diagnostics_);
    if (text.empty()) {
      report_no_text(element_.first_child());
      return false;
    }
    const auto where = [&] { return " in " + tag(info_.name) + " "; };
    return parse_text<dollars>(text, element_, node, parse, where, diagnostics_) && no_attributes;
  }

  /// The text of an element that has nothing else; false if it has.
  Node single_text() const {
    const Node node = element_.first_child();
    return node && !node.element() && !node.next() ? node : Node(nullptr);
  }

  /// Says why an element with these children, from `first` on, has no text for a value.
  void report_no_text(Node first) const {
    for (Node node = first; node; node = node.next()) {
      if (!node.element()) continue;
      report_error(diagnostics_, node, [&] {
        return "unexpected element " + tag(node.element().name()) + " in " + tag(info_.name) +
               ", which takes a plain value";
      });
      return;
    }
    if (first && first.next()) {
      report_error(diagnostics_, first, [&] {
        return "the value of " + tag(info_.name) + " is in chunks; write it in one, with no comment in the middle";
      });
      return;
    }
    report_error(diagnostics_, element_,
                 [&] { return tag(info_.name) + " is empty; write its value between its tags"; });
  }

  bool read_components(const Components& names, const std::array<double*, 3>& values) const {
    if (element_.first_child() && has_keys(element_))
      return read_keys(element_, names, values, info_.range, diagnostics_);
    const auto fields = fields_of(names, values, range_of_components(info_.range));
    const bool fine = refuse_content(fields);
    return read_attributes(element_, fields, !fine, diagnostics_) && fine;
  }

  /// For values that are wrong only at some frames.
  std::string at_frame() const {
    return has_keys(element_) ? "; so it is at frame " + std::to_string(element_.variables().frame()) : "";
  }

  /// Reports children of an element that takes attributes only.
  bool refuse_content(std::span<const AttributeField> fields) const {
    bool fine = true;
    for (Node node = element_.first_child(); node; node = node.next()) {
      if (!node.element() && node.text().empty()) continue;
      fine = false;
      report_error(diagnostics_, node, [&] {
        return (node.element() ? "unexpected element " + tag(node.element().name())
                               : "unexpected text " + in_quotes(node.text())) +
               " in " + tag(info_.name) +
               "; its value goes into attributes: " + own_example(info_.name, fields, element_);
      });
    }
    return fine;
  }

  Element element_;
  const FieldInfo& info_;
  Diagnostics& diagnostics_;
};

}  // namespace

std::size_t find_field(std::span<const FieldInfo> infos, std::string_view name) {
  std::size_t i = 0;
  while (i < infos.size() && infos[i].name != name) ++i;
  return i;
}

std::span<const std::string_view> component_names(const FieldTarget& target) {
  if (std::holds_alternative<Vec3d*>(target)) return vector_components;
  if (std::holds_alternative<Rgb<double>*>(target)) return color_components;
  return {};
}

bool is_direction(const Vec3d& vector) {
  return std::max({std::abs(vector.x), std::abs(vector.y), std::abs(vector.z)}) >= smallest_size;
}

bool read_value(Element element, const FieldInfo& info, const FieldTarget& target, Diagnostics& diagnostics) {
  return std::visit(ValueReader(element, info, diagnostics), target);
}

std::string example_value(const FieldInfo& info, const FieldTarget& target) {
  if (std::holds_alternative<Vec3d*>(target)) return example_of(info.name, vector_components);
  if (std::holds_alternative<Rgb<double>*>(target)) return example_of(info.name, color_components);
  const bool boolean = std::holds_alternative<bool*>(target);
  const bool text = std::holds_alternative<std::string*>(target) || std::holds_alternative<std::string_view*>(target);
  return tag(info.name) + (boolean ? "true" : text ? "..." : "1") + closing_tag(info.name);
}

}  // namespace raytrace
