#include "messages.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <mutex>
#include <sstream>
#include <string_view>
#include <unordered_set>

#include "raytrace/output/file_handle.h"
#include "raytrace/output/file_identity.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

Verbosity logged_verbosity = Verbosity::warnings;
ProgressStyle program_style = ProgressStyle::none;
int log_file = -1;
std::string log_name;

std::mutex mutex;  // guards what follows, and the order of what is written
bool bar_is_shown = false;
std::size_t messages_logged = 0;

std::string utc_time() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ ", &parts)};
}

/// Everything, to a person.
void write_shown(std::string_view text) { std::fwrite(text.data(), 1, text.size(), stderr); }

std::string wiped_bar() {
  const bool shown = bar_is_shown;
  bar_is_shown = false;
  return shown ? "\r\033[K" : "";
}

/// Each line in one piece, so that several programs can share a log.
void log(std::string_view lines) {
  const std::string time = utc_time();
  while (log_file >= 0 && !lines.empty()) {
    const std::size_t length = lines.find('\n') + 1;  // every message ends with a line end
    const std::string line = time + std::string(lines.substr(0, length));
    lines.remove_prefix(length);
    if (::write(log_file, line.data(), line.size()) == static_cast<ssize_t>(line.size())) continue;
    write_shown("raytrace: warning: " + on_one_line(log_name) + " takes no more: " + std::strerror(errno) + "\n");
    close(log_file);
    log_file = -1;
  }
}

void write_message(const std::string& text) {
  const std::lock_guard lock(mutex);
  write_shown(wiped_bar() + text);
  log(text);
  ++messages_logged;
}

void write_message(const char* weight, const std::string& text, const std::vector<std::string>& more_lines = {}) {
  std::string message = std::string("raytrace: ") + weight + on_one_line(text) + "\n";
  for (const std::string& line : more_lines) message += on_one_line(line) + "\n";
  write_message(message);
}

}  // namespace

void set_verbosity(Verbosity verbosity) { logged_verbosity = verbosity; }

void log_to(const std::string& file) {
  constexpr mode_t by_umask = 0666;
  link_target(file);  // refuses another user's trap
  log_file = open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, by_umask);
  if (log_file < 0) throw OutputError("cannot write the log file " + file + ": " + std::strerror(errno));
  log_name = file;
}

void end_log() {
  const std::lock_guard lock(mutex);
  if (log_file >= 0) close(log_file);
  log_file = -1;
}

void log_program_in(ProgressStyle style) {
  if (is_for_programs(style)) program_style = style;
}

std::size_t message_count() {
  const std::lock_guard lock(mutex);
  return messages_logged;
}

bool is_logged(Verbosity verbosity) { return verbosity <= logged_verbosity; }

void log_error(const std::string& text, const std::vector<std::string>& more_lines) {
  write_message("error: ", text, more_lines);
  std::string on_line = text;
  for (const std::string& line : more_lines) on_line += " " + line;
  log_program_failure(on_line);
}

void log_warning(const std::string& text) {
  if (is_logged(Verbosity::warnings)) write_message("warning: ", text);
}

void log_note(const std::string& text) {
  if (is_logged(Verbosity::warnings)) write_message("", text);
}

void log_step(const std::string& text) {
  if (is_logged(Verbosity::steps)) write_message("", text);
  log_program(status_line(program_style, text));
}

void log_lines(const std::string& lines) {
  std::string message;
  std::istringstream stream(lines);
  for (std::string line; std::getline(stream, line);) message += on_one_line(line) + "\n";
  write_message(message);
}

void log_diagnostics(const Diagnostics& diagnostics) {
  static std::string file;
  static std::unordered_set<std::string> logged;
  if (!diagnostics.has_errors() && !is_logged(Verbosity::warnings)) return;
  if (file != diagnostics.file()) logged.clear();
  file = diagnostics.file();
  std::stringstream lines;
  diagnostics.print(lines);
  std::string news, first_error;
  for (std::string line; std::getline(lines, line);) {
    if (!logged.insert(line).second) continue;
    news += line + "\n";
    if (first_error.empty() && line.find(": error: ") != std::string::npos) first_error = line;
  }
  if (!news.empty()) log_lines(news);
  if (!first_error.empty()) log_program_failure(first_error);
}

void log_progress(const std::string& text) {
  const std::lock_guard lock(mutex);
  write_shown("raytrace: " + text + "\n");
}

void log_program(const std::string& lines) {
  const std::lock_guard lock(mutex);
  std::fwrite(lines.data(), 1, lines.size(), stdout);
  std::fflush(stdout);
}

void print(const std::string& text) {
  const std::lock_guard lock(mutex);
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return;
  throw OutputError(std::string("cannot write to standard output: ") + std::strerror(errno != 0 ? errno : EIO));
}

void log_program_failure(const std::string& text) { log_program(failure_line(program_style, text)); }

void show_bar(const std::string& text) {
  const std::lock_guard lock(mutex);
  if (text.empty()) {
    write_shown(wiped_bar());
  } else {
    write_shown("\r" + text + "\033[K");
    bar_is_shown = true;
  }
}

}  // namespace raytrace
