#include "raytrace/text/utf8.h"

#include <algorithm>
#include <vector>

#include "raytrace/parallel/for_each_index.h"

namespace raytrace {
namespace {

// All of it is ASCII that XML allows. Compilers turn this loop into SIMD code, and nearly every block is plain.
bool surely_plain(std::string_view block) {
  std::uint8_t plain = 1;
  for (const char c : block) {
    const bool printable = static_cast<signed char>(c) >= 0x20;
    const bool white_space = (c == '\t') | (c == '\n') | (c == '\r');
    plain &= static_cast<std::uint8_t>(printable | white_space);
  }
  return plain != 0;
}

/// The offset of the first invalid byte at which a character of [i, end) would start, all of which ends before
/// `text` does; npos if there is none.
std::size_t find_invalid(std::string_view text, std::size_t i, std::size_t end) {
  constexpr std::size_t block = 4096;
  while (i < end) {
    const std::size_t block_end = std::min(i + block, end);
    if (surely_plain(text.substr(i, block_end - i))) {
      i = block_end;
      continue;
    }
    while (i < block_end) {
      const std::size_t length = utf8_length(text.substr(i));
      if (length == 0) return i;
      i += length;
    }
  }
  return std::string_view::npos;
}

/// The first offset from `i` on at which a character may start, which is at most three bytes on in valid text.
std::size_t character_start(std::string_view text, std::size_t i) {
  const std::size_t last = std::min(i + 3, text.size());
  while (i < last && (static_cast<unsigned char>(text[i]) & 0xc0U) == 0x80U) ++i;
  return i;
}

}  // namespace

bool is_xml_character(std::uint32_t character) {
  if (character < 0x20) return character == '\t' || character == '\n' || character == '\r';
  const bool surrogate = character >= 0xd800 && character <= 0xdfff;
  return character <= 0x10ffff && !surrogate && character != 0xfffe && character != 0xffff;
}

std::size_t utf8_length(std::string_view text) {
  if (text.empty()) return 0;
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])); };
  const std::uint32_t first = byte(0);
  if (first < 0x80) return is_xml_character(first) ? 1 : 0;

  const std::size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || text.size() < length) return 0;
  std::uint32_t character = first & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0u) != 0x80u) return 0;
    character = (character << 6) | (byte(i) & 0x3fu);
  }
  static constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  return character >= least[length] && is_xml_character(character) ? length : 0;
}

std::size_t find_invalid_utf8(std::string_view text, int threads) {
  constexpr std::size_t block = std::size_t{1} << 20U;
  const std::size_t blocks = (text.size() + block - 1) / block;
  std::vector<std::size_t> found(blocks);
  for_each_index(static_cast<int>(blocks), threads, [&](int index) {
    const auto i = static_cast<std::size_t>(index);
    const std::size_t start = i == 0 ? 0 : character_start(text, i * block);
    const std::size_t end = i + 1 == blocks ? text.size() : character_start(text, (i + 1) * block);
    found[i] = find_invalid(text, start, end);
  });
  const auto first =
      std::find_if(found.begin(), found.end(), [](std::size_t at) { return at != std::string_view::npos; });
  return first == found.end() ? std::string_view::npos : *first;
}

}  // namespace raytrace
