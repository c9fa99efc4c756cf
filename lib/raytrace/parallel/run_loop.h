// The loop of for_each_index() on oneTBB's threads. The thread sanitizer's build has a header of this name that it can
// see through (tests/sanitizers/threads).
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <functional>

namespace raytrace {

/// Calls f(i) for each i in [0, count), by so many threads.
inline void run_loop(int count, int workers, const std::function<void(int)>& f) {
  tbb::task_arena(workers).execute([&] { tbb::parallel_for(0, count, f, tbb::simple_partitioner()); });
}

}  // namespace raytrace
