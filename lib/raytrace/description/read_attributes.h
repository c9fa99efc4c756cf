// Reads the attributes of an element such as <center x="0" y="0" z="0"/> into variables.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "raytrace/description/keyframes.h"
#include "raytrace/parameters/fields.h"
#include "raytrace/xml/diagnostics.h"
#include "raytrace/xml/document.h"

namespace raytrace {

struct AttributeField {
  std::string_view name;
  std::variant<double*, Interpolation*> target;
  Range range = Range::any;
  bool required = true;
};

/// Reports attributes that are unknown, missing or malformed; false if there are any.
/// example_shown: a report has told already how the element is written, so none need say what is missing.
bool read_attributes(Element element, std::span<const AttributeField> fields, bool example_shown,
                     Diagnostics& diagnostics);

/// <name x="1" y="1" z="1"/>: how an element with these fields is written, as far as they are required.
std::string example_of(std::string_view element, std::span<const AttributeField> fields);

/// The same with the numbers that `source` has already, in whichever way they are written there: in its text, in its
/// children or in attributes of other names.
std::string own_example(std::string_view element, std::span<const AttributeField> fields, Element source);

}  // namespace raytrace
