#include "raytrace/display/display_server.h"

#include <algorithm>
#include <array>
#include <asio/buffer.hpp>
#include <asio/connect.hpp>
#include <asio/error.hpp>
#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <bit>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <type_traits>

namespace raytrace {

namespace {

using Clock = std::chrono::steady_clock;
using asio::ip::tcp;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr seconds patience{5}, patience_in_hurry{1}, longest_hurry{5};
constexpr milliseconds between_looks{50};  // at whether there is a hurry

constexpr int channels = 4;
constexpr const char* channel_names[channels] = {"R", "G", "B", "A"};

template <class Number>
void append(std::string& packet, Number number) {
  const auto bits = static_cast<std::make_unsigned_t<Number>>(number);
  for (unsigned shift = 0; shift < 8 * sizeof bits; shift += 8) packet += static_cast<char>(bits >> shift & 0xffU);
}

void append(std::string& packet, const std::string& text) {
  packet.append(text.c_str(), std::strlen(text.c_str()) + 1);
}

void append(std::string& packet, std::span<const Pixel> pixels) {
  static_assert(sizeof(Pixel) == channels * sizeof(float));
  if constexpr (std::endian::native == std::endian::little) {
    packet.append(reinterpret_cast<const char*>(pixels.data()), pixels.size_bytes());
  } else {
    for (const Pixel& pixel : pixels)
      for (const float value : {pixel.red, pixel.green, pixel.blue, pixel.alpha})
        append(packet, std::bit_cast<std::uint32_t>(value));
  }
}

template <class... Fields>
void append_all(std::string& packet, const Fields&... fields) {
  (append(packet, fields), ...);
}

/// The fields of a packet, behind its length.
std::string packet_of(const std::string& fields) {
  std::string packet;
  append(packet, static_cast<std::uint32_t>(sizeof(std::uint32_t) + fields.size()));
  return packet + fields;
}

}  // namespace

std::string shown_name(const DisplayAddress& address) {
  const bool is_ipv6 = address.host.find(':') != std::string::npos;
  return (is_ipv6 ? "[" + address.host + "]" : address.host) + ":" + address.port;
}

struct DisplayServer::Connection {
  explicit Connection(const std::atomic<bool>& hurry_flag) : hurry(hurry_flag) {}

  /// Lets what was begun go on until it is done.
  void wait_for(const bool& done) {
    const Clock::time_point start = Clock::now();
    while (!done) {
      context.restart();
      context.run_one_for(between_looks);
      const Clock::time_point now = Clock::now();
      if (hurry && !hurry_start) hurry_start = now;
      const Clock::time_point end =
          hurry_start ? std::min(std::max(start, *hurry_start) + patience_in_hurry, *hurry_start + longest_hurry)
                      : start + patience;
      if (!fault.empty()) throw DisplayError(fault);
      if (!done && now > end) throw DisplayError("no answer in time");
    }
  }

  /// Looks out for the viewer's end of the connection. Whatever comes is a fault: tev sends nothing.
  void listen() {
    socket.async_read_some(asio::buffer(received), [this](const asio::error_code& error, std::size_t size) {
      if (size > 0) {
        fault = "it answers, which tev never does";
      } else if (error == asio::error::eof && finishing) {
        closed = true;
      } else {
        fault = error == asio::error::eof ? "it hung up" : error.message();
      }
    });
  }

  const std::atomic<bool>& hurry;
  std::optional<Clock::time_point> hurry_start;
  asio::io_context context;
  tcp::socket socket{context};
  std::array<char, 64> received{};
  std::string fault;  ///< why nothing more can be sent
  bool finishing = false, closed = false;
};

DisplayServer::DisplayServer(const DisplayAddress& address, const std::atomic<bool>& hurry)
    : connection_(std::make_unique<Connection>(hurry)) {
  asio::error_code error;
  const auto endpoints = tcp::resolver(connection_->context).resolve(address.host, address.port, error);
  if (error) throw DisplayError(error.message());
  bool connected = false;
  asio::async_connect(connection_->socket, endpoints,
                      [&connected, &fault = connection_->fault](const asio::error_code& failure, const tcp::endpoint&) {
                        if (failure) fault = failure.message();
                        connected = true;
                      });
  connection_->wait_for(connected);
  connection_->listen();
}

DisplayServer::~DisplayServer() = default;

void DisplayServer::send(const std::string& bytes) {
  std::size_t sent = 0;
  while (sent < bytes.size()) {
    bool done = false;
    connection_->socket.async_write_some(asio::buffer(bytes.data() + sent, bytes.size() - sent),
                                         [&](const asio::error_code& error, std::size_t size) {
                                           if (error) connection_->fault = error.message();
                                           sent += size;
                                           done = true;
                                         });
    connection_->wait_for(done);
  }
}

void DisplayServer::finish() {
  // A viewer that has hung up before has not read all.
  connection_->context.restart();
  connection_->context.poll();
  if (!connection_->fault.empty()) throw DisplayError(connection_->fault);
  connection_->finishing = true;
  asio::error_code gone;  // the reading side reports it
  connection_->socket.shutdown(tcp::socket::shutdown_send, gone);
  connection_->wait_for(connection_->closed);
}

std::string create_image_packet(const std::string& image_name, int width, int height) {
  constexpr std::uint8_t create_image = 4, grab_focus = 1;
  std::string fields;
  append_all(fields, create_image, grab_focus, image_name, std::int32_t{width}, std::int32_t{height},
             std::int32_t{channels});
  for (const char* const name : channel_names) append(fields, std::string(name));
  return packet_of(fields);
}

std::string update_image_packet(const std::string& image_name, const Region& rectangle, const Pixel* pixels,
                                std::size_t pitch) {
  constexpr std::uint8_t update_image = 6, grab_focus = 0;
  const auto width = static_cast<std::size_t>(rectangle.width());
  std::string fields;
  fields.reserve(image_name.size() + width * static_cast<std::size_t>(rectangle.height()) * sizeof(Pixel) + 128);
  append_all(fields, update_image, grab_focus, image_name, std::int32_t{channels});
  for (const char* const name : channel_names) append(fields, std::string(name));
  append_all(fields, std::int32_t{rectangle.x0}, std::int32_t{rectangle.y0}, std::int32_t{rectangle.width()},
             std::int32_t{rectangle.height()});
  // The index of each channel's first value among the floats, and how far it is from one pixel to the next.
  for (int channel = 0; channel < channels; ++channel) append(fields, std::int64_t{channel});
  for (int channel = 0; channel < channels; ++channel) append(fields, std::int64_t{channels});
  for (int y = rectangle.y0; y < rectangle.y1; ++y, pixels += pitch) append(fields, std::span(pixels, width));
  return packet_of(fields);
}

}  // namespace raytrace
