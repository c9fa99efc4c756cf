#include "raytrace/description/read_value.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "raytrace/description/keyframes.h"
#include "raytrace/description/read_transform.h"

namespace raytrace {

namespace {

/// value: null if the fields are for an example only.
template <class Value>
std::vector<AttributeField> component_fields(Value* value, Range range) {
  std::vector<AttributeField> fields;
  for (std::size_t i = 0; i < Components<Value>::names.size(); ++i) {
    double* const component = value != nullptr ? &(value->*Components<Value>::members[i]) : nullptr;
    fields.push_back({Components<Value>::names[i], component, range_of_components(range)});
  }
  return fields;
}

/// Reads one child into its target. Each function returns false where it has reported an error.
class ValueReader {
 public:
  /// texture: null where there is to be none.
  ValueReader(Element element, const FieldInfo& info, const ReadContext& context, TextureAttributes* texture)
      : element_(element), info_(info), context_(context), texture_(texture) {
    if (texture != nullptr && !find_attribute(element, texture_attribute)) texture_ = nullptr;
  }

  bool operator()(double* value) const {
    const Node text_node = single_text();
    if (!text_node && has_keys(element_))
      return read_keys(element_, {&number_component, 1}, {&value, 1}, info_.range, context_, texture_);
    if (texture_ != nullptr && !element_.first_child()) {
      *value = 1;
      return read_attributes(element_, texture_fields(*texture_, true), false, context_);
    }
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

  bool operator()(FileName* file) const {
    const Node text_node = single_text();
    return read_text(text_node, [&](std::string_view text) -> OptionalMessage {
      const SourceLocation location = text_node.location();
      *file = {(std::filesystem::path(context_.folder) / text).string(), location.line, location.column};
      return check_label(text);
    });
  }

  bool operator()(Reference* reference) const {
    const Node text_node = single_text();
    return read_text(text_node, [&](std::string_view text) -> OptionalMessage {
      const SourceLocation location = text_node.location();
      *reference = {std::string(text), location.line, location.column};
      return check_label(text);
    });
  }

  bool operator()(NumberGroups* groups) const {
    return read_text(single_text(), [&](std::string_view text) { return parse_groups(text, *groups); });
  }

  bool operator()(Transform* transform) const { return read_transform(element_, *transform, context_); }

  bool operator()(WordOrGroups* value) const {
    return read_text(single_text(), [&](std::string_view text) { return parse_word_or_groups(text, *value); });
  }

  bool operator()(const ChoiceReference& choice) const {
    return read_text(single_text(), [&](std::string_view text) { return parse_choice(text, choice); });
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
    const bool fine = texture_ != nullptr ? read_attributes(element_, texture_fields(*texture_, true), false, context_)
                                          : refuse_attributes(element_, {}, context_.diagnostics);
    if (text.empty()) {
      refuse_content();
      return false;
    }
    const auto where = [&] { return " in " + tag(info_.name) + " "; };
    return parse_text(text, element_, node, parse, where, context_) && fine;
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
    auto fields = component_fields(&value, info_.range);
    if (element_.first_child() && has_keys(element_)) {
      std::vector<double*> values;
      for (const AttributeField& field : fields) values.push_back(std::get<double*>(field.target));
      return read_keys(element_, Components<Value>::names, values, info_.range, context_, texture_);
    }
    if constexpr (std::is_same_v<Value, Rgb<double>>) {
      if (texture_ != nullptr) {
        fields.push_back(texture_fields(*texture_, false).front());
        // All of a colour, or nothing but the texture.
        const Attribute only = element_.first_attribute();
        if (!only.next()) {
          value = {1, 1, 1};
          for (AttributeField& field : fields) field.required = false;
        }
      }
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
  TextureAttributes* texture_;  ///< null if the element has none
};

bool is_number_or_variable(std::string_view word) {
  double number = 0;
  return word.starts_with('$') ? is_variable_name(word.substr(1)) : !parse_number(word, Range::any, number);
}

/// Numbers with spaces, commas or semicolons between them, in brackets or not. False if there is anything else.
bool append_numbers(std::string_view text, std::vector<std::string>& numbers) {
  static constexpr std::string_view separators = " \t\r\n,;()[]{}";
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(separators), text.size()));
    if (text.empty()) return true;
    const std::string_view word = text.substr(0, text.find_first_of(separators));
    if (!is_number_or_variable(word)) return false;
    numbers.emplace_back(word);
    text.remove_prefix(word.size());
  }
}

/// What an element holds for some fields.
class OwnNumbers {
 public:
  OwnNumbers(Element element, std::span<const AttributeField> fields) : fields_(fields), values_(fields.size()) {
    if (!element) return;
    for (Attribute attribute = element.first_attribute(); attribute; attribute = attribute.next())
      take(attribute.name(), attribute.value());
    for (Node node = element.first_child(); node; node = node.next()) {
      const Element child = node.element();
      const Node content = child ? child.first_child() : node;
      if (content && !content.element()) take(child ? child.name() : std::string_view(), content.text());
    }
    give_others();
  }

