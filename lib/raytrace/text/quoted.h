// Text from a scene file or a user, made fit to stand in a message.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace raytrace {

/// The text on one line, without anything that a terminal takes for a command: control characters and bytes that are no
/// UTF-8 are shown as \xNN.
std::string on_one_line(std::string_view text);

/// The same, cut to a length that a line of a terminal holds.
std::string printable(std::string_view text);

/// 'text', printable.
std::string in_quotes(std::string_view text);

/// <name> and </name>, printable.
std::string tag(std::string_view name);
std::string closing_tag(std::string_view name);

/// "<a>, <b> and <c>"; "nothing" for none.
std::string list_of_tags(std::span<const std::string_view> names);

}  // namespace raytrace
