#include "raytrace/text/message.h"

#include <locale.h>

#include <algorithm>
#include <array>
#include <cstdarg>
#include <cstddef>
#include <cstdio>

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

constexpr std::size_t longest = 64;
constexpr std::size_t most_candidates = 10000;

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

std::string on_one_line(std::string_view text) { return shown(text, text.size()); }

std::string printable(std::string_view text) { return shown(text, most_shown); }

std::string in_quotes(std::string_view text) { return std::string("'").append(printable(text)).append("'"); }

std::string tag(std::string_view name) { return std::string("<").append(printable(name)).append(">"); }

std::string closing_tag(std::string_view name) { return std::string("</").append(printable(name)).append(">"); }

std::string list_of_tags(std::span<const std::string_view> names, const char* last_word) {
  if (names.empty()) return "nothing";
  std::string list = tag(names[0]);
  for (std::size_t i = 1; i < names.size(); ++i)
    list.append(i + 1 < names.size() ? ", " : ' ' + std::string(last_word) + ' ').append(tag(names[i]));
  return list;
}

std::size_t edit_distance(std::string_view a, std::string_view b, std::size_t limit) {
  const std::size_t difference = a.size() > b.size() ? a.size() - b.size() : b.size() - a.size();
  if (difference > limit || a.size() > longest || b.size() > longest) return limit + 1;

  // What is the same at both ends costs nothing, and is most of two similar names.
  while (!a.empty() && !b.empty() && lower(a.front()) == lower(b.front())) a.remove_prefix(1), b.remove_prefix(1);
  while (!a.empty() && !b.empty() && lower(a.back()) == lower(b.back())) a.remove_suffix(1), b.remove_suffix(1);

  // rows[i % 3][j]: the distance of the first i letters of a from the first j of b.
  std::array<std::array<std::size_t, longest + 1>, 3> rows;
  for (std::size_t j = 0; j <= b.size(); ++j) rows[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    auto& row = rows[i % 3];
    const auto& last = rows[(i + 2) % 3];
    const auto& before_last = rows[(i + 1) % 3];
    row[0] = i;
    std::size_t best = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const char x = lower(a[i - 1]), y = lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (x == y ? 0 : 1)});
      const bool swapped = i > 1 && j > 1 && x == lower(b[j - 2]) && y == lower(a[i - 2]);
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
      best = std::min(best, row[j]);
    }
    if (best > limit) return limit + 1;
  }
  return std::min(rows[a.size() % 3][b.size()], limit + 1);
}

std::string_view nearest_name(std::string_view name, std::span<const std::string_view> candidates) {
  if (name.size() > longest) return {};
  std::string_view nearest;
  std::size_t limit = std::max<std::size_t>(1, name.size() / 3);
  for (const std::string_view candidate : candidates.first(std::min(candidates.size(), most_candidates))) {
    const std::size_t distance = edit_distance(name, candidate, limit);
    // A distance of all the letters means that nothing is left of the name.
    if (distance > limit || distance >= std::max(name.size(), candidate.size())) continue;
    nearest = candidate;
    if (distance == 0) break;
    limit = distance - 1;
  }
  return nearest;
}

std::string formatted(const char* format, ...) {
  char text[128];
  // With a point, whatever locale a program that embeds the library has set: of this thread alone, and for this alone.
  static const locale_t c = newlocale(LC_ALL_MASK, "C", nullptr);
  const locale_t before = uselocale(c);
  std::va_list values;
  va_start(values, format);
  std::vsnprintf(text, sizeof text, format, values);
  va_end(values);
  uselocale(before);
  return text;
}

}  // namespace raytrace
