// Says in the language's own terms that memory passes from one thread to others and back.
//
// oneTBB orders what the thread that starts a loop and the threads that run it read and write. But it comes as a
// compiled library, so the thread sanitizer does not see how, and would take every argument of a loop for a race. One
// such pair a loop and a tile costs nothing that can be measured, and lets the sanitizer find the true ones.
#pragma once

#include <atomic>
#include <future>

namespace raytrace {

/// For handovers that would cost too much elsewhere.
#if defined(__SANITIZE_THREAD__)
inline constexpr bool thread_sanitized = true;
#elif defined(__has_feature)
inline constexpr bool thread_sanitized = __has_feature(thread_sanitizer);
#else
inline constexpr bool thread_sanitized = false;
#endif

/// What any thread wrote before give() is seen by every thread after a take() that follows it.
class Handover {
 public:
  void give() { count_.fetch_add(1, std::memory_order_release); }
  void take() const { count_.load(std::memory_order_acquire); }

 private:
  std::atomic<int> count_{0};
};

/// Calls run(), in which this thread starts a loop of oneTBB and waits for its end; throws what that throws. oneTBB's
/// workers count what is left to do on the stack of the thread that waits. As the sanitizer does not see the wait, what
/// that thread keeps there next would be a race to it: it gets a stack on which nothing comes next.
template <class Run>
void run_loop(const Run& run) {
  if constexpr (thread_sanitized) {
    std::async(std::launch::async, run).get();
  } else {
    run();
  }
}

}  // namespace raytrace
