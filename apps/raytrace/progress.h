// How far a render is: a bar on a terminal, plain lines in a log, lines that a farm reads on standard output.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "progress_lines.h"

namespace raytrace {

/// Calls must come one at a time, from whatever thread.
class Progress {
 public:
  explicit Progress(ProgressStyle style);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// fraction: of the work that is done, 0 to 1.
  void update(double fraction);

  /// All is done: the last line, or no more bar.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  void draw_bar(double fraction);
  void write_line(double fraction);
  double seconds() const;
  std::optional<double> seconds_left(double fraction) const;
  std::string time_left(double fraction) const;

  ProgressStyle style_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point next_;  ///< nothing is shown before
};

}  // namespace raytrace
