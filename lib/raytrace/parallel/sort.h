// Sorting on several threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

/// Sorts as std::sort does: runs of the items by up to `threads` threads, which are merged in pairs.
template <class Item, class Less>
void sort(std::vector<Item>& items, int threads, const Less& less) {
  constexpr std::size_t least_items = 1U << 14U;  // that are worth a thread
  int runs = 1;
  while (2 * runs <= worker_count(threads) && items.size() / static_cast<std::size_t>(2 * runs) >= least_items)
    runs *= 2;
  const auto start = [&](int run) {
    const auto place = items.size() * static_cast<std::size_t>(run) / static_cast<std::size_t>(runs);
    return items.begin() + static_cast<std::ptrdiff_t>(place);
  };
  for_each_index(runs, threads, [&](int run) { std::sort(start(run), start(run + 1), less); });
  for (int sorted = 1; sorted < runs; sorted *= 2)
    for_each_index(runs / (2 * sorted), threads, [&](int pair) {
      const int first = 2 * sorted * pair;
      std::inplace_merge(start(first), start(first + sorted), start(first + 2 * sorted), less);
    });
}

}  // namespace raytrace
