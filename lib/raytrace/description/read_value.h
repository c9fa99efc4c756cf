// Reads one child element, such as <radius>1</radius> or <center x="0" y="0" z="0"/>, into a variable.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "raytrace/description/read_context.h"

namespace raytrace {

/// Where a field's value goes. A string_view is a label, such as a name: it views the Document's text.
using FieldTarget = std::variant<double*, int*, bool*, std::string*, std::string_view*, Vec3d*, Rgb<double>*>;

/// The attributes of vectors and colors, in the order of their members; none of other values.
std::span<const std::string_view> component_names(const FieldTarget& target);

/// Reports what is wrong with the element as a value for that target; false if there was an error.
bool read_value(Element element, const FieldInfo& info, const FieldTarget& target, const ReadContext& context);

/// How such an element is written, for messages.
std::string example_value(const FieldInfo& info, const FieldTarget& target);

}  // namespace raytrace
