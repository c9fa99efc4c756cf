#include "signals.h"

#include <unistd.h>

#include <array>
#include <atomic>

namespace raytrace {

namespace {

/// A person, a terminal that is closed, and what batch systems send before they kill: Slurm and LSF any of them, Grid
/// Engine SIGUSR2, the system SIGXCPU at the limit of `ulimit -t`.
struct StoppingSignal {
  int number;
  const char* name;
};
constexpr std::array<StoppingSignal, 5> stopping_signals = {
    {{SIGINT, "SIGINT"}, {SIGTERM, "SIGTERM"}, {SIGHUP, "SIGHUP"}, {SIGXCPU, "SIGXCPU"}, {SIGUSR2, "SIGUSR2"}}};

// A signal handler reaches nothing but globals.
RenderControl control;
std::atomic<int> last_signal = 0;
std::atomic<int> stop_exit_code = 0;
static_assert(std::atomic<int>::is_always_lock_free);

bool is_ignored(int number) {
  struct sigaction action{};
  sigaction(number, nullptr, &action);
  return action.sa_handler == SIG_IGN;
}

void handle(int number, void (*handler)(int, siginfo_t*, void*)) {
  struct sigaction action{};
  action.sa_sigaction = handler;
  sigemptyset(&action.sa_mask);
  action.sa_flags = SA_RESTART | SA_SIGINFO;  // a file that is being written gets whole
  sigaction(number, &action, nullptr);
}

void restore_defaults() {
  for (const auto& [number, name] : stopping_signals) {
    if (!is_ignored(number)) std::signal(number, SIG_DFL);
  }
}

/// Beyond the limit the system sends one for each second that the processors work, also while the checkpoint is
/// written. A SIGXCPU from anybody else is a second signal.
void on_later_second(int number, siginfo_t* info, void* /*context*/) {
  if (info->si_code == SI_KERNEL) return;
  std::signal(number, SIG_DFL);
  raise(number);
}

void on_stop(int number, siginfo_t* /*info*/, void* /*context*/) {
  last_signal = number;
  control.stop();
  restore_defaults();
  if (!is_ignored(SIGXCPU)) handle(SIGXCPU, on_later_second);
}

void on_early_stop(int /*number*/, siginfo_t* /*info*/, void* /*context*/) { _exit(stop_exit_code); }

void on_picture_request(int /*number*/, siginfo_t* /*info*/, void* /*context*/) { control.request_picture(); }

}  // namespace

Signals::Signals() {
  control.take_picture_request();  // one that came too late for the last render
  for (const auto& [number, name] : stopping_signals) {
    if (!is_ignored(number)) handle(number, on_stop);
  }
  handle(SIGUSR1, on_picture_request);
}

Signals::~Signals() {
  restore_defaults();
  std::signal(SIGUSR1, SIG_IGN);  // as before
}

RenderControl& signal_control() { return control; }

int stop_signal() { return last_signal; }

std::string stop_signal_name() {
  for (const auto& [number, name] : stopping_signals) {
    if (number == last_signal) return name;
  }
  return "";
}

StopEndsProgram::StopEndsProgram(int exit_code) {
  stop_exit_code = exit_code;
  for (const auto& [number, name] : stopping_signals) {
    if (!is_ignored(number)) handle(number, on_early_stop);
  }
}

StopEndsProgram::~StopEndsProgram() { restore_defaults(); }

StopSignalsWait::StopSignalsWait() {
  sigset_t stops;
  sigemptyset(&stops);
  for (const auto& [number, name] : stopping_signals) sigaddset(&stops, number);
  pthread_sigmask(SIG_BLOCK, &stops, &before_);
}

StopSignalsWait::~StopSignalsWait() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

}  // namespace raytrace
