// The library's header of this name, on threads of the standard library: what the thread sanitizer's build compiles.
//
// oneTBB is not compiled with the sanitizer, which therefore does not see how oneTBB orders what the threads of a loop
// read and write: every argument of every loop would be a race to it. To suppress these would be to suppress all that
// happens in loops. The standard library's threads and locks it knows.
#pragma once

#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

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

inline void run_loop(int count, int workers, const std::function<void(int)>& f) {
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

}  // namespace raytrace
