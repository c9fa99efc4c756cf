#include "raytrace/display/tev_packets.h"

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

namespace raytrace {

namespace {

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
