// The head of a PLY file: what its elements are, and how they are stored.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "raytrace/xml/diagnostics.h"

namespace raytrace::ply {

enum class Type : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

inline std::size_t size_of(Type type) {
  static constexpr std::array<std::uint8_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}
inline bool is_float(Type type) { return type >= Type::float32; }

struct Property {
  std::string name;
  Type type = Type::float32;       ///< of the value, or of a list's values
  std::optional<Type> count_type;  ///< of a list's count; no value: no list
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;

  bool has_lists() const;
  /// The number of the property with one of these names.
  std::optional<std::size_t> find(std::initializer_list<std::string_view> names) const;
};

struct Header {
  enum class Format : std::uint8_t { ascii, little_endian, big_endian };
  Format format = Format::ascii;
  std::vector<Element> elements;
  std::vector<std::string> textures;  ///< of "comment TextureFile NAME"
  std::size_t size = 0;               ///< where the elements' values begin
  std::uint32_t lines = 0;            ///< of the head

  /// elements.size() if there is none.
  std::size_t find(std::string_view element) const;
};

/// text: the file's first bytes. Errors name the line.
std::optional<Header> read_header(std::string_view text, Diagnostics& diagnostics);

}  // namespace raytrace::ply
