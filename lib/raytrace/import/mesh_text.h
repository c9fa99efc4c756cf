// Text files of numbers, read by several threads: chunks of lines, words and numbers.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "raytrace/xml/diagnostics.h"

namespace raytrace {

/// Where chunks of whole lines begin, and the end of the text: chunk i is [result[i], result[i + 1]). Lines that a
/// backslash joins are in one chunk. Chunks do not depend on the number of threads.
inline std::vector<std::size_t> line_chunks(std::string_view text) {
  constexpr std::size_t size = std::size_t{1} << 18U;
  std::vector<std::size_t> starts{0};
  while (starts.back() < text.size()) {
    std::size_t end = std::min(starts.back() + size, text.size());
    while (end < text.size()) {
      end = text.find('\n', end);
      if (end == std::string_view::npos) end = text.size();
      const std::string_view before = text.substr(0, end);
      const bool joined = before.ends_with('\\') || before.ends_with("\\\r");
      end = std::min(end + 1, text.size());
      if (!joined) break;
    }
    starts.push_back(end);
  }
  return starts;
}

/// The sums of what is before each chunk, and behind them that of all.
template <class Count>
std::vector<Count> sums_before(const std::vector<Count>& counts) {
  std::vector<Count> sums(counts.size() + 1);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    sums[i + 1] = sums[i];
    sums[i + 1] += counts[i];
  }
  return sums;
}

/// The errors in a chunk, in the order of the text.
class ChunkErrors {
 public:
  void add(std::size_t offset, std::string message) {
    if (++count_ <= Diagnostics::most_kept) kept_.push_back({offset, std::move(message)});
  }
  bool empty() const { return count_ == 0; }

  /// Reports those of all chunks with their lines. False if there are any.
  static bool report(const std::vector<ChunkErrors>& chunks, std::string_view text, Diagnostics& diagnostics) {
    LineMark mark;
    bool any = false;
    for (const ChunkErrors& chunk : chunks) {
      for (std::size_t i = 0; i < chunk.count_; ++i) {
        any = true;
        if (i >= chunk.kept_.size() || !diagnostics.keeps_another(Severity::error)) {
          diagnostics.error({}, {});  // only counted
          continue;
        }
        mark.pass(text.substr(mark.offset, chunk.kept_[i].offset - mark.offset));
        diagnostics.error({mark.line, 0}, chunk.kept_[i].message);
      }
    }
    return !any;
  }

 private:
  std::vector<TextError> kept_;
  std::size_t count_ = 0;
};

namespace detail {

inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// What std::from_chars takes; infinity for what is too large, 0 for what is too small.
inline bool parse_any_decimal(const char*& at, const char* end, double& value) {
  const char* const start = at != end && *at == '+' && end - at > 1 && at[1] != '-' ? at + 1 : at;
  const auto [stop, error] = std::from_chars(start, end, value);
  if (error == std::errc::invalid_argument) return false;
  if (error == std::errc::result_out_of_range) {
    const std::string_view text(start, static_cast<std::size_t>(stop - start));
    const std::size_t exponent = text.find_first_of("eE");
    const bool tiny = exponent == std::string_view::npos ? text.find_first_of("123456789") > text.find('.')
                                                         : text.substr(exponent + 1, 1) == "-";
    value = tiny ? 0 : std::numeric_limits<double>::infinity();
  }
  at = stop;
  return true;
}

}  // namespace detail

/// A decimal number, "nan" or "inf", at the front of [at, end), which then begins behind it. Rounded to the nearest
/// double.
inline bool parse_decimal(const char*& at, const char* end, double& value) {
  // Up to 15 digits are an integer that a double has exactly, and so is a power of ten up to the 22nd: their product or
  // quotient is rounded once (Clinger 1990). That is nearly every number in a mesh.
  static constexpr double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                      1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  const char* p = at;
  const bool minus = p != end && *p == '-';
  if (minus || (p != end && *p == '+')) ++p;
  std::uint64_t mantissa = 0;
  const char* const whole = p;
  for (; p != end && detail::is_digit(*p); ++p) mantissa = 10 * mantissa + static_cast<std::uint64_t>(*p - '0');
  std::ptrdiff_t digits = p - whole, exponent = 0;
  if (p != end && *p == '.') {
    const char* const fraction = ++p;
    for (; p != end && detail::is_digit(*p); ++p) mantissa = 10 * mantissa + static_cast<std::uint64_t>(*p - '0');
    exponent = fraction - p;
    digits -= exponent;
  }
  if (digits == 0 || digits > 15) return detail::parse_any_decimal(at, end, value);
  if (p != end && (*p == 'e' || *p == 'E')) {
    int more = 0;
    const char* const start = end - p > 2 && p[1] == '+' && detail::is_digit(p[2]) ? p + 2 : p + 1;
    const auto [stop, error] = std::from_chars(start, end, more);
    if (error != std::errc() || more < -1000 || more > 1000) return detail::parse_any_decimal(at, end, value);
    exponent += more;
    p = stop;
  }
  if (exponent < -22 || exponent > 22) return detail::parse_any_decimal(at, end, value);
  const auto integer = static_cast<double>(mantissa);
  const double size = exponent < 0 ? integer / powers[-exponent] : integer * powers[exponent];
  value = minus ? -size : size;
  at = p;
  return true;
}

