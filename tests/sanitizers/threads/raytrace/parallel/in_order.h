// The library's header of this name, on threads of the standard library, as run_loop.h beside it.
#pragma once

#include <tbb/task_arena.h>

#include <condition_variable>
#include <cstddef>
#include <mutex>

#include "raytrace/parallel/run_loop.h"

namespace raytrace {

template <class Slots, class Make, class Take>
void in_order(std::size_t count, Slots& slots, tbb::task_arena& arena, Make&& make, Take&& take) {
  std::mutex mutex;
  std::condition_variable changed;
  std::size_t next = 0, taken = 0;
  bool failed = false;
  run_in_threads(arena.max_concurrency(), [&] {
    std::unique_lock lock(mutex);
    try {
      while (true) {
        changed.wait(lock, [&] { return failed || next == count || next < taken + slots.size(); });
        if (failed || next == count) return;
        const std::size_t i = next++;
        auto& slot = slots[i % slots.size()];
        lock.unlock();
        make(i, slot);
        lock.lock();
        changed.wait(lock, [&] { return failed || taken == i; });
        if (failed) return;
        take(i, slot);
        ++taken;
        changed.notify_all();
      }
    } catch (...) {
      if (!lock.owns_lock()) lock.lock();
      failed = true;
      changed.notify_all();
      throw;
    }
  });
}

}  // namespace raytrace
