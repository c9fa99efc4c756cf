// Reads a value that changes from frame to frame:
//
//   <radius> <key frame="1" value="2"/> <key frame="24" value="5" interpolation="smooth"/> </radius>
#pragma once

#include <span>
#include <string_view>

#include "raytrace/parameters/fields.h"
#include "raytrace/xml/diagnostics.h"
#include "raytrace/xml/document.h"

namespace raytrace {

/// The attribute of a number's keys, where those of vectors have x, y and z.
inline constexpr std::string_view number_component = "value";

/// Whether the element has keys among its children.
bool has_keys(Element element);

/// Reads an element that has. components: their attributes, at most 3; values: receive what they are at the frame of
/// the element's variables. False if anything is wrong, which is reported.
bool read_keys(Element element, std::span<const std::string_view> components, std::span<double* const> values,
               Range range, Diagnostics& diagnostics);

}  // namespace raytrace
