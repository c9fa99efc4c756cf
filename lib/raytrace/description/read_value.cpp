#include "raytrace/description/read_value.h"

#include <array>

#include "raytrace/description/keyframes.h"
#include "raytrace/description/read_attributes.h"

namespace raytrace {
namespace {

/// value: null if the fields are for an example only.
template <class Value>
std::array<AttributeField, 3> component_fields(Value* value, Range range) {
  std::array<AttributeField, 3> fields;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    double* const component = value != nullptr ? &(value->*Components<Value>::members[i]) : nullptr;
    fields[i] = {Components<Value>::names[i], component, range_of_components(range)};
  }
  return fields;
}

/// Reads one child into its target. Each function returns false where it has reported an error.
class ValueReader {
 public:
  ValueReader(Element element, const FieldInfo& info, const ReadContext& context)
      : element_(element), info_(info), context_(context) {}

  bool operator()(double* value) const {
    const Node text_node = single_text();
    if (!text_node && has_keys(element_))
      return read_keys(element_, {&number_component, 1}, {&value, 1}, info_.range, context_);
    return read_text(text_node, [&](std::string_view text) { return parse_number(text, info_.range, *value); });
  }

  bool operator()(int* value) const {
    return read_text(single_text(), [&](std::string_view text) { return parse_integer(text, info_.range, *value); });
  }

  bool operator()(bool* value) const {
    return read_text(single_text(), [&](std::string_view text) {
      // The slip of the seed's sample: <shadows>>true</shadows>.
      const bool stray = text.starts_with('>');
      const OptionalMessage message = parse_boolean(stray ? text.substr(1) : text, *value);
      if (stray && !message) {
        context_.diagnostics.warning(element_.first_child(), [&] {
          return "stray '>' before " + in_quotes(xml::trimmed(text.substr(1))) + " in " + tag(info_.name) +
                 " is ignored; remove it";
        });
      }
      return message;
    });
  }

  bool operator()(std::string_view* value) const {
    return read_text(single_text(), [&](std::string_view text) {
      *value = text;
      return check_label(text);
    });
  }

  bool operator()(std::string* value) const {
    std::string_view text;
    if (!(*this)(&text)) return false;
    *value = text;
    return true;
  }

  template <HasComponents Value>
  bool operator()(Value* value) const {
    if (!read_components(*value)) return false;
    if constexpr (std::is_same_v<Value, Vec3d>) {
      if (info_.range == Range::nonzero && !is_direction(*value)) {
        refuse_zero();
        return false;
      }
    }
    return true;
  }

 private:
  /// node: single_text(). parse: text -> OptionalMessage
  template <class Parse>
  bool read_text(Node node, const Parse& parse) const {
    const std::string_view text = node ? node.text() : std::string_view();
    const Attribute attribute = element_.first_attribute();
    if (text.empty() && attribute && !attribute.next() && !element_.first_child()) {
      context_.diagnostics.error(attribute, [&] {
        return "unexpected attribute " + in_quotes(attribute.name()) + " in " + tag(info_.name) +
               "; write its value between its tags: " + tag(info_.name) + printable(attribute.value()) +
               closing_tag(info_.name);
      });
      return false;
    }
    const bool no_attributes = refuse_attributes(element_, {}, context_.diagnostics);
    if (text.empty()) {
      refuse_content();
      return false;
    }
    const auto where = [&] { return " in " + tag(info_.name) + " "; };
    return parse_text(text, element_, node, parse, where, context_) && no_attributes;
  }

  /// The text of an element that has nothing else; false if it has.
  Node single_text() const {
    const Node node = element_.first_child();
    return node && !node.element() && !node.next() ? node : Node(nullptr);
  }

  /// Says why an element has no text for a value.
  void refuse_content() const {
    const Node first = element_.first_child();
    Node child = first;
    while (child && !child.element()) child = child.next();
    if (child) {
      context_.diagnostics.error(child, [&] {
        return "unexpected element " + tag(child.element().name()) + " in " + tag(info_.name) +
               ", which takes a plain value";
      });
    } else if (first && first.next()) {
      context_.diagnostics.error(first, [&] {
        return "the value of " + tag(info_.name) + " is in pieces; write it in one, with no comment in the middle";
      });
    } else {
      context_.diagnostics.error(element_,
                                 [&] { return tag(info_.name) + " is empty; write its value between its tags"; });
    }
  }

  template <class Value>
  bool read_components(Value& value) const {
    const auto fields = component_fields(&value, info_.range);
    if (element_.first_child() && has_keys(element_)) {
      std::array<double*, 3> values{};
      for (std::size_t i = 0; i < 3; ++i) values[i] = std::get<double*>(fields[i].target);
      return read_keys(element_, Components<Value>::names, values, info_.range, context_);
    }
    bool fine = true;
    for (Node node = element_.first_child(); node; node = node.next()) {
      if (!node.element() && node.text().empty()) continue;
      fine = false;
      context_.diagnostics.error(node, [&] {
        return (node.element() ? "unexpected element " + tag(node.element().name())
                               : "unexpected text " + in_quotes(node.text())) +
               " in " + tag(info_.name) +
               "; its value goes into attributes: " + example_of(info_.name, fields, element_);
      });
    }
    return read_attributes(element_, fields, !fine, context_) && fine;
  }

  void refuse_zero() const {
    context_.diagnostics.error(element_, [&] {
      return tag(info_.name) + " is a direction, so x, y and z must not all be 0; write one such as <" +
             printable(info_.name) + " x=\"0\" y=\"1\" z=\"0\"/>" +
             (has_keys(element_) ? "; so it is at frame " + std::to_string(context_.variables.frame()) : "");
    });
  }

  Element element_;
  const FieldInfo& info_;
  const ReadContext& context_;
};

}  // namespace

std::span<const std::string_view> component_names(const FieldTarget& target) {
  return std::visit(
      []<class Value>(Value*) -> std::span<const std::string_view> {
        if constexpr (HasComponents<Value>)
          return Components<Value>::names;
        else
          return {};
      },
      target);
}

bool read_value(Element element, const FieldInfo& info, const FieldTarget& target, const ReadContext& context) {
  return std::visit(ValueReader(element, info, context), target);
}

std::string example_value(const FieldInfo& info, const FieldTarget& target) {
  return std::visit(
      [&]<class Value>(Value*) {
        if constexpr (HasComponents<Value>)
          return example_of(info.name, component_fields<Value>(nullptr, info.range));
        else
          return tag(info.name) +
                 (std::is_same_v<Value, bool>   ? "true"
                  : std::is_arithmetic_v<Value> ? "1"
                                                : "...") +
                 closing_tag(info.name);
      },
      target);
}

}  // namespace raytrace