/// The words of a line, which may go on behind a backslash at its end, and end at '#' unless the format has no such
/// comments.
class LineWords {
 public:
  LineWords(const char* at, const char* end, char comment = '#') : at_(at), end_(end), comment_(comment) {}

  /// Moves to the next word; false if there is none.
  bool skip_space() {
    while (at_ != end_ && *at_ == ' ') ++at_;
    if (at_ != end_ && *at_ > ' ' && *at_ != '\\' && *at_ != comment_) [[likely]]
      return true;
    return skip_other_space();
  }

  /// The next word, empty if there is none.
  std::string_view word() {
    if (!skip_space()) return {};
    const char* const start = at_;
    while (!at_word_end()) ++at_;
    return {start, static_cast<std::size_t>(at_ - start)};
  }

  /// How many words are left.
  std::size_t count() const {
    if (at_ == end_) return 0;
    // Without branches, and each character beside the one before it, so that it can be done for many at once.
    unsigned words = is_space(*at_) ? 0 : 1, special = *at_ == '\\' ? 1 : 0;
    for (const char* p = at_ + 1; p != end_; ++p) {
      words += static_cast<unsigned>(is_space(p[-1])) & static_cast<unsigned>(!is_space(*p));
      special |= static_cast<unsigned>(*p == '\\') | static_cast<unsigned>(*p == comment_);
    }
    return special == 0 ? words : count_joined();
  }

  /// The next word as a number. It does not move where that is none.
  bool number(double& value) {
    if (!skip_space()) return false;
    const char* const start = at_;
    if (parse_decimal(at_, end_, value) && at_word_end()) return true;
    at_ = start;
    return false;
  }

  /// The next word as an integer, or the part of it before a '/'.
  bool integer(std::int64_t& value) {
    constexpr std::ptrdiff_t most_digits = 18;
    const bool minus = *at_ == '-';
    const char* p = at_ + (minus || *at_ == '+' ? 1 : 0);
    const char* const digits = p;
    std::int64_t size = 0;
    for (; p != end_ && detail::is_digit(*p) && p - digits < most_digits; ++p) size = 10 * size + (*p - '0');
    if (p == digits) return false;
    value = minus ? -size : size;
    at_ = p;
    return at_word_end() || *at_ == '/';
  }

  /// What is left of the line, without white space around it.
  std::string_view rest() {
    const char* last = end_;
    while (at_ != end_ && is_space(*at_)) ++at_;
    while (last != at_ && is_space(last[-1])) --last;
    return {at_, static_cast<std::size_t>(last - at_)};
  }

  const char* at() const { return at_; }
  const char* end() const { return end_; }
  void advance() { ++at_; }
  bool at_word_end() const { return at_ == end_ || is_space(*at_) || (*at_ == '\\' && is_joint()); }

 private:
  [[gnu::noinline]] bool skip_other_space() {
    while (at_ != end_ && (is_space(*at_) || (*at_ == '\\' && is_joint()))) ++at_;
    if (at_ != end_ && *at_ == comment_) at_ = end_;
    return at_ != end_;
  }
  [[gnu::noinline]] std::size_t count_joined() const {
    std::size_t words = 0;
    for (LineWords left = *this; !left.word().empty(); ++words) {
    }
    return words;
  }
  static bool is_space(char c) { return (c == ' ') | (static_cast<unsigned char>(c - '\t') < 5); }
  bool is_joint() const {
    const std::string_view rest(at_ + 1, static_cast<std::size_t>(end_ - at_ - 1));
    return rest.starts_with('\n') || rest.starts_with("\r\n");
  }

  const char* at_;
  const char* end_;
  char comment_;
};

/// Calls f(start, end) for each line of the text, without its line feed. joined: those that backslashes join are one,
/// unless they begin with '#'. f returns false to stop.
template <bool joined, class Function>
void for_each_line(std::string_view text, const Function& f) {
  const char* at = text.data();
  const char* const last = at + text.size();
  while (at != last) {
    const auto line_end = [&](const char* from) {
      const auto* const end = static_cast<const char*>(std::memchr(from, '\n', static_cast<std::size_t>(last - from)));
      return end == nullptr ? last : end;
    };
    const char* end = line_end(at);
    if constexpr (joined) {
      const auto goes_on = [&] {
        const char* const behind = end != at && end[-1] == '\r' ? end - 1 : end;
        return behind != at && behind[-1] == '\\';
      };
      if (*at != '#')
        while (end != last && goes_on()) end = line_end(end + 1);
    }
    if (!f(at, end)) return;
    at = end == last ? last : end + 1;
  }
}

}  // namespace raytrace
