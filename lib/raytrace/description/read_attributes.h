// Reads the attributes of an element such as <center x="0" y="0" z="0"/> into variables.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "raytrace/description/diagnostics.h"
#include "raytrace/description/document.h"
#include "raytrace/description/fields.h"
#include "raytrace/description/keyframes.h"

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

/// name="1" name="1": those that are required.
std::string example_of(std::span<const AttributeField> fields);

}  // namespace raytrace
