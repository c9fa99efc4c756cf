// Sorting large numbers of small things by a number that each has, on several threads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

/// Sorts by item.key, 32 bits, ascending; items of the same key keep their order. The result does not depend on
/// `threads`. A radix sort: digit by digit, the last one first, each item goes behind all that have a smaller digit and
/// those before it that have the same. It never compares two items, which a processor could not foresee the outcome of.
template <class Item>
void radix_sort(std::vector<Item>& items, int threads) {
  constexpr unsigned digit_bits = 11;
  constexpr std::size_t digits = std::size_t{1} << digit_bits;
  std::vector<Item> sorted(items.size());
  std::vector<std::array<std::uint32_t, digits>> starts(chunk_count(items.size()));  // of each chunk's, by digit
  for (unsigned shift = 0; shift < 32; shift += digit_bits) {
    const auto digit = [shift](const Item& item) { return item.key >> shift & (digits - 1); };
    for_each_chunk(items.size(), threads, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      starts[chunk].fill(0);
      for (std::size_t i = first; i < last; ++i) ++starts[chunk][digit(items[i])];
    });
    std::uint32_t start = 0;
    for (std::size_t value = 0; value < digits; ++value)
      for (auto& of_chunk : starts) {
        const std::uint32_t count = of_chunk[value];
        of_chunk[value] = start;
        start += count;
      }
    for_each_chunk(items.size(), threads, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) sorted[starts[chunk][digit(items[i])]++] = items[i];
    });
    items.swap(sorted);
  }
}

}  // namespace raytrace
