// A connection to an image viewer that takes pictures over TCP and answers nothing, as tev does. The only user of Asio.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>

#include "raytrace/film/film.h"

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

// What tev receives, port 14158 by default: a picture of a name is made, and rectangles of it are replaced. A packet is
// its length in bytes (uint32, itself included), an operation (uint8) and its fields. Numbers are little endian, texts
// end with a zero byte. (github.com/Tom94/tev, Ipc.h and Ipc.cpp)

/// Operation 4: a black picture with the float channels R, G, B and A. One of the same name is replaced.
std::string create_image_packet(const std::string& image_name, int width, int height);

/// Operation 6: replaces a rectangle. pixels: its first row; the next begins `pitch` pixels after it.
std::string update_image_packet(const std::string& image_name, const Region& rectangle, const Pixel* pixels,
                                std::size_t pitch);

}  // namespace raytrace
