#include "raytrace/description/read_value.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "raytrace/description/nearest_name.h"
#include "raytrace/description/parse_value.h"
#include "raytrace/description/quoted.h"
#include "raytrace/description/refuse_content.h"
#include "raytrace/description/report.h"

namespace raytrace {
namespace {

constexpr std::array<std::string_view, 3> vector_components = {"x", "y", "z"};
constexpr std::array<std::string_view, 3> color_components = {"red", "green", "blue"};

using Components = std::array<std::string_view, 3>;

/// name="1" name="1" name="1"
std::string example_of(const Components& components) {
  std::string example;
  for (const std::string_view component : components) {
    if (!example.empty()) example += ' ';
    example.append(component).append("=\"1\"");
  }
  return example;
}

/// <name x="1" y="1" z="1"/>
std::string example_of(std::string_view name, const Components& components) {
  return std::string("<").append(name).append(" ").append(example_of(components)).append("/>");
}

/// Reads one child into its target. Each function gives false where it has reported an error.
class ValueReader {
 public:
  ValueReader(Element element, const FieldInfo& info, Diagnostics& diagnostics)
      : element_(element), info_(info), diagnostics_(diagnostics) {}

  bool operator()(double* value) const {
    return read_text([&](std::string_view text) { return parse_number(text, info_.range, *value); });
  }

  bool operator()(int* value) const {
    return read_text([&](std::string_view text) { return parse_integer(text, info_.range, *value); });
  }

  bool operator()(bool* value) const {
    return read_text([&](std::string_view text) {
      // The slip of the seed's sample: <shadows>>true</shadows>.
      const bool stray = text.starts_with('>');
      const Complaint complaint = parse_boolean(stray ? text.substr(1) : text, *value);
      if (stray && !complaint) {
        report_warning(diagnostics_, element_.first_child(), [&] {
          return "stray '>' before " + in_quotes(trimmed(text.substr(1))) + " in " + tag(info_.name) +
                 " is ignored; remove it";
        });
      }
      return complaint;
    });
  }

  bool operator()(std::string_view* value) const {
    return read_text([&](std::string_view text) -> Complaint {
      *value = text;
      // Schemas take runs of white space for single spaces; to agree with them there must not be any.
      bool runs = false;
      char last = 0;
      for (const char c : text) {
        runs |= c == '\t' || c == '\n' || c == '\r' || (c == ' ' && last == ' ');
        last = c;
      }
      if (!runs) return std::nullopt;
      return "has line breaks, tabs or several spaces in a row; write single spaces";
    });
  }

  bool operator()(std::string* value) const {
    std::string_view text;
    if (!(*this)(&text)) return false;
    *value = text;
    return true;
  }

  bool operator()(Vec3d* value) const {
    Vec3d& v = *value;
    if (!read_components(vector_components, {&v.x, &v.y, &v.z})) return false;
    if (info_.range != Range::nonzero || std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}) >= smallest_size)
      return true;
    report_error(diagnostics_, element_, [&] {
      return tag(info_.name) + " is a direction, so x, y and z must not all be 0; write one such as <" +
             printable(info_.name) + " x=\"0\" y=\"1\" z=\"0\"/>";
    });
    return false;
  }

  bool operator()(Rgb<double>* value) const {
    return read_components(color_components, {&value->red, &value->green, &value->blue});
  }

 private:
  /// parse: text -> Complaint
  template <class Parse>
  bool read_text(Parse&& parse) const {
    const bool no_attributes = refuse_attributes(element_, {}, diagnostics_);
    const Node node = element_.first_child();
    const bool single_text = node && !node.element() && !node.next();
    const std::string_view text = single_text ? node.text() : std::string_view();
    if (text.empty()) {
      report_no_text(node);
      return false;
    }
    const Complaint complaint = parse(text);
    if (complaint) {
      report_error(diagnostics_, node, [&] { return in_quotes(text) + " in " + tag(info_.name) + " " + *complaint; });
    }
    return no_attributes && !complaint;
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
        return "the value of " + tag(info_.name) + " is in pieces; write it in one, with no comment in the middle";
      });
      return;
    }
    report_error(diagnostics_, element_,
                 [&] { return tag(info_.name) + " is empty; write its value between its tags"; });
  }

  bool read_components(const Components& names, const std::array<double*, 3>& values) const {
    bool fine = refuse_content(names);
    bool shape_known = fine;  // otherwise the reports have said already how the whole is written
    std::array<bool, 3> seen{};
    for (Attribute attribute = element_.first_attribute(); attribute; attribute = attribute.next()) {
      const std::size_t i =
          static_cast<std::size_t>(std::find(names.begin(), names.end(), attribute.name()) - names.begin());
      if (i == names.size()) {
        fine = false;
        const std::string_view nearest = nearest_missing(attribute.name(), names);
        report_error(diagnostics_, attribute, [&] { return explain_unknown(attribute, names, nearest); });
        // One slip, one message: a component that was only misspelt is not reported as missing too.
        if (nearest.empty())
          shape_known = false;
        else
          seen[static_cast<std::size_t>(std::find(names.begin(), names.end(), nearest) - names.begin())] = true;
        continue;
      }
      seen[i] = true;
      const Range range = info_.range == Range::nonzero ? Range::any : info_.range;
      if (const Complaint complaint = parse_number(attribute.value(), range, *values[i])) {
        fine = false;
        report_error(diagnostics_, attribute, [&] {
          return in_quotes(attribute.value()) + " for " + std::string(names[i]) + " in " + tag(info_.name) + " " +
                 *complaint;
        });
      }
    }
    return (!shape_known || require_components(names, seen)) && fine;
  }

  /// The component that an unknown attribute may have been meant for: a near one that is not there under its own name.
  std::string_view nearest_missing(std::string_view name, const Components& names) const {
    std::vector<std::string_view> missing;
    for (const std::string_view candidate : names) {
      Attribute present = element_.first_attribute();
      while (present && present.name() != candidate) present = present.next();
      if (!present) missing.push_back(candidate);
    }
    return nearest_name(name, missing);
  }

  std::string explain_unknown(Attribute attribute, const Components& names, std::string_view nearest) const {
    const std::string start = "unknown attribute " + in_quotes(attribute.name()) + " in " + tag(info_.name) + "; ";
    if (!nearest.empty()) return start + "did you mean " + in_quotes(nearest) + "?";
    return start + "write " + example_of(info_.name, names);
  }

  bool require_components(const Components& names, const std::array<bool, 3>& seen) const {
    std::string missing;
    int count = 0;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (seen[i]) continue;
      missing += (count++ > 0 ? " and " : "") + in_quotes(names[i]);
    }
    if (count == 0) return true;
    report_error(diagnostics_, element_, [&] {
      return "missing " + std::string(count > 1 ? "attributes " : "attribute ") + missing + " in " + tag(info_.name) +
             "; write " + example_of(info_.name, names);
    });
    return false;
  }

  /// Reports children of an element that takes attributes only.
  bool refuse_content(const Components& names) const {
    bool fine = true;
    for (Node node = element_.first_child(); node; node = node.next()) {
      if (!node.element() && node.text().empty()) continue;
      fine = false;
      report_error(diagnostics_, node, [&] {
        return (node.element() ? "unexpected element " + tag(node.element().name())
                               : "unexpected text " + in_quotes(node.text())) +
               " in " + tag(info_.name) + "; its value goes into attributes: " + example_of(info_.name, names);
      });
    }
    return fine;
  }

  Element element_;
  const FieldInfo& info_;
  Diagnostics& diagnostics_;
};

}  // namespace

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
