#include "signals.h"

#include <array>
#include <csignal>

namespace raytrace {

namespace {

constexpr std::array<int, 2> stopping_signals = {SIGINT, SIGTERM};

// A signal handler reaches nothing but globals.
std::atomic<bool> pause_flag = false;
std::atomic<bool> picture_flag = false;
std::atomic<int> last_signal = 0;
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

bool is_ignored(int number) {
  struct sigaction action{};
  sigaction(number, nullptr, &action);
  return action.sa_handler == SIG_IGN;
}

void handle(int number, void (*handler)(int)) {
  struct sigaction action{};
  action.sa_handler = handler;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART;  // a file that is being written gets whole
  sigaction(number, &action, nullptr);
}

void restore_defaults() {
  for (const int number : stopping_signals) {
    if (!is_ignored(number)) std::signal(number, SIG_DFL);
  }
}

// What is asked comes before the pause: whoever sees the pause sees why.
void on_stop(int number) {
  last_signal = number;
  pause_flag = true;
  restore_defaults();
}

void on_picture_request(int) {
  picture_flag = true;
  pause_flag = true;
}

}  // namespace

Signals::Signals() {
  pause_flag = false;
  picture_flag = false;
  last_signal = 0;
  for (const int number : stopping_signals) {
    if (!is_ignored(number)) handle(number, on_stop);
  }
  handle(SIGUSR1, on_picture_request);
}

Signals::~Signals() {
  restore_defaults();
  ignore_picture_requests();
}

std::atomic<bool>& Signals::pause() const { return pause_flag; }

int Signals::stop_signal() const { return last_signal; }

bool Signals::take_picture_request() const { return picture_flag.exchange(false); }

void ignore_picture_requests() { std::signal(SIGUSR1, SIG_IGN); }

}  // namespace raytrace
