#include "raytrace/description/refuse_content.h"

#include <algorithm>
#include <string>

#include "raytrace/text/quoted.h"
#include "raytrace/xml/report.h"

namespace raytrace {

bool refuse_attributes(Element element, std::span<const FieldInfo> children, Diagnostics& diagnostics) {
  bool fine = true;
  for (Attribute attribute = element.first_attribute(); attribute; attribute = attribute.next()) {
    fine = false;
    report_error(diagnostics, attribute, [&] {
      const std::string name = printable(attribute.name());
      const bool known = std::any_of(children.begin(), children.end(),
                                     [&](const FieldInfo& info) { return info.name == attribute.name(); });
      return "unexpected attribute " + in_quotes(attribute.name()) + " in " + tag(element.name()) +
             (known ? "; write it as a child element: <" + name + ">...</" + name + ">" : ", which takes none");
    });
  }
  return fine;
}

bool refuse_text(Node node, Element parent, Diagnostics& diagnostics) {
  if (node.element()) return false;
  if (!node.text().empty()) {
    report_error(diagnostics, node, [&] {
      return "unexpected text " + in_quotes(node.text()) + " in " + tag(parent.name()) + ", which takes only elements";
    });
  }
  return true;
}

}  // namespace raytrace
