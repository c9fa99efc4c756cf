// The messages of the program while it runs, for a person on standard error ("raytrace: error: ..."), the log file, and
// a program that reads along on standard output (progress.h). Any thread may log something at any time.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "progress.h"
#include "raytrace/xml/diagnostics.h"

namespace raytrace {

enum class Verbosity { errors, warnings, steps, details };

/// What is reported from here on; before the first call, warnings and errors.
void set_verbosity(Verbosity verbosity);

/// From here on messages go to this file, too: each line is added at its end after the time in UTC
/// ("2026-01-31T23:59:59Z raytrace: warning: ..."). Throws OutputError if it cannot be opened; should it take no more
/// later (a full disk), that is reported once and the run goes on.
void log_to(const std::string& file);

/// Messages go there no more.
void end_log();

/// From here on, steps and errors are reported to the program that reads standard output, too, whatever the verbosity,
/// if the style is for one. Should that program go away, the run goes on.
void log_program_in(ProgressStyle style);

/// How many messages were logged so far.
std::size_t message_count();

/// Whether messages of this weight are logged.
bool is_logged(Verbosity verbosity);

// The text of a message may hold anything that a user or a file says: control characters in it, line ends too, are
// shown as \xNN, so that none reaches a terminal or a log. What is to stand on lines of its own comes as such.
void log_error(const std::string& text, const std::vector<std::string>& more_lines = {});
void log_warning(const std::string& text);
void log_note(const std::string& text);  ///< with the weight of a warning, but it is none
void log_step(const std::string& text);

/// Whole lines: findings about a scene, statistics. Of what they hold, line ends alone stay as they are.
void log_lines(const std::string& lines);

/// What is wrong or doubtful in a scene. What an earlier render of it, another frame, had too is not repeated.
void log_diagnostics(const Diagnostics& diagnostics);

/// How far the render is, as a line for people. It is not logged.
void log_progress(const std::string& text);

/// What was asked for, on standard output, at once. Throws OutputError if it takes no more.
void print(const std::string& text);

/// To the program that reads standard output, at once.
void log_program(const std::string& lines);

/// Why the run fails, for the program that reads standard output. log_error() does that by itself.
void log_program_failure(const std::string& text);

/// Draws a terminal's last line over; empty: wipes it out. So does each message, before it.
void show_bar(const std::string& text);

}  // namespace raytrace
