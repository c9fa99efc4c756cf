// Turns a text into a number or a boolean: wholly or not at all, and the same in every locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "raytrace/parameters/fields.h"

namespace raytrace {

/// Why a text or value is refused, worded to follow it in quotes: "is not a number; write one such as 1.5".
using OptionalMessage = std::optional<std::string>;

// `value` is set only if there is no message.

/// A decimal number such as 1, -0.5, .5 or 1e-3; white space around it and a leading + are fine. It must be finite and
/// within the range and the limits of fields.h.
OptionalMessage parse_number(std::string_view text, Range range, double& value);

/// A whole number without point or exponent.
OptionalMessage parse_integer(std::string_view text, Range range, int& value);

/// true, false, 1 or 0.
OptionalMessage parse_boolean(std::string_view text, bool& value);

/// Numbers with white space between them, and commas between groups of them: "0 1 2, 2 3 0". Without a comma all are
/// one group.
OptionalMessage parse_groups(std::string_view text, NumberGroups& groups);

/// One of the value's words, or numbers as parse_groups() takes them.
OptionalMessage parse_word_or_groups(std::string_view text, WordOrGroups& value);

/// One of the choice's words.
OptionalMessage parse_choice(std::string_view text, const ChoiceReference& choice);

// The rules for values, wherever they come from. Those above keep them, too.

OptionalMessage check_value(double value, Range range);
OptionalMessage check_value(int value, Range range);
inline OptionalMessage check_value(bool, Range) { return std::nullopt; }
OptionalMessage check_value(const ChoiceReference& choice, Range range);
OptionalMessage check_value(const std::string& value, Range range);  ///< a name
OptionalMessage check_value(const FileName& value, Range range);
OptionalMessage check_value(const NumberGroups& value, Range range);
OptionalMessage check_value(const Reference& value, Range range);
OptionalMessage check_value(const WordOrGroups& value, Range range);

/// Of a text that XML allows and that has no white space at its ends, as one that was read.
OptionalMessage check_label(std::string_view text);

/// Of a vector or a color whose field has this range.
inline Range range_of_components(Range range) { return range == Range::nonzero ? Range::any : range; }

/// Whether the vector is long enough for the range `nonzero`.
bool is_direction(const Vec3d& vector);

/// The shortest text that parse_number turns into exactly this number.
std::string number_text(double value);

// As reading takes it.
inline std::string value_text(double value) { return number_text(value); }
inline std::string value_text(int value) { return std::to_string(value); }
inline std::string value_text(bool value) { return value ? "true" : "false"; }
inline std::string value_text(const std::string& value) { return value; }
inline std::string value_text(const FileName& value) { return value.path; }
inline std::string value_text(const Reference& value) { return value.name; }
std::string value_text(const NumberGroups& value);
std::string value_text(const WordOrGroups& value);
std::string value_text(const ChoiceReference& choice);

}  // namespace raytrace
