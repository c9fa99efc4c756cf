#include "option_values.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <tuple>

#include "raytrace/aovs/aov_selection.h"
#include "raytrace/cameras/view_plane.h"
#include "raytrace/film/light_pass.h"
#include "raytrace/math/blackbody.h"
#include "raytrace/text/message.h"
#include "raytrace/text/utf8.h"

namespace raytrace {

namespace {

/// The whole text as a number; none if it is not one.
template <class Number>
std::optional<Number> number(std::string_view text) {
  Number value{};
  const char* const begin = text.data();
  const char* const end = begin + text.size();
  const auto [stop, error] = std::from_chars(begin, end, value);
  if (error != std::errc() || stop != end) return std::nullopt;
  return value;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// So many whole numbers; empty if the text is anything else.
std::vector<int> integers(const std::string& text, char separator, std::size_t count) {
  std::vector<int> values;
  for (const std::string_view part : split(text, separator))
    if (const auto value = number<int>(part)) values.push_back(*value);
  const auto separators = static_cast<std::size_t>(std::count(text.begin(), text.end(), separator));
  if (values.size() != count || separators + 1 != count) values.clear();
  return values;
}

}  // namespace

std::string nearest(const std::string& wrong, const Names& names) {
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  return std::string(nearest_name(wrong, candidates));
}

std::string suggestion(const std::string& wrong, const Names& names) {
  const std::string meant = nearest(wrong, names);
  return meant.empty() ? "" : "; did you mean " + in_quotes(meant) + "?";
}

int integer(const std::string& text, int least, int most) {
  const std::optional<int> value = number<int>(text);
  if (!value || *value < least || *value > most) {
    throw UsageError(in_quotes(text) + " is not a whole number from " + std::to_string(least) + " to " +
                     std::to_string(most));
  }
  return *value;
}

std::uint64_t natural_number(const std::string& text) {
  const std::optional<std::uint64_t> value = number<std::uint64_t>(text);
  if (!value) throw UsageError(in_quotes(text) + " is not a whole number from 0 to 2^64 - 1, nor 'frame'");
  return *value;
}

int bit_depth(const std::string& text) {
  if (text != "8" && text != "16") throw UsageError(in_quotes(text) + " is neither 8 nor 16");
  return integer(text, 8, 16);
}

std::uint64_t byte_count(const std::string& text) {
  constexpr std::string_view units = "KMGT";
  std::string digits = text;
  unsigned shift = 0;
  if (const std::size_t unit = text.empty() ? units.npos : units.find(text.back()); unit != units.npos) {
    shift = 10 * (static_cast<unsigned>(unit) + 1);
    digits.pop_back();
  }
  const std::optional<std::uint64_t> value = number<std::uint64_t>(digits);
  if (!value || *value > (std::numeric_limits<std::uint64_t>::max() >> shift))
    throw UsageError(in_quotes(text) + " is not a size, such as 500M or 2G");
  return *value << shift;
}

MissingTexture missing_texture(const std::string& text) {
  return one_of(text, {"error", "warn"}) == "warn" ? MissingTexture::warn : MissingTexture::error;
}

namespace {

/// "30,15"; none if it is anything else.
std::optional<std::array<double, 2>> two_angles(const std::string& text) {
  const std::vector<std::string_view> parts = split(text, ',');
  if (parts.size() != 2) return std::nullopt;
  const auto azimuth = number<double>(parts[0]), elevation = number<double>(parts[1]);
  if (!azimuth || !elevation || !(std::abs(*azimuth) <= 3600) || !(std::abs(*elevation) <= 90)) return std::nullopt;
  return std::array{*azimuth, *elevation};
}

}  // namespace

std::array<double, 2> model_view(const std::string& text) {
  constexpr std::array<std::tuple<std::string_view, double, double>, 5> words{
      {{"front", 0, 0}, {"back", 180, 0}, {"side", 90, 0}, {"top", 0, 90}, {"iso", 45, 35.264389682754654}}};
  Names names;
  for (const auto& [word, azimuth, elevation] : words) {
    if (text == word) return {azimuth, elevation};
    names.emplace_back(word);
  }
  if (const auto angles = two_angles(text)) return *angles;
  const auto& transforms = Choices<ViewTransform>::words;
  const bool is_transform = std::find(transforms.begin(), transforms.end(), text) != transforms.end();
  throw UsageError(in_quotes(text) + " is neither one of " + joined(names, ", ") +
                   " nor two angles such as 30,15, the second from -90 to 90" +
                   (is_transform ? "; did you mean --view-transform " + text + "?" : suggestion(text, names)));
}

std::array<double, 2> sun_angles(const std::string& text) {
  if (const auto angles = two_angles(text); angles && (*angles)[1] > 0) return *angles;
  throw UsageError(in_quotes(text) +
                   " is no place of a sun: two angles such as -40,35, the second above 0, at most 90");
}

std::string one_of(const std::string& text, const Names& names) {
  if (std::find(names.begin(), names.end(), text) != names.end()) return text;
  throw UsageError(in_quotes(text) + " is not one of " + joined(names, ", ") + suggestion(text, names));
}

Names aov_choices() {
  Names choices = aov_names();
  choices.insert(choices.end(), {"light_NAME", "passes", "all"});
  return choices;
}

std::vector<std::string> material_names(const std::string& text) {
  std::vector<std::string> names;
  for (const std::string_view name : split(text, ',')) {
    if (name.empty()) throw UsageError("--clay: " + in_quotes(text) + " has a name that is empty");
    names.emplace_back(name);
  }
  return names;
}

AovSet aovs(const std::string& text) {
  Names wanted;
  for (const std::string_view name : split(text, ','))
    wanted.push_back(light_group_of(name) ? std::string(name) : one_of(std::string(name), aov_choices()));
  if (std::erase(wanted, "passes") > 0)
    wanted.insert(wanted.end(), std::begin(light_pass_names), std::end(light_pass_names));
  if (std::erase(wanted, "all") == 0) return aov_set(wanted);
  for (const std::string& name : aov_names())
    if (std::find(std::begin(light_pass_names), std::end(light_pass_names), name) == std::end(light_pass_names))
      wanted.push_back(name);
  AovSet set = aov_set(wanted);
  set.wants_all_light_groups = true;
  return set;
}

Resolution resolution(const std::string& text) {
  const std::vector<int> edges = integers(text, 'x', 2);
  if (edges.empty() || edges[0] < 1 || edges[1] < 1)
    throw UsageError(in_quotes(text) + " is not a resolution; use WIDTHxHEIGHT, e.g. 1920x1080");
  return {edges[0], edges[1]};
}

double scale(const std::string& text) {
  const std::optional<double> value = number<double>(text);
  if (!value || !std::isfinite(*value) || *value <= 0) {
    throw UsageError(in_quotes(text) + " is not a scale; use a number above 0, e.g. 0.5 for half the resolution");
  }
  return *value;
}

double radiance(const std::string& text) {
  const std::optional<double> value = number<double>(text);
  if (!value || !(*value >= 0 && *value <= largest_number))
    throw UsageError(in_quotes(text) + " is no radiance; use a number such as 10, or 0 for any");
  return *value;
}

double frames_per_second(const std::string& text) {
  const std::optional<double> value = number<double>(text);
  if (!value || !(*value >= 1e-3 && *value <= 1e6))
    throw UsageError(in_quotes(text) + " is no rate of frames; use a number from 0.001 to 1000000, e.g. 25");
  return *value;
}

std::string label(const std::string& text) {
  const bool has_control = std::any_of(text.begin(), text.end(), [](char c) { return c >= 0 && c < ' '; });
  if (text.empty() || has_control || text.front() == ' ' || text.back() == ' ' ||
      text.find("  ") != std::string::npos || find_invalid_utf8(text, 1) != std::string_view::npos)
    throw UsageError(in_quotes(text) + " is no name with single spaces inside; use its number, from 0");
  return text;
}

double exposure(const std::string& text) {
  const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-';
  const std::optional<double> value = number<double>(std::string_view(text).substr(has_plus ? 1 : 0));
  if (!value || !(std::abs(*value) <= largest_exposure)) {
    throw UsageError(in_quotes(text) +
                     " is not an exposure; use a number of stops from -64 to 64, e.g. 1 for twice the light, or -1.5");
  }
  return *value;
}

double balanced_temperature(const std::string& text) {
  const std::optional<double> value = number<double>(text);
  if (!value || (*value != 0 && !is_temperature(*value)))
    throw UsageError(in_quotes(text) +
                     " is not a white balance; use the kelvin of a lamp from 1000, embers, to 15000, "
                     "blue sky, e.g. 2700, or 0 for none");
  return *value;
}

Tile tile(const std::string& text) {
  const std::vector<int> parts = integers(text, '/', 2);
  if (parts.empty() || parts[1] < 1)
    throw UsageError(in_quotes(text) + " is not a tile; use I/N, e.g. 0/4 for the first of four");
  if (parts[0] < 0 || parts[0] >= parts[1])
    throw UsageError("there is no tile " + in_quotes(text) + ": they count from 0 to " + std::to_string(parts[1] - 1));
  return {parts[0], parts[1]};
}

PixelIndex pixel_index(const std::string& text) {
  const std::vector<int> parts = integers(text, ',', 2);
  if (parts.empty()) throw UsageError(in_quotes(text) + " is not a pixel; use x,y from the top left, e.g. 12,40");
  return {parts[0], parts[1]};
}

double error_limit(const std::string& text) {
  double error = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, result] = std::from_chars(text.data(), end, error);
  const bool is_percent = stop != end && *stop == '%';
  if (is_percent) error /= 100;
  if (result != std::errc() || stop + (is_percent ? 1 : 0) != end || !(error > 0) || error > 1)
    throw UsageError(in_quotes(text) + " is not an error; use a percentage such as 2%, or 0.02 for the same");
  return error;
}

double duration(const std::string& text) {
  double seconds = 0;
  const char* next = text.data();
  const char* const end = next + text.size();
  double largest_unit = std::numeric_limits<double>::infinity();
  while (next != end) {
    double value = 0;
    const auto [stop, error] = std::from_chars(next, end, value);
    const char letter = stop == end ? 's' : *stop;
    const double unit = letter == 's' ? 1 : letter == 'm' ? 60 : letter == 'h' ? 3600 : 0;
    // The larger units first, each once.
    if (error != std::errc() || !(value >= 0) || unit == 0 || unit >= largest_unit) break;
    largest_unit = unit;
    seconds += value * unit;
    next = stop == end ? end : stop + 1;
  }
  if (text.empty() || next != end || !(seconds > 0) || seconds > 1e9) {
    throw UsageError(in_quotes(text) + " is not a time; use e.g. 90s, 10m or 1h30m");
  }
  return seconds;
}

Region crop(const std::string& text) {
  const std::vector<int> edges = integers(text, ',', 4);
  if (edges.empty()) {
    throw UsageError(
        in_quotes(text) +
        " is not a crop; use x0,y0,x1,y1 in pixels from the top left, x1 and y1 exclusive, e.g. 0,0,64,64");
  }
  if (edges[0] >= edges[2] || edges[1] >= edges[3])
    throw UsageError(in_quotes(text) + " holds no pixel: x1 must be above x0, and y1 above y0");
  return {edges[0], edges[1], edges[2], edges[3]};
}

DisplayAddress display_address(const std::string& text) {
  constexpr int largest_port = 65535;
  DisplayAddress address{text, "14158"};
  const std::size_t colon = text.rfind(':');
  const bool in_brackets = text.starts_with('[') && text.find(']') != std::string::npos;
  if (colon != std::string::npos && !text.ends_with(']')) address = {text.substr(0, colon), text.substr(colon + 1)};
  if (in_brackets && address.host.ends_with(']')) {
    address.host = address.host.substr(1, address.host.size() - 2);
  } else if (address.host.find_first_of(":[]") != std::string::npos) {
    address.host.clear();
  }
  const std::optional<int> port = number<int>(address.port);
  if (address.host.empty() || !port || *port < 1 || *port > largest_port) {
    throw UsageError(in_quotes(text) +
                     " is not a display server; use HOST:PORT, e.g. localhost:14158, or [::1]:14158 for IPv6");
  }
  return address;
}

}  // namespace raytrace
