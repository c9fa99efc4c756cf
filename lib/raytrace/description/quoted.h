// Text from a scene file, made fit to stand in a message.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace raytrace {

/// The text, cut to a length that a line of a terminal holds; bytes that are no printable ASCII are shown as \xNN,
/// except for whole UTF-8 characters.
std::string printable(std::string_view text);

/// 'text', printable.
std::string in_quotes(std::string_view text);

/// <name> and </name>, printable.
std::string tag(std::string_view name);
std::string closing_tag(std::string_view name);

/// "<a>, <b> and <c>"; "nothing" for none.
std::string list_of_tags(std::span<const std::string_view> names);

}  // namespace raytrace
