#include "thread_limit.h"

#include <pthread.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <mutex>
#include <vector>

#include "messages.h"

namespace raytrace {

namespace {

/// Until whoever holds it lets it go.
void* wait_at(void* gate) {
  const std::lock_guard passing(*static_cast<std::mutex*>(gate));
  return nullptr;
}

}  // namespace

int threads_with_room(int wanted) {
  if (wanted == 1) return 1;  // there already
  // Of one that traces rays, and of those of OpenEXR and OpenImageIO.
  constexpr std::size_t library_stacks = std::size_t{2} << 20U;
  const std::size_t stack = tbb::global_control::active_value(tbb::global_control::thread_stack_size) + library_stacks;
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, stack);
  std::vector<pthread_t> threads;
  {
    std::mutex gate;
    std::unique_lock closed(gate);
    pthread_t thread{};
    while (static_cast<int>(threads.size()) < wanted && pthread_create(&thread, &attributes, wait_at, &gate) == 0)
      threads.push_back(thread);
    closed.unlock();
    for (const pthread_t started : threads) pthread_join(started, nullptr);
  }
  pthread_attr_destroy(&attributes);
  const int started = static_cast<int>(threads.size());
  return started == wanted ? wanted : std::max(1, started / 2);
}

void log_missing_threads(int wanted, int used) {
  if (used == wanted) return;
  log_warning("there is no room for " + std::to_string(wanted) +
              " threads: " + counted(static_cast<std::uint64_t>(used), "thread") + " used");
}

}  // namespace raytrace
