// How far a render is: a bar on a terminal, plain lines in a log, lines that a farm reads on standard output.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>

#include "raytrace/batch/render_observer.h"

namespace raytrace {

enum class ProgressStyle {
  automatic,  ///< bar on a terminal that can move its cursor, plain elsewhere
  bar,        ///< one line that is drawn over, ten times a second at most, and wiped out in the end
  plain,      ///< a whole line a second at most, and one at the end
  openjd,     ///< Open Job Description's openjd_progress, openjd_status and openjd_fail:
              ///< github.com/OpenJobDescription/openjd-specifications/wiki/How-Jobs-Are-Run
  alf,        ///< ALF_PROGRESS of Pixar's Tractor and Alfred, which take errors from the exit code
  json,       ///< an object a line; keys: docs/watching.md
  none,
};

/// Whether lines of this style are for a program, on standard output; the other styles are for people, on standard
/// error.
bool is_for_programs(ProgressStyle style);

/// The lines that programs read, each with its end. fraction: of all renders; seconds_left: none while nobody can know.
std::string progress_line(ProgressStyle style, double fraction, double seconds, std::optional<double> seconds_left,
                          const PictureProgress& picture);

/// What is being done. Empty if the style has no such line; so, too, the next one.
std::string status_line(ProgressStyle style, const std::string& text);

/// Why the run fails.
std::string failure_line(ProgressStyle style, const std::string& text);

/// Calls must come one at a time, from whatever thread.
class Progress {
 public:
  explicit Progress(ProgressStyle style);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// What follows is render `index` of `count`.
  void begin(std::size_t index, std::size_t count);

  /// Of the render at hand.
  void update(const PictureProgress& picture);

  /// The render need not be done.
  void skip();

  /// The render is done, and after the last one all is: the last line, or no more bar.
  void finish(const PictureProgress& picture);

 private:
  using Clock = std::chrono::steady_clock;

  void draw_bar(double fraction, const PictureProgress& picture);
  void write_line(double fraction, const PictureProgress& picture);
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
