// Reports what stands in an element that must not.
#pragma once

#include <span>

#include "raytrace/description/read_value.h"
#include "raytrace/xml/diagnostics.h"
#include "raytrace/xml/document.h"

namespace raytrace {

/// Reports the attributes of an element that takes none; children: what it takes instead. False if there were any.
bool refuse_attributes(Element element, std::span<const FieldInfo> children, Diagnostics& diagnostics);

/// Reports a text among the children of an element that takes only elements. True if `node` is one.
bool refuse_text(Node node, Element parent, Diagnostics& diagnostics);

}  // namespace raytrace
