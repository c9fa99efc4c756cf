// What signals ask of a render: SIGINT and SIGTERM to stop, SIGUSR1 to write the picture so far.
#pragma once

#include <atomic>

namespace raytrace {

/// While it lives, the first SIGINT or SIGTERM asks to stop, and a second one ends the program at once; SIGUSR1 asks
/// for the picture. A signal that whoever started the program wants ignored stays ignored. One object at a time.
class Signals {
 public:
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  /// Set by each signal, and by whoever else wants the render to pause: its stop flag.
  std::atomic<bool>& pause() const;

  /// The signal that asked to stop; 0 while there was none.
  int stop_signal() const;

  /// Whether the picture was asked for since the last call.
  bool take_picture_request() const;
};

/// SIGUSR1 before and after a render is no reason to end the program, as it would be by default.
void ignore_picture_requests();

}  // namespace raytrace
