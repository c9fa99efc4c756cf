// What the readers of elements share: what values depend on, where errors go, and what elements may not hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "raytrace/description/parse_value.h"
#include "raytrace/description/variables.h"
#include "raytrace/text/nearest_name.h"
#include "raytrace/text/quoted.h"
#include "raytrace/xml/diagnostics.h"
#include "raytrace/xml/document.h"
#include "raytrace/xml/xml_characters.h"

namespace raytrace {

struct ReadContext {
  const Variables& variables;
  Diagnostics& diagnostics;
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

}  // namespace raytrace
