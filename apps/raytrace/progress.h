// How far a render is: a bar on a terminal, plain lines in a log.
#pragma once

#include <chrono>
#include <cstdio>
#include <string>

namespace raytrace {

enum class ProgressStyle {
  automatic,  ///< bar on a terminal that can move its cursor, plain elsewhere
  bar,        ///< one line that is drawn over, ten times a second at most, and wiped out in the end
  plain,      ///< a whole line a second at most, and one at the end
  none,
};

/// Writes to standard error. Calls must come one at a time, from whatever thread.
class Progress {
 public:
  explicit Progress(ProgressStyle style);
  ~Progress() { clear(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// fraction: of the work that is done, 0 to 1.
  void update(double fraction);

  /// All is done: the last plain line, or no more bar.
  void finish();

  /// Wipes the bar out, so that something else can be written.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  void draw_bar(double fraction);
  void write_line(double fraction);
  std::string time_left(double fraction) const;

  ProgressStyle style_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_;  ///< nothing is shown before
  bool bar_is_shown_ = false;
};

}  // namespace raytrace
