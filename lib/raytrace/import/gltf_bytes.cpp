// https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html, sections 2.8 (URIs) and 4 (GLB).
#include "raytrace/import/gltf_bytes.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace raytrace::gltf {
namespace {

std::size_t word_at(std::string_view bytes, std::size_t offset) {
  std::size_t word = 0;
  for (std::size_t i = 4; i-- > 0;) word = word << 8U | static_cast<unsigned char>(bytes[offset + i]);
  return word;
}

std::string at_byte(std::size_t offset, const std::string& message) {
  return "byte " + std::to_string(offset) + ": " + message;
}

std::string base64_decoded(std::string_view text) {
  static constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  static const auto values = [] {
    std::array<std::uint8_t, 256> table{};
    table.fill(255);
    for (std::size_t i = 0; i < digits.size(); ++i)
      table[static_cast<unsigned char>(digits[i])] = static_cast<std::uint8_t>(i);
    return table;
  }();
  while (text.ends_with('=')) text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const std::uint32_t value = values[static_cast<unsigned char>(c)];
    if (value > 63) throw Error("its data is not base64");
    bits = bits << 6U | value;
    if ((count += 6) >= 8) bytes += static_cast<char>(bits >> static_cast<unsigned>(count -= 8) & 255U);
  }
  return bytes;
}

}  // namespace

Chunks chunks_of(std::string_view file) {
  if (!file.starts_with("glTF")) return {file, std::nullopt};
  constexpr std::size_t head = 12, chunk_head = 8, json_type = 0x4e4f534a, binary_type = 0x004e4942;
  if (file.size() < head) throw Error(at_byte(file.size(), "the file ends within its head"));
  if (const std::size_t version = word_at(file, 4); version != 2)
    throw Error(at_byte(4, "is GLB of version " + std::to_string(version) + ", and not 2"));
  const std::size_t length = word_at(file, 8);
  if (length < head || length > file.size())
    throw Error(
        at_byte(8, "claims " + std::to_string(length) + " bytes, and the file has " + std::to_string(file.size())));
  file = file.substr(0, length);
  Chunks chunks;
  for (std::size_t offset = head; offset < length;) {
    if (length - offset < chunk_head) throw Error(at_byte(offset, "the file ends within the head of a chunk"));
    const std::size_t size = word_at(file, offset), type = word_at(file, offset + 4);
    const std::size_t room = length - offset - chunk_head;
    if (size > room)
      throw Error(at_byte(
          offset, "claims a chunk of " + std::to_string(size) + " bytes, and there are " + std::to_string(room)));
    const std::string_view chunk = file.substr(offset + chunk_head, size);
    if ((offset == head) != (type == json_type)) throw Error(at_byte(offset + 4, "the first chunk alone must be JSON"));
    if (type == json_type)
      chunks.json = chunk.substr(0, chunk.find_last_not_of('\0') + 1);
    else if (type == binary_type && !chunks.binary)
      chunks.binary = chunk;
    offset += chunk_head + size;
  }
  return chunks;
}

std::string percent_decoded(std::string_view uri) {
  const auto digit = [&](std::size_t i) -> unsigned {
    const char c = i < uri.size() ? uri[i] : ' ';
    if (c >= '0' && c <= '9') return static_cast<unsigned>(c - '0');
    const auto letter = static_cast<unsigned>((static_cast<unsigned char>(c) | 32U) - 'a');
    return letter < 6 ? letter + 10 : 16;
  };
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool is_code = uri[i] == '%' && digit(i + 1) < 16 && digit(i + 2) < 16;
    text += is_code ? static_cast<char>(16 * digit(i + 1) + digit(i + 2)) : uri[i];
    if (is_code) i += 2;
  }
  return text;
}

std::optional<std::string> data_of_uri(std::string_view uri) {
  if (!uri.starts_with("data:")) return std::nullopt;
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) throw Error("is a URI 'data:' without a comma");
  const std::string_view data = uri.substr(comma + 1);
  return uri.substr(0, comma).ends_with(";base64") ? base64_decoded(data) : percent_decoded(data);
}

}  // namespace raytrace::gltf
