// What XML makes of characters.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace raytrace::xml {

enum CharacterClass : std::uint8_t {
  space = 1,
  name_start = 2,
  name_part = 4,
  text_end = 8,
  value_end = 16,
  plain = 32,  ///< stands for itself in every value, and may be anywhere in it but for spaces
};

inline constexpr std::array<std::uint8_t, 256> character_classes = [] {
  std::array<std::uint8_t, 256> classes{};
  for (const char c : {' ', '\t', '\n', '\r'}) classes[static_cast<unsigned char>(c)] |= space;
  for (std::size_t c = 0; c < 256; ++c) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == ':' || c >= 0x80;
    if (letter) classes[c] |= name_start | name_part;
    if ((c >= '0' && c <= '9') || c == '-' || c == '.') classes[c] |= name_part;
    if (c >= ' ') classes[c] |= plain;
  }
  for (const char c : {'\0', '<', '&', ']'}) classes[static_cast<unsigned char>(c)] |= text_end;
  for (const char c : {'\0', '<', '&', '"', '\''}) classes[static_cast<unsigned char>(c)] |= value_end;
  // '$' starts the scene format's variables.
  for (const char c : {'<', '>', '&', '"', '\'', '$'})
    classes[static_cast<unsigned char>(c)] &= static_cast<std::uint8_t>(~plain);
  return classes;
}();

inline bool is(char c, std::uint8_t classes) {
  return (character_classes[static_cast<unsigned char>(c)] & classes) != 0;
}

/// The value of a hexadecimal digit; 16 of any other character.
inline std::uint32_t digit(char c) {
  if (c >= '0' && c <= '9') return static_cast<std::uint32_t>(c - '0');
  if (c >= 'a' && c <= 'f') return static_cast<std::uint32_t>(c - 'a' + 10);
  if (c >= 'A' && c <= 'F') return static_cast<std::uint32_t>(c - 'A' + 10);
  return 16;
}

/// Whether texts may have it, by its number.
inline bool allowed(std::uint32_t character) {
  if (character < 0x20) return character == '\t' || character == '\n' || character == '\r';
  const bool surrogate = character >= 0xd800 && character <= 0xdfff;
  return character <= 0x10ffff && !surrogate && character != 0xfffe && character != 0xffff;
}

}  // namespace raytrace::xml
