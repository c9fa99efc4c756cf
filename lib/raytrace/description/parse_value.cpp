#include "raytrace/description/parse_value.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <system_error>
#include <utility>

#include "raytrace/math/blackbody.h"
#include "raytrace/text/message.h"
#include "raytrace/text/utf8.h"
#include "raytrace/xml/xml_characters.h"

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
  // from_chars gives the same for 1e999 and 1e-999.
  const std::size_t exponent = text.find_first_of("eE");
  const bool tiny = exponent == std::string_view::npos ? text.find_first_of("123456789") > text.find('.')
                                                       : text.substr(exponent + 1, 1) == "-";
  return tiny ? Outcome::too_small : Outcome::too_large;
}

/// The number before a unit, a word of letters; empty if there is none, or if the unit says that it is of radians,
/// which nothing takes. Number: double or int.
template <class Number>
std::string_view before_unit(std::string_view text) {
  const std::size_t digits = text.find_last_of("0123456789.") + 1;
  const std::string_view number = text.substr(0, digits), unit = xml::trimmed(text.substr(digits));
  const bool is_unit = unit != "e" && unit != "E" && !unit.starts_with("rad") &&
                       !(number == "0" && unit.starts_with('x')) &&
                       std::all_of(unit.begin(), unit.end(), [](unsigned char c) {
                         // Degrees and micro are no ASCII.
                         return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c >= 0x80;
                       });
  Number value = 0;
  return !unit.empty() && is_unit && convert(number, value) == Outcome::whole ? number : std::string_view();
}

std::string explain_no_number(std::string_view text) {
  double percents = 0;
  if (text.ends_with('%') && convert(xml::trimmed(text.substr(0, text.size() - 1)), percents) == Outcome::whole &&
      std::isfinite(percents))
    return "is not a number; write it as " + number_text(percents / 100);
  if (const std::string_view number = before_unit<double>(text); !number.empty())
    return "is not a number; write it without a unit: " + std::string(number);
  std::string with_point(text.substr(0, 100));
  std::replace(with_point.begin(), with_point.end(), ',', '.');
  double value = 0;
  if (with_point.size() == text.size() && with_point != text && convert(with_point, value) == Outcome::whole) {
    return "is not a number; write it with a point: " + with_point;
  }
  return "is not a number; write one such as 1.5";
}

/// The chemical symbols that other programs have for metals.
struct Symbol {
  std::string_view symbol, metal;
};
constexpr Symbol symbols[] = {
    {"Ag", "silver"}, {"Al", "aluminium"}, {"Au", "gold"},     {"Cr", "chromium"},     {"Cu", "copper"},
    {"Fe", "iron"},   {"Ni", "nickel"},    {"Pt", "platinum"}, {"Ni_palik", "nickel"}, {"Ti", "titanium"},
};

/// That of the words which the text stands for or is misspelt of.
std::string_view meant_word(std::string_view text, std::span<const std::string_view> words) {
  for (const auto& [symbol, metal] : symbols)
    if (symbol == text && std::find(words.begin(), words.end(), metal) != words.end()) return metal;
  return nearest_name(text, words);
}

/// "is neither linear nor smooth; write one of them"
std::string explain_no_choice(std::string_view text, std::span<const std::string_view> words) {
  std::string message = "is neither ";
  for (std::size_t i = 0; i < words.size(); ++i)
    message.append(i == 0 ? "" : i + 1 < words.size() ? ", " : " nor ").append(words[i]);
  const std::string_view nearest = meant_word(text, words);
  return message + (nearest.empty() ? "; write one of them" : "; did you mean " + in_quotes(nearest) + "?");
}

}  // namespace

