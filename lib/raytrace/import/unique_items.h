// Which of many items are equal, found by several threads.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "raytrace/import/mesh_data.h"
#include "raytrace/memory/large_array.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

/// 64 bits of which each depends on all of the input's (the finalizer of MurmurHash3).
inline std::uint64_t mixed_bits(std::uint64_t bits) {
  bits = (bits ^ bits >> 33U) * 0xff51afd7ed558ccdU;
  bits = (bits ^ bits >> 33U) * 0xc4ceb9fe1a85ec53U;
  return bits ^ bits >> 33U;
}

struct UniqueItems {
  MeshBuffer<std::uint32_t> number;  ///< of each item, among the different ones, in the order of their first appearance
  MeshBuffer<std::uint32_t> first;   ///< of each different one, the first item that is it
};

/// Numbers `count` items, less than 2^31, so that equal ones have the same number. hash(i): mixed bits; equal(i, j).
template <class Hash, class Equal>
UniqueItems unique_items(std::size_t count, int threads, const Hash& hash, const Equal& equal) {
  // Open addressing: a slot belongs to the class of items that came to it first, and ends with the first item of
  // that class. Which slot that is depends on the threads, but nothing else does.
  const std::size_t slots = std::bit_ceil(count + count / 2 + 1);
  auto table = LargeArray<std::uint32_t>::zeros(slots);  // an item plus 1; 0: free
  UniqueItems result;
  result.number = MeshBuffer<std::uint32_t>(count);
  std::uint32_t* const number = result.number.data();
  for_each_chunk(count, threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const auto item = static_cast<std::uint32_t>(i + 1);
      std::size_t slot = hash(i) & (slots - 1);
      while (true) {
        std::atomic_ref entry(table[slot]);
        std::uint32_t found = entry.load(std::memory_order_relaxed);
        if (found == 0 && entry.compare_exchange_strong(found, item, std::memory_order_relaxed)) break;
        if (equal(found - 1, i)) {
          while (found > item && !entry.compare_exchange_weak(found, item, std::memory_order_relaxed)) continue;
          break;
        }
        slot = (slot + 1) & (slots - 1);
      }
      number[i] = static_cast<std::uint32_t>(slot);
    }
  });

  std::vector<std::uint32_t> counts(chunk_count(count) + 1);
  for_each_chunk(count, threads, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) counts[chunk + 1] += table[number[i]] == i + 1 ? 1U : 0U;
  });
  for (std::size_t chunk = 1; chunk < counts.size(); ++chunk) counts[chunk] += counts[chunk - 1];
  result.first = MeshBuffer<std::uint32_t>(counts.back());
  // Then the slot has the number of its class, once all first items are known.
  for_each_chunk(count, threads, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    std::uint32_t next = counts[chunk];
    for (std::size_t i = first; i < last; ++i)
      if (table[number[i]] == i + 1) result.first[next++] = static_cast<std::uint32_t>(i);
  });
  for_each_chunk(result.first.size(), threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) table[number[result.first[i]]] = static_cast<std::uint32_t>(i);
  });
  for_each_chunk(count, threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) number[i] = table[number[i]];
  });
  return result;
}

}  // namespace raytrace
