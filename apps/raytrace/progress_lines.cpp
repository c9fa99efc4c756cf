#include "progress_lines.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "raytrace/text/quoted.h"

namespace raytrace {

namespace {

/// Rounded down, so that 100 means the end.
double to_tenths(double value) { return std::floor(value * 10) / 10; }

std::string with_one_decimal(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

/// A line end in a file's name must not begin a line that a farm takes for an order.
std::string without_controls(std::string text) {
  std::replace_if(text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, ' ');
  return on_one_line(text);
}

std::string json_line(const nlohmann::ordered_json& event) {
  // A file name need not be UTF-8; JSON must.
  return event.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

/// The line of an event that is a text.
std::string text_line(ProgressStyle style, const char* openjd_name, const char* json_name, const std::string& text) {
  if (style == ProgressStyle::openjd) return std::string(openjd_name) + ": " + without_controls(text) + "\n";
  if (style == ProgressStyle::json) return json_line({{"event", json_name}, {"text", text}});
  return {};
}

}  // namespace

bool is_for_programs(ProgressStyle style) {
  return style == ProgressStyle::openjd || style == ProgressStyle::alf || style == ProgressStyle::json;
}

std::string progress_line(ProgressStyle style, double percent, double seconds, std::optional<double> seconds_left) {
  if (style == ProgressStyle::openjd) return "openjd_progress: " + with_one_decimal(to_tenths(percent)) + "\n";
  if (style == ProgressStyle::alf) return "ALF_PROGRESS " + std::to_string(static_cast<int>(percent)) + "%\n";
  if (style != ProgressStyle::json) return {};
  nlohmann::ordered_json event = {
      {"event", "progress"}, {"percent", to_tenths(percent)}, {"seconds", to_tenths(seconds)}};
  if (seconds_left) event["seconds_left"] = to_tenths(*seconds_left);
  return json_line(event);
}

std::string status_line(ProgressStyle style, const std::string& text) {
  return text_line(style, "openjd_status", "status", text);
}

std::string failure_line(ProgressStyle style, const std::string& text) {
  return text_line(style, "openjd_fail", "failure", text);
}

}  // namespace raytrace