std::string number_text(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

OptionalMessage parse_number(std::string_view text, Range range, double& value) {
  text = xml::trimmed(text);
  double number = 0;
  switch (convert(text, number)) {
    case Outcome::not_a_number:
      return explain_no_number(text);
    case Outcome::too_small:
      return "is too small to differ from 0; write 0";
    case Outcome::too_large:
      number = std::numeric_limits<double>::max();
      break;
    case Outcome::whole:
      break;
  }
  if (OptionalMessage message = check_value(number, range)) return message;
  value = number;
  return std::nullopt;
}

OptionalMessage check_value(double number, Range range) {
  // std::from_chars takes "nan" and "inf" for numbers.
  if (!std::isfinite(number)) return "is not a finite number; write one such as 1.5";
  if (std::abs(number) > largest_number) {
    return "is beyond the largest number that a scene may have, " + number_text(largest_number);
  }
  if (range == Range::temperature && !is_temperature(number))
    return "is not the temperature of a black body: it is from 1000 kelvin, embers, to 15000, blue sky";
  if (range == Range::not_negative && number < 0) return "must not be negative";
  if (range == Range::positive && number <= 0) return "must be greater than 0";
  if (range == Range::positive && number < smallest_size) {
    return "is too small; the smallest size is " + number_text(smallest_size);
  }
  return std::nullopt;
}

OptionalMessage parse_integer(std::string_view text, Range range, int& value) {
  text = xml::trimmed(text);
  int integer = 0;
  switch (convert(text, integer)) {
    case Outcome::not_a_number: {
      double number = 0;
      if (const std::string_view whole = before_unit<int>(text); !whole.empty())
        return "is not a whole number; write it without a unit: " + std::string(whole);
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
  if (OptionalMessage message = check_value(integer, range)) return message;
  value = integer;
  return std::nullopt;
}

OptionalMessage check_value(int integer, Range range) {
  if (range == Range::not_negative && integer < 0) return "must not be negative";
  if (range == Range::positive && integer < 1) return "must be at least 1";
  return std::nullopt;
}

OptionalMessage parse_boolean(std::string_view text, bool& value) {
  text = xml::trimmed(text);
  const bool yes = text == "true" || text == "1";
  if (!yes && text != "false" && text != "0") return "is neither true nor false; write one of them";
  value = yes;
  return std::nullopt;
}

OptionalMessage parse_choice(std::string_view text, const ChoiceReference& choice) {
  const auto words = choice.words();
  const auto word = std::find(words.begin(), words.end(), xml::trimmed(text));
  if (word == words.end()) return explain_no_choice(text, words);
  choice.set(static_cast<std::size_t>(word - words.begin()));
  return std::nullopt;
}

OptionalMessage check_value(const ChoiceReference& choice, Range) {
  if (choice.index() < choice.words().size()) return std::nullopt;
  return explain_no_choice({}, choice.words());
}

std::string value_text(const ChoiceReference& choice) {
  const std::size_t index = choice.index();
  return index < choice.words().size() ? std::string(choice.words()[index]) : std::to_string(index);
}

OptionalMessage parse_groups(std::string_view text, NumberGroups& groups) {
  NumberGroups read;
  std::size_t begin = 0;
  const auto end_group = [&] {
    if (read.numbers.size() == begin) return false;
    begin = read.numbers.size();
    read.ends.push_back(static_cast<std::uint32_t>(begin));
    return true;
  };
  while (true) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
    if (text.empty()) break;
    if (text.front() == ',') {
      if (!end_group()) return "has a comma without a number before it";
      text.remove_prefix(1);
      continue;
    }
    const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n,"));
    double number = 0;
    if (const OptionalMessage message = parse_number(word, Range::any, number))
      return "has " + in_quotes(word) + " as number " + std::to_string(read.numbers.size() + 1) + ", which " + *message;
    read.numbers.push_back(number);
    text.remove_prefix(word.size());
  }
  end_group();  // a comma at the end is fine
  groups = std::move(read);
  return std::nullopt;
}

OptionalMessage parse_word_or_groups(std::string_view text, WordOrGroups& value) {
  text = xml::trimmed(text);
  if (text.find_first_of("+-.0123456789") == 0) return parse_groups(text, value.groups);
  const auto word = std::find(value.words.begin(), value.words.end(), text);
  if (word == value.words.end()) return explain_no_choice(text, value.words) + " Or write numbers";
  value.word = static_cast<std::size_t>(word - value.words.begin());
  return std::nullopt;
}

OptionalMessage check_value(const WordOrGroups& value, Range range) {
  if (!value.groups.empty() || value.word < value.words.size()) return check_value(value.groups, range);
  return explain_no_choice({}, value.words);
}

std::string value_text(const WordOrGroups& value) {
  if (!value.groups.empty()) return value_text(value.groups);
  return value.word < value.words.size() ? std::string(value.words[value.word]) : std::to_string(value.word);
}

OptionalMessage check_value(const NumberGroups& value, Range) {
  for (const double number : value.numbers)
    if (const OptionalMessage message = check_value(number, Range::any)) return "has a number that " + *message;
  std::uint32_t last = 0;
  for (const std::uint32_t end : value.ends)
    if (end <= std::exchange(last, end)) return "has groups without numbers";
  if (last != value.numbers.size()) return "has numbers that are in no group";
  return std::nullopt;
}

std::string value_text(const NumberGroups& value) {
  std::string text;
  std::size_t i = 0;
  for (const std::uint32_t end : value.ends) {
    if (i > 0) text += ',';
    for (; i < end && i < value.numbers.size(); ++i)
      text.append(text.empty() ? "" : " ").append(number_text(value.numbers[i]));
  }
  return text;
}

OptionalMessage check_value(const FileName& value, Range) {
  // Empty: there is none. Its type says whether there may be none.
  return value.path.empty() ? std::nullopt : check_value(value.path, Range::any);
}

OptionalMessage check_value(const Reference& value, Range range) {
  if (value.name.empty()) return std::nullopt;  // there is none, likewise
  if (range != Range::identifier) return check_value(value.name, range);
  constexpr std::string_view characters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  if (value.name.find_first_not_of(characters) == std::string::npos) return std::nullopt;
  return "has other characters than letters from a to z, digits, _ and -";
}

OptionalMessage check_value(const std::string& value, Range) {
  if (value.empty()) return "is empty";
  if (find_invalid_utf8(value, 1) != std::string_view::npos) return "is no text in UTF-8 without control characters";
  if (value.front() == ' ' || value.back() == ' ') return "has a space at an end";
  return check_label(value);
}

// Schemas take runs of white space for single spaces; to agree with them there must not be any.
OptionalMessage check_label(std::string_view text) {
  if (text.find_first_of("\t\n\r") == std::string_view::npos && text.find("  ") == std::string_view::npos)
    return std::nullopt;
  return "has line breaks, tabs or several spaces in a row; write single spaces";
}

bool is_direction(const Vec3d& vector) {
  return std::max({std::abs(vector.x), std::abs(vector.y), std::abs(vector.z)}) >= smallest_size;
}

}  // namespace raytrace
