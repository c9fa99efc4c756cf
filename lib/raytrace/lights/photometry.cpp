#include "raytrace/lights/photometry.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <limits>

namespace raytrace {

namespace {

constexpr int most_angles = 10'000;
constexpr std::size_t most_values = 4'000'000;

/// The numbers behind the keywords, separated by white space or commas.
class NumberText {
 public:
  explicit NumberText(std::string_view text) : text_(text) {}

  [[noreturn]] void fail(const std::string& message) const {
    throw PhotometryError("line " + std::to_string(line_) + ", column " + std::to_string(start_ - line_start_ + 1) +
                          ": " + message);
  }

  /// The next line, without its end; false at the end of the text.
  bool next_line(std::string_view& line) {
    if (at_ >= text_.size()) return false;
    if (at_ > 0) {
      ++line_;
      line_start_ = at_;
    }
    start_ = at_;
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    line = text_.substr(at_, end - at_);
    at_ = std::min(end + 1, text_.size());
    return true;
  }
  /// To be called once, before the numbers, after the last line.
  void begin_numbers() {
    ++line_;
    line_start_ = start_ = at_;
  }

  double number(const char* what) {
    while (at_ < text_.size() && is_separator(text_[at_])) {
      if (text_[at_++] != '\n') continue;
      ++line_;
      line_start_ = at_;
    }
    start_ = at_;
    while (at_ < text_.size() && !is_separator(text_[at_])) ++at_;
    std::string_view word = text_.substr(start_, at_ - start_);
    if (word.empty()) fail(std::string("the file ends before ") + what);
    if (word.front() == '+') word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value))
      fail(std::string("no number for ") + what);
    if (std::abs(value) > 1e17) fail(std::string("too large a number for ") + what);
    return value;
  }
  int count(const char* what, int least, int most) {
    const double value = number(what);
    if (value != std::floor(value) || value < least || value > most)
      fail(std::string(what) + " is not a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    return static_cast<int>(value);
  }
  std::vector<double> angles(const char* what, int count) {
    std::vector<double> result;
    for (int i = 0; i < count; ++i) {
      result.push_back(number(what));
      if (i > 0 && result[static_cast<std::size_t>(i)] <= result[static_cast<std::size_t>(i) - 1])
        fail(std::string(what) + " do not increase");
    }
    return result;
  }

 private:
  static bool is_separator(char c) { return c == ' ' || c == ',' || (c >= '\t' && c <= '\r'); }

  std::string_view text_;
  std::size_t at_ = 0, start_ = 0, line_start_ = 0;
  int line_ = 1;
};

/// Where x is among the angles: the lower neighbour, and how far it is on the way to the next. x is within them.
struct Between {
  std::size_t lower;
  double share;

  Between(const std::vector<double>& angles, double x) : lower(0), share(0) {
    if (angles.size() < 2) return;
    const auto above = std::upper_bound(angles.begin() + 1, angles.end() - 1, x);
    lower = static_cast<std::size_t>(above - angles.begin()) - 1;
    share = (x - angles[lower]) / (angles[lower + 1] - angles[lower]);
  }
};

/// The angle about the axis, from 0 to 360, that stands for it in a file whose last is `last`.
double folded(double angle, double last) {
  if (last == 0) return 0;
  if (last == 90) angle = std::fmod(angle, 180);
  if (last == 90 && angle > 90) return 180 - angle;
  if (last == 180 && angle > 180) return 360 - angle;
  return angle;
}

/// The line that begins with TILT=, and what is behind that.
std::string_view find_tilt(NumberText& numbers) {
  std::string_view line;
  while (numbers.next_line(line)) {
    if (line.find('\0') != std::string_view::npos) break;
    if (!line.starts_with("TILT=")) continue;
    while (line.ends_with('\r') || line.ends_with(' ')) line.remove_suffix(1);
    return line.substr(5);
  }
  numbers.fail("this is no IES file: it has no line that begins with TILT=");
}

}  // namespace

Photometry read_photometry(std::string_view text) {
  NumberText numbers(text);
  const bool has_tilt = find_tilt(numbers) == "INCLUDE";
  numbers.begin_numbers();
  if (has_tilt) {  // how the lamp's whole light depends on how it is mounted
    numbers.number("the lamp's mounting");
    for (int left = 2 * numbers.count("the number of tilt angles", 0, most_angles); left > 0; --left)
      numbers.number("the tilt");
  }
  numbers.number("the number of lamps");
  numbers.number("the lumens of a lamp");
  const double multiplier = numbers.number("the multiplier of candela");
  const int rows = numbers.count("the number of vertical angles", 1, most_angles),
            columns = numbers.count("the number of horizontal angles", 1, most_angles);
  if (static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns) > most_values)
    numbers.fail("there are more than " + std::to_string(most_values) + " intensities");
  if (numbers.count("the type of photometry", 1, 3) != 1) numbers.fail("the photometry is not of type C, which is 1");
  numbers.count("the unit of lengths", 1, 2);
  for (const char* what :
       {"the width", "the length", "the height", "the ballast factor", "the ballast-lamp factor", "the watts"})
    numbers.number(what);
  const std::vector<double> vertical = numbers.angles("the vertical angles", rows);
  if (vertical.front() < 0 || vertical.back() > 180) numbers.fail("a vertical angle is not within 0 to 180 degrees");
  const std::vector<double> horizontal = numbers.angles("the horizontal angles", columns);
  const double last = horizontal.back();
  if (horizontal.front() != 0 || (last != 0 && last != 90 && last != 180 && last != 360))
    numbers.fail("the horizontal angles do not go from 0 to 0, 90, 180 or 360 degrees");
  std::vector<double> candela;
  double largest = 0;
  for (int i = 0; i < rows * columns; ++i) {
    candela.push_back(numbers.number("the intensities"));
    if (candela.back() < 0) numbers.fail("an intensity is negative");
    largest = std::max(largest, candela.back());
  }
  if (!(largest > 0) || !(multiplier > 0)) numbers.fail("the lamp sends out no light");

  Photometry result;
  result.columns = columns == 1 ? 1 : Photometry::most_columns;
  result.shares.reserve(static_cast<std::size_t>(Photometry::rows * result.columns));
  for (int row = 0; row < Photometry::rows; ++row) {
    const double polar = row * 0.5;
    const Between v(vertical, polar);
    const bool within = polar >= vertical.front() && polar <= vertical.back();
    for (int column = 0; column < result.columns; ++column) {
      const Between h(horizontal, folded(column * 0.5, last));
      const auto at = [&](std::size_t i, std::size_t k) {
        const std::size_t lower = std::min(i, horizontal.size() - 1), other = std::min(k, vertical.size() - 1);
        return candela[lower * vertical.size() + other];
      };
      const auto between = [](double a, double b, double share) { return a + (b - a) * share; };
      const double lower = between(at(h.lower, v.lower), at(h.lower, v.lower + 1), v.share),
                   upper = between(at(h.lower + 1, v.lower), at(h.lower + 1, v.lower + 1), v.share);
      result.shares.push_back(within ? static_cast<float>(between(lower, upper, h.share) / largest) : 0.0F);
    }
  }
  return result;
}

}  // namespace raytrace
