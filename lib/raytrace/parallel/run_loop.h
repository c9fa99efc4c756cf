// The loop of for_each_index() on oneTBB's threads. The thread sanitizer's build has a header of this name that it can
// see through (tests/sanitizers/threads).
#pragma once

#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace raytrace {

/// Arenas that no loop is in, by their numbers of threads. They are used again, since oneTBB (2021.8) loses some 7 kB
/// with each that ends; and by one loop at a time, so that loops within loops, and those of several threads that call
/// the library, share no threads' places.
class IdleArenas {
 public:
  using Arena = std::unique_ptr<tbb::task_arena>;

  /// Those of the process. Never destroyed: a loop may run while the process ends.
  static IdleArenas& all() {
    static auto* const arenas = new IdleArenas;
    return *arenas;
  }

  Arena take(int workers) {
    const std::scoped_lock lock(mutex_);
    std::vector<Arena>& idle = arenas_[workers];
    if (idle.empty()) return std::make_unique<tbb::task_arena>(workers);
    Arena arena = std::move(idle.back());
    idle.pop_back();
    return arena;
  }

  void put_back(int workers, Arena arena) {
    const std::scoped_lock lock(mutex_);
    arenas_[workers].push_back(std::move(arena));
  }

 private:
  std::mutex mutex_;
  std::map<int, std::vector<Arena>> arenas_;
};

/// Calls f(i) for each i in [0, count), by so many threads. An arena whose loop throws is not used again.
inline void run_loop(int count, int workers, const std::function<void(int)>& f) {
  IdleArenas::Arena arena = IdleArenas::all().take(workers);
  arena->execute([&] { tbb::parallel_for(0, count, f, tbb::simple_partitioner()); });
  IdleArenas::all().put_back(workers, std::move(arena));
}

}  // namespace raytrace
