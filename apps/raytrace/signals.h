// What signals ask of a render: SIGINT, SIGTERM, SIGHUP, SIGXCPU and SIGUSR2 to stop, SIGUSR1 to write the picture so
// far.
#pragma once

#include <csignal>
#include <string>

#include "raytrace/batch/render_observer.h"

namespace raytrace {

/// While it lives, the first signal to stop asks for that, and a second one, of whichever number, ends the program at
/// once; SIGUSR1 asks for the picture. A signal that whoever started the program wants ignored (as nohup does SIGHUP)
/// stays ignored. One object at a time.
class Signals {
 public:
  Signals();
  ~Signals();
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;
};

/// What signals ask of the render that runs.
RenderControl& signal_control();

/// The signal that asked to stop; 0 while there was none.
int stop_signal();

/// "SIGINT"
std::string stop_signal_name();

/// While it lives, a signal to stop ends the program at once, with this exit code: until there are rays, there is
/// nothing to write. One that is to be ignored stays ignored. A Signals object that is made meanwhile takes over.
class StopEndsProgram {
 public:
  explicit StopEndsProgram(int exit_code);
  ~StopEndsProgram();
  StopEndsProgram(const StopEndsProgram&) = delete;
  StopEndsProgram& operator=(const StopEndsProgram&) = delete;
};

/// While it lives, signals to stop wait: neither this thread nor those that it starts are ended by them. For moments in
/// which a temporary file would stay behind.
class StopSignalsWait {
 public:
  StopSignalsWait();
  ~StopSignalsWait();
  StopSignalsWait(const StopSignalsWait&) = delete;
  StopSignalsWait& operator=(const StopSignalsWait&) = delete;

 private:
  sigset_t before_;
};

}  // namespace raytrace
