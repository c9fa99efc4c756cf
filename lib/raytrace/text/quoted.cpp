#include "raytrace/text/quoted.h"

#include <cstddef>

#include "raytrace/text/utf8.h"

namespace raytrace {
namespace {

constexpr std::size_t most_shown = 40;  // bytes of the original

/// So many bytes of the text, or a few more where they end within a character.
std::string shown(std::string_view text, std::size_t most) {
  static constexpr char digits[] = "0123456789abcdef";
  std::string result;
  std::size_t i = 0;
  while (i < text.size() && i < most) {
    const unsigned char byte = static_cast<unsigned char>(text[i]);
    const std::size_t length = utf8_length(text.substr(i));
    // U+0080 to U+009F are control characters, too.
    const bool is_control = length == 1 ? byte < 0x20 || byte == 0x7f
                                        : length == 2 && byte == 0xc2 && static_cast<unsigned char>(text[i + 1]) < 0xa0;
    if (length > 0 && !is_control) {
      result.append(text.substr(i, length));
      i += length;
    } else {
      result.append({'\\', 'x', digits[byte >> 4], digits[byte & 15]});
      ++i;
    }
  }
  if (i < text.size()) result += "...";
  return result;
}

}  // namespace

std::string on_one_line(std::string_view text) { return shown(text, text.size()); }

std::string printable(std::string_view text) { return shown(text, most_shown); }

std::string in_quotes(std::string_view text) { return std::string("'").append(printable(text)).append("'"); }

std::string tag(std::string_view name) { return std::string("<").append(printable(name)).append(">"); }

std::string closing_tag(std::string_view name) { return std::string("</").append(printable(name)).append(">"); }

std::string list_of_tags(std::span<const std::string_view> names) {
  if (names.empty()) return "nothing";
  std::string list = tag(names[0]);
  for (std::size_t i = 1; i < names.size(); ++i)
    list.append(i + 1 < names.size() ? ", " : " and ").append(tag(names[i]));
  return list;
}

}  // namespace raytrace
