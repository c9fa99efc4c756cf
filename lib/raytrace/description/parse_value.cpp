#include "raytrace/description/parse_value.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>

#include "raytrace/text/quoted.h"
#include "raytrace/xml/document.h"

namespace raytrace {
namespace {

enum class Outcome { whole, not_a_number, too_large, too_small };

template <class Number>
Outcome convert(std::string_view text, Number& value) {
  if (!text.empty() && text[0] == '+') text.remove_prefix(text.size() > 1 && text[1] == '-' ? 0 : 1);
  const char* const end = text.data() + text.size();
  const std::from_chars_result result = std::from_chars(text.data(), end, value);
  if (result.ec == std::errc::invalid_argument || result.ptr != end) return Outcome::not_a_number;
  if (result.ec == std::errc()) return Outcome::whole;
  // from_chars does not tell 1e999 from 1e-999.
  const std::size_t exponent = text.find_first_of("eE");
  const bool tiny = exponent == std::string_view::npos ? text.find_first_of("123456789") > text.find('.')
                                                       : text.substr(exponent + 1, 1) == "-";
  return tiny ? Outcome::too_small : Outcome::too_large;
}

std::string explain_no_number(std::string_view text) {
  std::string with_point(text.substr(0, 100));
  std::replace(with_point.begin(), with_point.end(), ',', '.');
  double value = 0;
  if (with_point.size() == text.size() && with_point != text && convert(with_point, value) == Outcome::whole) {
    return "is not a number; write it with a point: " + with_point;
  }
  return "is not a number; write one such as 1.5";
}

}  // namespace

std::string number_text(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

DiagnosticText parse_number(std::string_view text, Range range, double& value) {
  text = trimmed(text);
  double number = 0;
  switch (convert(text, number)) {
    case Outcome::not_a_number:
      return explain_no_number(text);
    case Outcome::too_small:
      return "is too small to be told from 0; write 0";
    case Outcome::too_large:
      number = std::numeric_limits<double>::max();
      break;
    case Outcome::whole:
      break;
  }
  if (DiagnosticText diagnostic = check_number(number, range)) return diagnostic;
  value = number;
  return std::nullopt;
}

DiagnosticText check_number(double number, Range range) {
  // std::from_chars takes "nan" and "inf" for numbers.
  if (!std::isfinite(number)) return "is not a finite number; write one such as 1.5";
  if (std::abs(number) > largest_number) {
    return "is beyond the largest number that a scene may have, " + number_text(largest_number);
  }
  if (range == Range::not_negative && number < 0) return "must not be negative";
  if (range == Range::positive && number <= 0) return "must be greater than 0";
  if (range == Range::positive && number < smallest_size) {
    return "is too small; the smallest size is " + number_text(smallest_size);
  }
  return std::nullopt;
}

DiagnosticText parse_integer(std::string_view text, Range range, int& value) {
  text = trimmed(text);
  int integer = 0;
  switch (convert(text, integer)) {
    case Outcome::not_a_number: {
      double number = 0;
      if (convert(text, number) == Outcome::not_a_number || !std::isfinite(number)) {
        return "is not a whole number; write one such as 16";
      }
      if (number == std::floor(number) && std::abs(number) < 1e9) {
        return "must be written as a whole number: " + std::to_string(static_cast<int>(number));
      }
      return "is not a whole number; write one without point and exponent, such as 16";
    }
    case Outcome::too_large:
    case Outcome::too_small:
      return "is outside of the whole numbers from -2147483648 to 2147483647";
    case Outcome::whole:
      break;
  }
  if (DiagnosticText diagnostic = check_integer(integer, range)) return diagnostic;
  value = integer;
  return std::nullopt;
}

DiagnosticText check_integer(int integer, Range range) {
  if (range == Range::not_negative && integer < 0) return "must not be negative";
  if (range == Range::positive && integer < 1) return "must be at least 1";
  return std::nullopt;
}

DiagnosticText parse_boolean(std::string_view text, bool& value) {
  text = trimmed(text);
  const bool yes = text == "true" || text == "1";
  if (!yes && text != "false" && text != "0") return "is neither true nor false; write one of them";
  value = yes;
  return std::nullopt;
}

// Schemas take runs of white space for single spaces; to agree with them there must not be any.
DiagnosticText check_label(std::string_view text) {
  bool runs = false;
  char last = 0;
  for (const char c : text) {
    runs |= c == '\t' || c == '\n' || c == '\r' || (c == ' ' && last == ' ');
    last = c;
  }
  if (!runs) return std::nullopt;
  return "has line breaks, tabs or several spaces in a row; write single spaces";
}

}  // namespace raytrace
