// Ctrl-C and its like: the first one asks the render to stop, a second one ends the program at once.
#pragma once

#include <atomic>

namespace raytrace {

/// While it lives, SIGINT and SIGTERM set a flag. A signal that whoever started the program wants ignored stays
/// ignored. One object at a time.
class StopOnSignal {
 public:
  StopOnSignal();
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;

  const std::atomic<bool>& flag() const;

  /// 0 while there was none.
  int signal() const;
};

}  // namespace raytrace
