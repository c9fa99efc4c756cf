// A viewer on this machine that keeps the bytes it gets.
#pragma once

#include <string>

#include "raytrace/display/display_server.h"

namespace raytrace::test {

class LoopbackServer {
 public:
  LoopbackServer();
  ~LoopbackServer();
  LoopbackServer(const LoopbackServer&) = delete;
  LoopbackServer& operator=(const LoopbackServer&) = delete;

  DisplayAddress address() const;

  /// Waits for a connection, reads so many bytes of it, or all until its end, and hangs up.
  std::string take(std::size_t most = std::string::npos) const;

 private:
  int listener_;
};

}  // namespace raytrace::test
