// What messages are made of: texts of a scene file or a user, made fit to stand in one, the name that someone most
// likely meant, lists and numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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

/// "<a>, <b> and <c>", or another word than "and"; "nothing" for none.
std::string list_of_tags(std::span<const std::string_view> names, const char* last_word = "and");

/// Damerau-Levenshtein distance (optimal string alignment): how many letters must be inserted, removed, replaced or
/// swapped with their neighbour; upper and lower case count as the same letter. Values above `limit` are reported as
/// limit + 1, and cost no more than that takes to find out.
std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t limit);

/// The candidate nearest to `name`, the first of equals; empty if none is so near that it can have been meant (a third
/// of the letters wrong at most), or if `name` is longer than any name a person types. Only the first 10,000
/// candidates are looked at, so that a file of many materials and many errors is still read at once.
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> candidates);

/// "1 object", "2 objects"
inline std::string counted(std::uint64_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

inline std::string joined(const std::vector<std::string>& texts, const char* separator) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : separator) + text;
  return all;
}

/// What printf prints, of at most 127 characters.
[[gnu::format(printf, 1, 2)]] std::string formatted(const char* format, ...);

/// " in 1.250 s"
inline std::string time_taken(double seconds) { return formatted(" in %.3f s", seconds); }

}  // namespace raytrace
