// What is wrong or doubtful in a scene file, gathered so that one run reports all of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace raytrace {

/// A place in a scene file; both count from 1, columns in bytes. 0: unknown.
struct SourceLocation {
  std::uint32_t line = 0;
  std::uint32_t column = 0;
};

enum class Severity { warning, error };

struct Diagnostic {
  Severity severity;
  SourceLocation location;
  std::string message;
  std::size_t repeats = 0;  ///< other places with the same cause
};

/// The diagnostics about one file.
class Diagnostics {
 public:
  /// file: as given on the command line; messages show "<stdin>" for "-".
  explicit Diagnostics(std::string file) : file_(file == "-" ? "<stdin>" : std::move(file)) {}

  /// Keeps none and only counts.
  static Diagnostics counter();

  /// At most `most_kept` diagnostics of each severity are kept, the rest only counted: a file of a million bad objects
  /// must not exhaust the memory or the terminal.
  static constexpr std::size_t most_kept = 100;

  void error(SourceLocation location, std::string message);
  void warning(SourceLocation location, std::string message);
  /// Whether an error of this cause, which lies elsewhere than at any of its places, is kept already. It is then
  /// counted as a repeat; otherwise the next error is the one of this cause.
  bool repeats(const std::string& cause);
  /// Counts the diagnostics of another, without keeping them.
  void count(const Diagnostics& other);

  bool has_errors() const { return error_count_ > 0; }
  std::size_t error_count() const { return error_count_; }
  std::size_t warning_count() const { return warning_count_; }
  /// The name that messages show.
  const std::string& file() const { return file_; }
  /// In the order of their discovery.
  const std::vector<Diagnostic>& kept() const { return kept_; }

  /// True while another diagnostic of that severity would be kept: diagnostic a column costs a scan of the file, so
  /// callers may leave out location and message for the rest (xml/report.h does).
  bool keeps_another(Severity severity) const {
    return (severity == Severity::error ? error_count_ - repeat_count_ : warning_count_) < limit_;
  }

  /// One line each, "file:line:column: error: message", in the order of the file, then the counts of those not kept.
  /// A line or column of 0 is left out.
  void print(std::ostream& out) const;

 private:
  std::string file_;
  std::size_t limit_ = most_kept;
  std::vector<Diagnostic> kept_;
  std::size_t error_count_ = 0;
  std::size_t warning_count_ = 0;
  std::map<std::string, std::size_t> causes_;  ///< the diagnostic of each
  std::size_t repeat_count_ = 0;
};

}  // namespace raytrace