  /// Of fields[i]; empty if it is not known.
  const std::string& operator[](std::size_t i) const { return values_[i]; }

 private:
  void take(std::string_view name, std::string_view text) {
    const std::size_t i = find_field(fields_, name);
    std::vector<std::string> numbers;
    const bool fine = append_numbers(text, numbers);
    if (i == fields_.size()) {
      others_fine_ = others_fine_ && fine;
      others_.insert(others_.end(), numbers.begin(), numbers.end());
    } else if (fine && numbers.size() == 1) {
      values_[i] = numbers.front();
    }
  }

  /// Numbers without a field's name go to the required fields that have none, in their order.
  void give_others() {
    std::vector<std::string*> absent;
    for (std::size_t i = 0; i < fields_.size(); ++i)
      if (fields_[i].required && values_[i].empty()) absent.push_back(&values_[i]);
    if (!others_fine_) return;
    if (others_.size() == 1 && absent.size() == 3) others_.assign(3, others_.front());  // a grey
    if (others_.size() != absent.size()) return;
    for (std::size_t i = 0; i < absent.size(); ++i) *absent[i] = others_[i];
  }

  std::span<const AttributeField> fields_;
  std::vector<std::string> values_, others_;
  bool others_fine_ = true;
};

/// Bit i: the element has the attribute fields[i].
std::uint64_t present_attributes(Element element, std::span<const AttributeField> fields) {
  std::uint64_t present = 0;
  for (Attribute attribute = element.first_attribute(); attribute; attribute = attribute.next()) {
    const std::size_t i = find_field(fields, attribute.name());
    if (i < fields.size()) present |= std::uint64_t(1) << i;
  }
  return present;
}

bool read_attribute(Element element, Attribute attribute, const AttributeField& field, const ReadContext& context) {
  const auto parse = [&](std::string_view text) -> OptionalMessage {
    if (const auto* const number = std::get_if<double*>(&field.target))
      return parse_number(text, field.range, **number);
    if (const auto* const choice = std::get_if<ChoiceReference>(&field.target)) return parse_choice(text, *choice);
    text = xml::trimmed(text);
    *std::get<std::string_view*>(field.target) = text;
    return text.empty() ? "is empty" : check_label(text);
  };
  const auto where = [&] { return " for " + std::string(field.name) + " in " + tag(element.name()) + " "; };
  return parse_text(attribute.value(), element, attribute, parse, where, context);
}

/// Reports the required fields that are missing, if any: then it is false. present: bit i for fields[i].
bool require_all(Element element, std::span<const AttributeField> fields, std::uint64_t present,
                 Diagnostics& diagnostics) {
  std::string missing;
  int count = 0;
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (!fields[i].required || (present >> i & 1)) continue;
    missing += (count++ > 0 ? " and " : "") + in_quotes(fields[i].name);
  }
  if (count == 0) return true;
  diagnostics.error(element, [&] {
    return "missing " + std::string(count > 1 ? "attributes " : "attribute ") + missing + " in " + tag(element.name()) +
           "; write " + example_of(element.name(), fields, element);
  });
  return false;
}

}  // namespace

std::span<const std::string_view> component_names(const FieldTarget& target) {
  if (std::holds_alternative<Vec3d*>(target)) return Components<Vec3d>::names;
  if (std::holds_alternative<Vec2d*>(target)) return Components<Vec2d>::names;
  if (std::holds_alternative<Rgb<double>*>(target)) return Components<Rgb<double>>::names;
  return {};
}

