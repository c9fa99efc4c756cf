#include "raytrace/parallel/for_each_index.h"

#include <algorithm>

#include "raytrace/parallel/run_loop.h"
#include "raytrace/parallel/worker_count.h"

namespace raytrace {

void for_each_index(int count, int threads, const std::function<void(int)>& f) {
  const int workers = std::min(worker_count(threads), count);
  if (workers <= 1) {
    for (int i = 0; i < count; ++i) f(i);
    return;
  }
  run_loop(count, workers, f);
}

std::size_t chunk_count(std::size_t count) {
  constexpr std::size_t items_a_chunk = std::size_t{1} << 14U;
  return (count + items_a_chunk - 1) / items_a_chunk;
}

void for_each_chunk(std::size_t count, int threads,
                    const std::function<void(std::size_t, std::size_t, std::size_t)>& f) {
  const std::size_t chunks = chunk_count(count);
  for_each_index(static_cast<int>(chunks), threads, [&](int index) {
    const auto chunk = static_cast<std::size_t>(index);
    f(chunk, count * chunk / chunks, count * (chunk + 1) / chunks);
  });
}

}  // namespace raytrace
