#include "raytrace/description/read_context.h"

namespace raytrace {

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
