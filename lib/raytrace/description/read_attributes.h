// Reads the attributes of an element such as <center x="0" y="0" z="0"/> into variables.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "raytrace/description/keyframes.h"

namespace raytrace {

struct AttributeField {
  std::string_view name;
  std::variant<double*, Interpolation*> target;
  Range range = Range::any;
  bool required = true;
};

/// Reports attributes that are unknown, missing or malformed; false if there are any.
/// example_shown: an error has shown already how the element is written, so none need say what is missing.
bool read_attributes(Element element, std::span<const AttributeField> fields, bool example_shown,
                     const ReadContext& context);

/// <name x="1" y="1" z="1"/>: how an element with these fields is written, as far as they are required; with the
/// numbers that `source` has already, if given, in whichever way they are written there: in its text, in its children
/// or in attributes of other names.
std::string example_of(std::string_view element, std::span<const AttributeField> fields, Element source = Element());

}  // namespace raytrace
