#include "raytrace/description/read_value.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "raytrace/description/include.h"
#include "raytrace/description/keyframes.h"
#include "raytrace/description/read_transform.h"
#include "raytrace/math/blackbody.h"

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

/// What other programs call a key.
bool is_called_key(std::string_view name) {
  return name == "keyframe" || name == "keyframes" || name == "keys" || name == "Key" || name == "frame";
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
    if (info_.is_of_texture()) return read_number_of_texture(*value);
    const Node text_node = single_text();
    if (!text_node && has_keys(element_))
      return read_keys(element_, {&number_component, 1}, {&value, 1}, info_.range, context_, texture_);
    if (!text_node && refuse_other_keys({&number_component, 1})) return false;
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
      return info_.range == Range::identifier ? check_value(*reference, info_.range) : check_label(text);
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
  /// <bump texture="bark" height="0.02"/> or, without a number, <tangentmap texture="brushed"/>
  bool read_number_of_texture(double& value) const {
    TextureAttributes none;
    auto fields = texture_fields(texture_ != nullptr ? *texture_ : none, !info_.whole_color);
    const std::string_view number = info_.number_attribute;
    if (!number.empty()) fields.push_back({number, &value, info_.range, false});
    return read_attributes_alone(element_, fields, context_, [&](Node) {
      return "unexpected content of " + tag(info_.name) + "; write it as <" + std::string(info_.name) +
             " texture=\"...\"" + (number.empty() ? "" : " " + std::string(number) + "=\"1\"") + "/>";
    });
  }

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

  /// components: those of a key's value.
  bool refuse_other_keys(std::span<const std::string_view> components) const {
    for (Node node = element_.first_child(); node; node = node.next()) {
      const Element child = node.element();
      if (!child || !is_called_key(child.name())) continue;
      context_.diagnostics.error(child, [&] {
        std::vector<AttributeField> fields{{"frame", static_cast<double*>(nullptr)}};
        for (const std::string_view name : components) fields.push_back({name, static_cast<double*>(nullptr)});
        return "unexpected element " + tag(child.name()) + " in " + tag(info_.name) + "; did you mean " +
               example_of("key", fields, child) + "?";
      });
      return true;
    }
    return false;
  }

  /// Whether it is <color kelvin="2700"/>, or has keys such as <key frame="1" kelvin="2700"/>; or is meant so.
  bool has_temperature() const {
    if (find_attribute(element_, temperature_attribute)) return true;
    for (Node node = element_.first_child(); node; node = node.next())
      if (const Element child = node.element();
          child && (child.name() == temperature_attribute || find_attribute(child, temperature_attribute)))
        return true;
    return false;
  }

  bool read_temperature(Rgb<double>& color) const {
    double kelvin = 0;
    std::vector<AttributeField> fields{{temperature_attribute, &kelvin, Range::temperature}};
    if (texture_ != nullptr) fields.push_back(texture_fields(*texture_, false).front());
    double* const target = &kelvin;
    const bool fine =
        has_keys(element_)
            ? read_keys(element_, {&temperature_attribute, 1}, {&target, 1}, Range::temperature, context_, texture_)
            : read_attributes_alone(element_, fields, context_,
                                    [&](Node node) { return unexpected_content(node, fields); });
    if (!fine) return false;
    color = blackbody_color(kelvin);
    return true;
  }

  std::string unexpected_content(Node node, std::span<const AttributeField> fields) const {
    return (node.element() ? "unexpected element " + tag(node.element().name())
                           : "unexpected text " + in_quotes(node.text())) +
           " in " + tag(info_.name) + "; its value goes into attributes: " + example_of(info_.name, fields, element_);
  }

  template <class Value>
  bool read_components(Value& value) const {
    if constexpr (std::is_same_v<Value, Rgb<double>>)
      if (has_temperature()) return read_temperature(value);
    auto fields = component_fields(&value, info_.range);
    if (element_.first_child() && has_keys(element_)) {
      std::vector<double*> values;
      for (const AttributeField& field : fields) values.push_back(std::get<double*>(field.target));
      return read_keys(element_, Components<Value>::names, values, info_.range, context_, texture_);
    }
    if (refuse_other_keys(Components<Value>::names)) return false;
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
    return read_attributes_alone(element_, fields, context_,
                                 [&](Node node) { return unexpected_content(node, fields); });
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

const char* example_file(std::string_view parent) {
  if (parent == Image::element) return "picture.png";
  return parent == Include::element ? "part.xml" : "model.ply";
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

std::string example_value(const FieldInfo& info, const FieldTarget& target, std::string_view parent) {
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
      : std::holds_alternative<FileName*>(target) ? example_file(parent)
      : std::holds_alternative<NumberGroups*>(target) || std::holds_alternative<WordOrGroups*>(target)
          ? "0 0 0, 1 0 0, 0 1 0"
      : info.name == "fov"        ? "40"
      : info.name == "lensradius" ? "0.01"
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

}  // namespace raytrace
