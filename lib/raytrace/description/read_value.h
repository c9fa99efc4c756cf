// Reads one child element, such as <radius>1</radius> or <center x="0" y="0" z="0"/>, into a variable, and what the
// readers of all elements share.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "raytrace/description/parse_value.h"
#include "raytrace/description/scene_description.h"
#include "raytrace/description/variables.h"
#include "raytrace/parameters/transform.h"
#include "raytrace/text/message.h"
#include "raytrace/xml/diagnostics.h"
#include "raytrace/xml/document.h"
#include "raytrace/xml/xml_characters.h"

namespace raytrace {

/// What the readers of elements share: what values depend on, and where errors go.
struct ReadContext {
  const Variables& variables;
  Diagnostics& diagnostics;
  std::string_view folder = {};  ///< of the file at hand, which names of files are relative to
};

/// The index of the field of that name in `fields`, whose elements have names; their number if there is none.
template <class Fields>
std::size_t find_field(const Fields& fields, std::string_view name) {
  std::size_t i = 0;
  while (i < fields.size() && fields[i].name != name) ++i;
  return i;
}

/// The field that an unknown name may have been meant for: a near one that is absent. present: bit i for fields[i]; no
/// element has 64.
template <class Fields>
std::string_view nearest_absent(const Fields& fields, std::uint64_t present, std::string_view name) {
  std::vector<std::string_view> absent;
  for (std::size_t i = 0; i < fields.size(); ++i)
    if (!(present >> i & 1)) absent.push_back(fields[i].name);
  return nearest_name(name, absent);
}

/// Reports the attributes of an element that takes none; children: what it takes instead. False if there were any.
bool refuse_attributes(Element element, std::span<const FieldInfo> children, Diagnostics& diagnostics);

/// Reports a text among the children of an element that takes only elements. True if `node` is one.
bool refuse_text(Node node, Element parent, Diagnostics& diagnostics);

/// Parses a text with its variables replaced. parse(text): an OptionalMessage; the text lives as long as the element.
/// text: that of `at`, a Node or Attribute of the element. where(): " in <radius> ". False, with an error, if there is
/// a message.
template <class At, class Parse, class Where>
bool parse_text(std::string_view text, Element element, const At& at, const Parse& parse, const Where& where,
                const ReadContext& context) {
  OptionalMessage message;
  if (text.find('$') != std::string_view::npos) {
    std::string replaced;
    message = context.variables.replace(text, replaced);
    if (message && Variables::is_cause(*message)) {
      context.diagnostics.error_once(*message, at, [&] { return in_quotes(text) + where() + *message; });
      return false;
    }
    if (!message && xml::trimmed(replaced).empty())
      message = "is empty with the variables' values put in";
    else if (!message)
      text = xml::trimmed(element.keep(std::move(replaced)));
  }
  if (!message) message = parse(text);
  if (!message) return true;
  context.diagnostics.error(at, [&] { return in_quotes(text) + where() + *message; });
  return false;
}

/// An attribute of an element such as <center x="0" y="0" z="0"/>, and where its value goes.
struct AttributeField {
  std::string_view name;
  std::variant<double*, std::string_view*, ChoiceReference> target;  ///< a string_view views the Document's text
  Range range = Range::any;
  bool required = true;
};

/// Reports attributes that are unknown, missing or malformed; false if there are any.
/// example_shown: an error has shown already how the element is written, so none need say what is missing.
bool read_attributes(Element element, std::span<const AttributeField> fields, bool example_shown,
                     const ReadContext& context);

/// The same of an element that has nothing else. refusal(node): what is wrong with its content.
template <class Refusal>
bool read_attributes_alone(Element element, std::span<const AttributeField> fields, const ReadContext& context,
                           const Refusal& refusal) {
  bool fine = true;
  for (Node node = element.first_child(); node; node = node.next()) {
    if (!node.element() && node.text().empty()) continue;
    fine = false;
    context.diagnostics.error(node, [&] { return refusal(node); });
  }
  return read_attributes(element, fields, !fine, context) && fine;
}

/// The texture that an element such as <cd texture="wood"/> or <ka texture="dirt" channel="alpha">0.5</ka> names.
struct TextureAttributes {
  std::string_view texture;                            ///< empty: none
  TextureChannel channel = TextureChannel::automatic;  ///< which is red where a field prefers no alpha
};
inline constexpr std::string_view texture_attribute = "texture", channel_attribute = "channel";

/// False if there is none of that name.
inline Attribute find_attribute(Element element, std::string_view name) {
  Attribute attribute = element.first_attribute();
  while (attribute && attribute.name() != name) attribute = attribute.next();
  return attribute;
}

/// Of an element with a texture: those of a colour name no channel.
std::vector<AttributeField> texture_fields(TextureAttributes& texture, bool is_number);

/// <name x="1" y="1" z="1"/>: how an element with these fields is written, as far as they are required; with the
/// numbers that `source` has already, if given, in whichever way they are written there: in its text, in its children
/// or in attributes of other names.
std::string example_of(std::string_view element, std::span<const AttributeField> fields, Element source = Element());

/// Where a field's value goes. A string_view is a label, such as a name: it views the Document's text.
using FieldTarget = std::variant<double*, int*, bool*, ChoiceReference, std::string_view*, Vec3d*, Vec2d*, Rgb<double>*,
                                 FileName*, NumberGroups*, WordOrGroups*, Transform*, Reference*>;

/// The attributes of vectors and colors, in the order of their members; none of other values.
std::span<const std::string_view> component_names(const FieldTarget& target);

/// Reads the element. Reports what is wrong with it as a value for that target; false if there was an error.
/// texture: receives the texture of a number or a colour, whose value then is 1 if the element has none; null: textures
/// are refused.
bool read_value(Element element, const FieldInfo& info, const FieldTarget& target, const ReadContext& context,
                TextureAttributes* texture = nullptr);

/// How such an element is written, for messages. parent: the element that it is in.
std::string example_value(const FieldInfo& info, const FieldTarget& target, std::string_view parent);

}  // namespace raytrace
