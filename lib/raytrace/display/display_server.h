// A connection to an image viewer that takes pictures over TCP and answers nothing, as tev does. The only user of Asio.
#pragma once

#include <atomic>
#include <memory>
#include <stdexcept>
#include <string>

namespace raytrace {

struct DisplayAddress {
  std::string host;  ///< a name or an IP address
  std::string port;
};

/// "localhost:14158", "[::1]:14158"
std::string shown_name(const DisplayAddress& address);

/// The viewer is not there, too slow, gone, or not a viewer; what() says which.
class DisplayError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// All calls block, but not for long: for 5 seconds without any progress, and once `hurry` is set for 1 second, and 5
/// in all. What they throw is a DisplayError; no call but the destructor is allowed after it.
class DisplayServer {
 public:
  /// Connects. Finding the address of a host's name alone may take longer than said above.
  DisplayServer(const DisplayAddress& address, const std::atomic<bool>& hurry);
  ~DisplayServer();
  DisplayServer(const DisplayServer&) = delete;
  DisplayServer& operator=(const DisplayServer&) = delete;

  void send(const std::string& bytes);

  /// Ends the connection and waits for the viewer to do the same, which says that it has read all.
  void finish();

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace raytrace
