// Reads one child element, such as <radius>1</radius> or <center x="0" y="0" z="0"/>, into a variable.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "raytrace/parameters/fields.h"
#include "raytrace/xml/diagnostics.h"
#include "raytrace/xml/document.h"

namespace raytrace {

struct FieldInfo {
  std::string_view name;
  bool required = true;
  Range range = Range::any;
};

/// Where a field's value goes. A string_view is a label, such as a name: it views the Document's text.
using FieldTarget = std::variant<double*, int*, bool*, std::string*, std::string_view*, Vec3d*, Rgb<double>*>;

/// The place of the field in `infos`; their number if it is not there.
std::size_t find_field(std::span<const FieldInfo> infos, std::string_view name);

/// The attributes of vectors and colors, in the order of their members; none of other values.
std::span<const std::string_view> component_names(const FieldTarget& target);

/// Of a vector or a color whose field has this range.
inline Range range_of_components(Range range) { return range == Range::nonzero ? Range::any : range; }

/// Whether the vector is long enough for the range `nonzero`.
bool is_direction(const Vec3d& vector);

/// Reports what is wrong with the element as a value of that kind; false if there was an error.
bool read_value(Element element, const FieldInfo& info, const FieldTarget& target, Diagnostics& diagnostics);

/// How such an element is written, for messages.
std::string example_value(const FieldInfo& info, const FieldTarget& target);

}  // namespace raytrace
