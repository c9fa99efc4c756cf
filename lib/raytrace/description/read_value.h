// Reads one child element, such as <radius>1</radius> or <center x="0" y="0" z="0"/>, into a variable.
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "raytrace/description/diagnostics.h"
#include "raytrace/description/document.h"
#include "raytrace/description/fields.h"

namespace raytrace {

struct FieldInfo {
  std::string_view name;
  bool required = true;
  Range range = Range::any;
};

/// Where a field's value goes. A string_view is a label, such as a name: it views the Document's text.
using FieldTarget = std::variant<double*, int*, bool*, std::string*, std::string_view*, Vec3d*, Rgb<double>*>;

/// Reports what is wrong with the element as a value of that kind; false if there was an error.
bool read_value(Element element, const FieldInfo& info, const FieldTarget& target, Diagnostics& diagnostics);

/// How such an element is written, for messages.
std::string example_value(const FieldInfo& info, const FieldTarget& target);

}  // namespace raytrace
