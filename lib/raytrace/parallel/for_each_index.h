// A loop on several threads.
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>

#include "raytrace/parallel/worker_count.h"

namespace raytrace {

/// Calls f(i) for each i in [0, count), by up to `threads` threads (0: all processors) that take one i at a time: each
/// should be worth some microseconds. Throws what f throws.
template <class Function>
void for_each_index(int count, int threads, const Function& f) {
  const int workers = std::min(worker_count(threads), count);
  if (workers <= 1) {
    for (int i = 0; i < count; ++i) f(i);
    return;
  }
  tbb::task_arena(workers).execute([&] { tbb::parallel_for(0, count, f, tbb::simple_partitioner()); });
}

/// How many pieces for_each_chunk() cuts `count` items into: not by the number of threads, so that what is made of a
/// piece does not depend on it.
inline std::size_t chunk_count(std::size_t count) {
  constexpr std::size_t items_a_chunk = std::size_t{1} << 14U;
  return (count + items_a_chunk - 1) / items_a_chunk;
}

/// Calls f(chunk, first, last) for each piece of `count` items, of those in [first, last), as for_each_index() does.
template <class Function>
void for_each_chunk(std::size_t count, int threads, const Function& f) {
  const std::size_t chunks = chunk_count(count);
  for_each_index(static_cast<int>(chunks), threads, [&](int index) {
    const auto chunk = static_cast<std::size_t>(index);
    f(chunk, count * chunk / chunks, count * (chunk + 1) / chunks);
  });
}

}  // namespace raytrace
