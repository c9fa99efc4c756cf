// The known name that someone most likely meant.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

namespace raytrace {

/// Damerau-Levenshtein distance (optimal string alignment): how many letters must be inserted, removed, replaced or
/// swapped with their neighbour; upper and lower case count as the same letter. Values above `limit` are reported as
/// limit + 1, and cost no more than that takes to find out.
std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t limit);

/// The candidate nearest to `name`, the first of equals; empty if none is so near that it can have been meant (a third
/// of the letters wrong at most), or if `name` is longer than any name a person types. Only the first 10,000
/// candidates are looked at, so that a file of many materials and many errors is still read at once.
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> candidates);

}  // namespace raytrace