std::vector<AttributeField> texture_fields(TextureAttributes& texture, bool is_number) {
  std::vector<AttributeField> fields{{texture_attribute, &texture.texture}};
  if (is_number) fields.push_back({channel_attribute, ChoiceReference(texture.channel), Range::any, false});
  return fields;
}

bool read_value(Element element, const FieldInfo& info, const FieldTarget& target, const ReadContext& context,
                TextureAttributes* texture) {
  return std::visit(ValueReader(element, info, context, texture), target);
}

std::string example_value(const FieldInfo& info, const FieldTarget& target) {
  if (std::holds_alternative<Vec3d*>(target))
    return example_of(info.name, component_fields<Vec3d>(nullptr, info.range));
  if (std::holds_alternative<Vec2d*>(target))
    return example_of(info.name, component_fields<Vec2d>(nullptr, info.range));
  if (std::holds_alternative<Rgb<double>*>(target))
    return example_of(info.name, component_fields<Rgb<double>>(nullptr, info.range));
  const auto* const choice = std::get_if<ChoiceReference>(&target);
  const std::string value =
      choice != nullptr                       ? std::string(choice->words()[0])
      : std::holds_alternative<bool*>(target) ? "true"
      : std::holds_alternative<std::string_view*>(target) || std::holds_alternative<Reference*>(target) ? "..."
      : std::holds_alternative<FileName*>(target)                                                       ? "model.ply"
      : std::holds_alternative<NumberGroups*>(target) || std::holds_alternative<WordOrGroups*>(target)
          ? "0 0 0, 1 0 0, 0 1 0"
          : "1";
  return tag(info.name) + value + closing_tag(info.name);
}

bool refuse_attributes(Element element, std::span<const FieldInfo> children, Diagnostics& diagnostics) {
  const Attribute first = element.first_attribute();
  for (Attribute attribute = first; attribute; attribute = attribute.next()) {
    diagnostics.error(attribute, [&] {
      const std::string name = printable(attribute.name());
      const bool known = find_field(children, attribute.name()) < children.size();
      return "unexpected attribute " + in_quotes(attribute.name()) + " in " + tag(element.name()) +
             (known ? "; write it as a child element: <" + name + ">...</" + name + ">" : ", which takes none");
    });
  }
  return !first;
}

bool refuse_text(Node node, Element parent, Diagnostics& diagnostics) {
  if (node.element()) return false;
  if (!node.text().empty()) {
    diagnostics.error(node, [&] {
      return "unexpected text " + in_quotes(node.text()) + " in " + tag(parent.name()) + ", which takes only elements";
    });
  }
  return true;
}

bool read_attributes(Element element, std::span<const AttributeField> fields, bool example_shown,
                     const ReadContext& context) {
  bool fine = true;
  std::uint64_t present = 0;  // bit i: fields[i]
  for (Attribute attribute = element.first_attribute(); attribute; attribute = attribute.next()) {
    const std::size_t i = find_field(fields, attribute.name());
    if (i < fields.size()) {
      present |= std::uint64_t(1) << i;
      fine &= read_attribute(element, attribute, fields[i], context);
      continue;
    }
    fine = false;
    const std::string_view nearest = nearest_absent(fields, present_attributes(element, fields), attribute.name());
    context.diagnostics.error(attribute, [&] {
      return "unknown attribute " + in_quotes(attribute.name()) + " in " + tag(element.name()) +
             (nearest.empty() ? "; write " + example_of(element.name(), fields, element)
                              : "; did you mean " + in_quotes(nearest) + "?");
    });
    // One slip, one message: an attribute that was only misspelt is not reported as missing too.
    if (nearest.empty())
      example_shown = true;
    else
      present |= std::uint64_t(1) << find_field(fields, nearest);
  }
  return (example_shown || require_all(element, fields, present, context.diagnostics)) && fine;
}

std::string example_of(std::string_view element, std::span<const AttributeField> fields, Element source) {
  const OwnNumbers own(source, fields);
  std::string text = "<" + printable(element);
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (!fields[i].required) continue;
    text.append(" ").append(fields[i].name).append("=\"").append(own[i].empty() ? "1" : own[i]).append("\"");
  }
  return text + "/>";
}

}  // namespace raytrace
