// Turns a text into a number or a boolean: wholly or not at all, and the same in every locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "raytrace/parameters/fields.h"

namespace raytrace {

/// What is wrong with a text as a value, worded to follow the quoted text: "is not a number; write one such as 1.5".
using DiagnosticText = std::optional<std::string>;

/// A decimal number such as 1, -0.5, .5 or 1e-3; white space around it and a leading + are fine. It must be finite and
/// within the range and the limits of fields.h. `value` is set only if there is no diagnostic.
DiagnosticText parse_number(std::string_view text, Range range, double& value);

/// A whole number without point or exponent.
DiagnosticText parse_integer(std::string_view text, Range range, int& value);

/// true, false, 1 or 0.
DiagnosticText parse_boolean(std::string_view text, bool& value);

// What is wrong with a value that is there already. Those above find the same.

DiagnosticText check_number(double value, Range range);
DiagnosticText check_integer(int value, Range range);
/// Of a name.
DiagnosticText check_label(std::string_view text);

/// The shortest text that parse_number turns into exactly this number.
std::string number_text(double value);

}  // namespace raytrace
