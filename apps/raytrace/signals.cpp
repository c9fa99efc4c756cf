#include "signals.h"

#include <array>
#include <csignal>

namespace raytrace {

namespace {

constexpr std::array<int, 2> stopping_signals = {SIGINT, SIGTERM};

// A signal handler reaches nothing but globals.
std::atomic<bool> stop_flag = false;
std::atomic<int> last_signal = 0;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

void restore_defaults() {
  for (const int number : stopping_signals) {
    struct sigaction action{};
    sigaction(number, nullptr, &action);
    if (action.sa_handler != SIG_IGN) std::signal(number, SIG_DFL);
  }
}

void on_signal(int number) {
  last_signal = number;
  stop_flag = true;
  restore_defaults();
}

}  // namespace

StopOnSignal::StopOnSignal() {
  stop_flag = false;
  last_signal = 0;
  for (const int number : stopping_signals) {
    struct sigaction before{};
    sigaction(number, nullptr, &before);
    if (before.sa_handler == SIG_IGN) continue;
    struct sigaction action{};
    action.sa_handler = on_signal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = SA_RESTART;  // a file that is being written gets whole
    sigaction(number, &action, nullptr);
  }
}

StopOnSignal::~StopOnSignal() { restore_defaults(); }

const std::atomic<bool>& StopOnSignal::flag() const { return stop_flag; }

int StopOnSignal::signal() const { return last_signal; }

}  // namespace raytrace
