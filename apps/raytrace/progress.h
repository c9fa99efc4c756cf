// How far a render is: a bar on a terminal, plain lines in a log, lines that a farm reads on standard output.
#pragma once

#include <chrono>
#include <cstddef>
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

  /// What follows is render `index` of `count`.
  void begin(std::size_t index, std::size_t count);

  /// fraction: of the render that is done, 0 to 1.
  void update(double fraction);

  /// The render need not be done.
  void skip();

  /// The render is done, and after the last one all is: the last line, or no more bar.
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
  std::size_t index_ = 0, count_ = 1;
  /// Where the first update found it: what an earlier run had done says nothing about this one's speed.
  std::optional<double> first_fraction_;
  Clock::time_point next_;  ///< nothing is shown before
};

}  // namespace raytrace
