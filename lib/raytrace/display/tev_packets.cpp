#include "raytrace/display/tev_packets.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>

namespace raytrace {

namespace {

constexpr int channels = 4;
constexpr const char* channel_names[channels] = {"R", "G", "B", "A"};

class Packet {
 public:
  explicit Packet(std::uint8_t operation) : bytes_(sizeof(std::uint32_t), '\0') { add(operation); }

  template <class Number>
  void add(Number number) {
    const auto bits = static_cast<std::make_unsigned_t<Number>>(number);
    for (unsigned shift = 0; shift < 8 * sizeof bits; shift += 8) bytes_ += static_cast<char>(bits >> shift & 0xffU);
  }

  void add(const std::string& text) { bytes_.append(text.c_str(), std::strlen(text.c_str()) + 1); }

  void add(std::span<const Pixel> pixels) {
    static_assert(sizeof(Pixel) == channels * sizeof(float));
    if constexpr (std::endian::native == std::endian::little) {
      bytes_.append(reinterpret_cast<const char*>(pixels.data()), pixels.size_bytes());
    } else {
      for (const Pixel& pixel : pixels) {
        for (const float value : {pixel.red, pixel.green, pixel.blue, pixel.alpha}) {
          add(std::bit_cast<std::uint32_t>(value));
        }
      }
    }
  }

  void reserve(std::size_t bytes) { bytes_.reserve(bytes_.size() + bytes); }

  /// With its length.
  std::string finished() && {
    Packet length(0);
    length.bytes_.clear();
    length.add(static_cast<std::uint32_t>(bytes_.size()));
    bytes_.replace(0, length.bytes_.size(), length.bytes_);
    return std::move(bytes_);
  }

 private:
  std::string bytes_;
};

}  // namespace

std::string create_image_packet(const std::string& image_name, int width, int height) {
  constexpr std::uint8_t create_image = 4, grab_focus = 1;
  Packet packet(create_image);
  packet.add(grab_focus);
  packet.add(image_name);
  packet.add(std::int32_t{width});
  packet.add(std::int32_t{height});
  packet.add(std::int32_t{channels});
  for (const char* const name : channel_names) packet.add(std::string(name));
  return std::move(packet).finished();
}

std::string update_image_packet(const std::string& image_name, const Region& rectangle, const Pixel* pixels,
                                std::size_t pitch) {
  constexpr std::uint8_t update_image = 6, grab_focus = 0;
  Packet packet(update_image);
  const auto width = static_cast<std::size_t>(rectangle.width());
  packet.reserve(image_name.size() + width * static_cast<std::size_t>(rectangle.height()) * sizeof(Pixel) + 128);
  packet.add(grab_focus);
  packet.add(image_name);
  packet.add(std::int32_t{channels});
  for (const char* const name : channel_names) packet.add(std::string(name));
  packet.add(std::int32_t{rectangle.x0});
  packet.add(std::int32_t{rectangle.y0});
  packet.add(std::int32_t{rectangle.width()});
  packet.add(std::int32_t{rectangle.height()});
  // Where each channel's first value stands among the floats, and how far it is from one pixel to the next.
  for (int channel = 0; channel < channels; ++channel) packet.add(std::int64_t{channel});
  for (int channel = 0; channel < channels; ++channel) packet.add(std::int64_t{channels});
  for (int y = rectangle.y0; y < rectangle.y1; ++y, pixels += pitch) packet.add(std::span(pixels, width));
  return std::move(packet).finished();
}

}  // namespace raytrace
