#include "progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

#include "messages.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

bool is_terminal() {
  const char* const terminal = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && terminal != nullptr && std::string_view(terminal) != "dumb";
}

int terminal_columns() {
  constexpr int usual = 80;
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual;
}

/// "42 s", "3:07 min" or "1:02:09 h".
std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  if (whole < 60) return formatted("%lld s", whole);
  if (whole < 3600) return formatted("%lld:%02lld min", whole / 60, whole % 60);
  return formatted("%lld:%02lld:%02lld h", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string percentage(double fraction) { return std::to_string(static_cast<int>(100 * fraction)) + " %"; }

/// ", frame 7, 16 of 64 samples, error 2.3 %" as far as it is known.
std::string quality_text(const PictureProgress& picture) {
  std::string text = picture.frame ? ", frame " + std::to_string(*picture.frame) : "";
  if (!picture.error) return text;
  if (picture.samples < picture.all_samples)
    text += ", " + std::to_string(picture.samples) + " of " + counted(picture.all_samples, "sample");
  return text + formatted(", error %.2g %%", 100 * *picture.error);
}

/// Rounded down, so that 100 means the end.
double to_tenths(double value) { return std::floor(value * 10) / 10; }

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

Progress::Progress(ProgressStyle style) : style_(style), next_(start_) {
  if (style_ == ProgressStyle::automatic) style_ = is_terminal() ? ProgressStyle::bar : ProgressStyle::plain;
  if (style_ == ProgressStyle::plain) next_ += std::chrono::seconds(1);
}

Progress::~Progress() {
  if (style_ == ProgressStyle::bar) show_bar({});
}

void Progress::begin(std::size_t index, std::size_t count) {
  index_ = index;
  count_ = count;
}

void Progress::update(const PictureProgress& picture) {
  const double fraction =
      (static_cast<double>(index_) + std::clamp(picture.fraction, 0.0, 1.0)) / static_cast<double>(count_);
  if (!first_fraction_) first_fraction_ = fraction;
  if (style_ == ProgressStyle::none || Clock::now() < next_) return;
  if (style_ == ProgressStyle::bar) {
    draw_bar(fraction, picture);
    next_ = Clock::now() + std::chrono::milliseconds(100);
  } else {
    write_line(fraction, picture);
    next_ = Clock::now() + std::chrono::seconds(1);
  }
}

void Progress::skip() {
  // For people, "rendered 100 %" would be wrong.
  if (first_fraction_ || is_for_programs(style_)) finish({.fraction = 1});
}

void Progress::finish(const PictureProgress& picture) {
  if (index_ + 1 < count_) return update(picture);
  if (style_ == ProgressStyle::bar) {
    show_bar({});
  } else if (style_ != ProgressStyle::none) {
    write_line(1, picture);
  }
}

void Progress::draw_bar(double fraction, const PictureProgress& picture) {
  const std::string text = percentage(fraction) + quality_text(picture) + time_left(fraction);
  // Two for the brackets, one for a space, and one so that no terminal wraps the line.
  const int room = std::min(terminal_columns() - static_cast<int>(text.size()) - 4, 60);
  std::string line;
  if (room >= 5) {
    const int full = static_cast<int>(fraction * room);
    line += '[';
    line.append(static_cast<std::size_t>(full), '#');
    line.append(static_cast<std::size_t>(room - full), ' ');
    line += "] ";
  }
  show_bar(line + text);
}

void Progress::write_line(double fraction, const PictureProgress& picture) {
  if (is_for_programs(style_)) {
    log_program(progress_line(style_, fraction, seconds(), seconds_left(fraction), picture));
  } else {
    log_progress("rendered " + percentage(fraction) + quality_text(picture) + time_left(fraction));
  }
}

double Progress::seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

std::optional<double> Progress::seconds_left(double fraction) const {
  if (fraction >= 1) return 0;
  const double elapsed = seconds(), done = fraction - first_fraction_.value_or(0);
  // The first moments say nothing about the rest.
  if (done < 0.01 || elapsed < 0.2) return std::nullopt;
  return elapsed / done * (1 - fraction);
}

std::string Progress::time_left(double fraction) const {
  const std::optional<double> left = fraction < 1 ? seconds_left(fraction) : std::nullopt;
  return left ? ", " + duration_text(*left) + " left" : "";
}

bool is_for_programs(ProgressStyle style) {
  return style == ProgressStyle::openjd || style == ProgressStyle::alf || style == ProgressStyle::json;
}

std::string progress_line(ProgressStyle style, double fraction, double seconds, std::optional<double> seconds_left,
                          const PictureProgress& picture) {
  const double percent = 100 * fraction;
  if (style == ProgressStyle::openjd) return formatted("openjd_progress: %.1f\n", to_tenths(percent));
  if (style == ProgressStyle::alf) return "ALF_PROGRESS " + std::to_string(static_cast<int>(percent)) + "%\n";
  if (style != ProgressStyle::json) return {};
  nlohmann::ordered_json event = {
      {"event", "progress"}, {"percent", to_tenths(percent)}, {"seconds", to_tenths(seconds)}};
  if (seconds_left) event["seconds_left"] = to_tenths(*seconds_left);
  if (picture.frame) event["frame"] = *picture.frame;
  if (picture.all_samples > 0) event["samples"] = {picture.samples, picture.all_samples};
  if (picture.error) event["error"] = *picture.error;
  return json_line(event);
}

std::string status_line(ProgressStyle style, const std::string& text) {
  return text_line(style, "openjd_status", "status", text);
}

std::string failure_line(ProgressStyle style, const std::string& text) {
  return text_line(style, "openjd_fail", "failure", text);
}

}  // namespace raytrace
