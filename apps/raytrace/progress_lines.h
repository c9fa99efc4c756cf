// The lines of progress that programs read: render farms and scripts. Each ends with its line end.
//
// openjd  Open Job Description: openjd_progress, openjd_status and openjd_fail.
//         github.com/OpenJobDescription/openjd-specifications/wiki/How-Jobs-Are-Run
// alf     Pixar's Tractor and Alfred: ALF_PROGRESS. They take errors from the exit code.
// json    An object a line; keys: docs/watching.md
#pragma once

#include <optional>
#include <string>

namespace raytrace {

enum class ProgressStyle {
  automatic,  ///< bar on a terminal that can move its cursor, plain elsewhere
  bar,        ///< one line that is drawn over, ten times a second at most, and wiped out in the end
  plain,      ///< a whole line a second at most, and one at the end
  openjd,
  alf,
  json,
  none,
};

/// Whether lines of this style are for a program, on standard output; the other styles are for people, on standard
/// error.
bool is_for_programs(ProgressStyle style);

/// percent: 0 to 100; seconds_left: none while nobody can know.
std::string progress_line(ProgressStyle style, double percent, double seconds, std::optional<double> seconds_left);

/// What is being done. Empty if the style has no such line; so, too, the next one.
std::string status_line(ProgressStyle style, const std::string& text);

/// Why the run fails.
std::string failure_line(ProgressStyle style, const std::string& text);

}  // namespace raytrace
