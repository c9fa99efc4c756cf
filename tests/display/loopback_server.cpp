#include "display/loopback_server.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <stdexcept>

namespace raytrace::test {

namespace {

int checked(int result) {
  if (result < 0) throw std::runtime_error("a socket call failed");
  return result;
}

}  // namespace

LoopbackServer::LoopbackServer() : listener_(checked(socket(AF_INET, SOCK_STREAM, 0))) {
  const timeval patience{300, 0};  // then a test fails that waits for a connection
  checked(setsockopt(listener_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience));
  sockaddr_in any_port{};
  any_port.sin_family = AF_INET;
  any_port.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  checked(bind(listener_, reinterpret_cast<const sockaddr*>(&any_port), sizeof any_port));
  checked(listen(listener_, 5));
}

LoopbackServer::~LoopbackServer() { close(listener_); }

DisplayAddress LoopbackServer::address() const {
  sockaddr_in own{};
  socklen_t size = sizeof own;
  checked(getsockname(listener_, reinterpret_cast<sockaddr*>(&own), &size));
  return {"127.0.0.1", std::to_string(ntohs(own.sin_port))};
}

std::string LoopbackServer::take(std::size_t most) const {
  const int connection = checked(accept(listener_, nullptr, nullptr));
  std::string taken;
  char buffer[4096];
  while (taken.size() < most) {
    const ssize_t size = recv(connection, buffer, std::min(sizeof buffer, most - taken.size()), 0);
    if (size <= 0) break;
    taken.append(buffer, static_cast<std::size_t>(size));
  }
  close(connection);
  return taken;
}

}  // namespace raytrace::test
