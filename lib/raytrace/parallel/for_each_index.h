// A loop on several threads.
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "raytrace/parallel/handover.h"
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
  // Static: a worker must find it before it reads any argument of the loop.
  static constinit Handover to_workers, from_workers;
  // A function of its own, so that what the sanitizer finds in it is not taken for oneTBB's.
  const auto call = [&](int i) __attribute__((noinline)) {
    to_workers.take();
    f(i);
    from_workers.give();
  };
  to_workers.give();
  run_loop(
      [&] { tbb::task_arena(workers).execute([&] { tbb::parallel_for(0, count, call, tbb::simple_partitioner()); }); });
  from_workers.take();
}

}  // namespace raytrace
