// What XML makes of characters.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

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

/// How many lines end in the text.
inline std::uint32_t line_ends(std::string_view text) {
  std::uint32_t count = 0;
  for (std::size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1)) ++count;
  return count;
}

/// The text without the white space around it.
inline std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is(text.front(), space)) text.remove_prefix(1);
  while (!text.empty() && is(text.back(), space)) text.remove_suffix(1);
  return text;
}

}  // namespace raytrace::xml
