// The library's header of this name, on threads of the standard library: what the thread sanitizer's build compiles.
//
// oneTBB is not compiled with the sanitizer, which therefore does not see how oneTBB orders what the threads of a loop
// read and write: every argument of every loop would be a race to it. To suppress these would be to suppress all that
// happens in loops. The standard library's threads and locks it knows.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "raytrace/parallel/worker_count.h"

namespace raytrace {

/// Calls work() in each of `threads` threads, and throws the first exception that one of them threw.
template <class Work>
void run_in_threads(int threads, const Work& work) {
  std::mutex mutex;
  std::exception_ptr error;
  std::vector<std::thread> workers;
  for (int i = 0; i < threads; ++i) {
    workers.emplace_back([&] {
      try {
        work();
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!error) error = std::current_exception();
      }
    });
  }
  for (std::thread& worker : workers) worker.join();
  if (error) std::rethrow_exception(error);
}

template <class Function>
void for_each_index(int count, int threads, const Function& f) {
  const int workers = std::min(worker_count(threads), count);
  if (workers <= 1) {
    for (int i = 0; i < count; ++i) f(i);
    return;
  }
  std::atomic<int> next{0};
  run_in_threads(workers, [&] {
    // Relaxed, so that this counter orders nothing that the loop's calls do.
    for (int i = next.fetch_add(1, std::memory_order_relaxed); i < count;
         i = next.fetch_add(1, std::memory_order_relaxed)) {
      try {
        f(i);
      } catch (...) {
        next.store(count, std::memory_order_relaxed);
        throw;
      }
    }
  });
}

inline std::size_t chunk_count(std::size_t count) {
  constexpr std::size_t items_a_chunk = std::size_t{1} << 14U;
  return (count + items_a_chunk - 1) / items_a_chunk;
}

template <class Function>
void for_each_chunk(std::size_t count, int threads, const Function& f) {
  const std::size_t chunks = chunk_count(count);
  for_each_index(static_cast<int>(chunks), threads, [&](int index) {
    const auto chunk = static_cast<std::size_t>(index);
    f(chunk, count * chunk / chunks, count * (chunk + 1) / chunks);
  });
}

}  // namespace raytrace
