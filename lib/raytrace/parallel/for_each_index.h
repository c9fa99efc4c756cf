// A loop on several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace raytrace {

/// Calls f(i) for each i in [0, count), by up to `threads` threads (0: all processors) that take one i at a time: each
/// should be worth some microseconds. Throws what f throws.
void for_each_index(int count, int threads, const std::function<void(int i)>& f);

/// How many pieces for_each_chunk() cuts `count` items into: not by the number of threads, so that what is made of a
/// piece does not depend on it.
std::size_t chunk_count(std::size_t count);

/// Calls f(chunk, first, last) for each piece of `count` items, of those in [first, last), as for_each_index() does.
void for_each_chunk(std::size_t count, int threads,
                    const std::function<void(std::size_t chunk, std::size_t first, std::size_t last)>& f);

/// Calls f(i) for each of so many items, each of which may be worth some nanoseconds.
template <class F>
void for_each_item(std::size_t count, int threads, const F& f) {
  for_each_chunk(count, threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) f(i);
  });
}

}  // namespace raytrace
