#include "progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

namespace raytrace {

namespace {

bool is_terminal() {
  const char* const kind = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && kind != nullptr && std::string_view(kind) != "dumb";
}

int terminal_columns() {
  constexpr int usual = 80;
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual;
}

/// "42 s", "3:07 min" or "1:02:09 h".
std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  char text[64];
  if (whole < 60) {
    std::snprintf(text, sizeof text, "%lld s", whole);
  } else if (whole < 3600) {
    std::snprintf(text, sizeof text, "%lld:%02lld min", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%lld:%02lld:%02lld h", whole / 3600, whole / 60 % 60, whole % 60);
  }
  return text;
}

std::string percentage(double fraction) { return std::to_string(static_cast<int>(100 * fraction)) + " %"; }

}  // namespace

Progress::Progress(ProgressStyle style) : style_(style), next_(start_) {
  if (style_ == ProgressStyle::automatic) style_ = is_terminal() ? ProgressStyle::bar : ProgressStyle::plain;
  if (style_ == ProgressStyle::plain) next_ += std::chrono::seconds(1);
}

void Progress::update(double fraction) {
  if (style_ == ProgressStyle::none || Clock::now() < next_) return;
  fraction = std::clamp(fraction, 0.0, 1.0);
  if (style_ == ProgressStyle::bar) {
    draw_bar(fraction);
    next_ = Clock::now() + std::chrono::milliseconds(100);
  } else {
    write_line(fraction);
    next_ = Clock::now() + std::chrono::seconds(1);
  }
}

void Progress::finish() {
  clear();
  if (style_ == ProgressStyle::plain) write_line(1);
}

void Progress::clear() {
  if (!bar_is_shown_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  bar_is_shown_ = false;
}

void Progress::draw_bar(double fraction) {
  const std::string text = percentage(fraction) + time_left(fraction);
  // Two for the brackets, one for a space, and one so that no terminal wraps the line.
  const int room = std::min(terminal_columns() - static_cast<int>(text.size()) - 4, 60);
  std::string line = "\r";
  if (room >= 5) {
    const int full = static_cast<int>(fraction * room);
    line += '[';
    line.append(static_cast<std::size_t>(full), '#');
    line.append(static_cast<std::size_t>(room - full), ' ');
    line += "] ";
  }
  line += text + "\033[K";
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
  bar_is_shown_ = true;
}

void Progress::write_line(double fraction) {
  std::fprintf(stderr, "raytrace: rendered %s%s\n", percentage(fraction).c_str(), time_left(fraction).c_str());
  std::fflush(stderr);
}

std::string Progress::time_left(double fraction) const {
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  // The first moments tell nothing about the rest.
  if (fraction < 0.01 || elapsed < 0.2 || fraction >= 1) return {};
  return ", " + duration_text(elapsed / fraction * (1 - fraction)) + " left";
}

}  // namespace raytrace
