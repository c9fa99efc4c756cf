// The errors and warnings about a scene's files, gathered so that one run reports all of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace raytrace {

/// Both count from 1, columns in bytes. 0: unknown. Lines count on through the files that a scene includes
/// (IncludedFile), so that one number says which file and line it is.
struct SourceLocation {
  std::uint32_t line = 0;
  std::uint32_t column = 0;
};

/// A file that a scene's file includes, and the number of its first line, which is larger than all of the files before
/// it. It has the lines from there on that no other file has.
struct IncludedFile {
  std::string name;
  std::uint32_t first_line;
};

/// What some editors put at the start of a UTF-8 file. None of them shows it, so columns do not count it.
inline constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

/// A byte of a text, from which lines may be counted on.
struct LineMark {
  std::size_t offset = 0;
  std::uint32_t line = 1;      ///< that it is in
  std::size_t line_start = 0;  ///< where that line starts, a byte order mark left out

  /// Moves on over a text that starts with the byte.
  void pass(std::string_view passed);
  SourceLocation location() const;
};

/// The first byte, which is in that line.
LineMark first_mark(std::string_view text, std::uint32_t line = 1);

/// Of the byte at an offset.
SourceLocation locate(std::string_view text, std::size_t offset);

/// An error in a text, by the offset of its byte.
struct TextError {
  std::size_t offset;
  std::string message;
};

enum class Severity { warning, error };

struct Diagnostic {
  Severity severity;
  SourceLocation location;  ///< its line is that of its own file
  std::string message;
  std::size_t repeats = 0;  ///< other locations with the same cause
  std::string file = {};    ///< if it is another than the Diagnostics'
};

/// The diagnostics about one file and those that it includes.
class Diagnostics {
 public:
  /// file: as given on the command line; messages show "<stdin>" for "-".
  explicit Diagnostics(std::string file) : file_(file == "-" ? "<stdin>" : std::move(file)) {}

  /// Keeps none and only counts.
  static Diagnostics counter();

  /// At most `most_kept` diagnostics of each severity are kept, the rest only counted: a file of a million bad objects
  /// must not exhaust the memory or the terminal.
  static constexpr std::size_t most_kept = 100;

  /// In their order. Those that it knows already are left out.
  void add_files(std::span<const IncludedFile> files);

  /// How a message about line `from` names a line: "line 3", or "line 3 of other.xml".
  std::string line_name(std::uint32_t line, std::uint32_t from) const;

  void add(Severity severity, SourceLocation location, std::string message);
  void error(SourceLocation location, std::string message) { add(Severity::error, location, std::move(message)); }
  void warning(SourceLocation location, std::string message) { add(Severity::warning, location, std::move(message)); }

  /// at: an Element, Node or Attribute. make_message() is called, and `at` located, only if the diagnostic is kept:
  /// both cost more than reading does.
  template <class At, class MakeMessage>
  void report(Severity severity, const At& at, const MakeMessage& make_message) {
    if (keeps_another(severity))
      add(severity, at.location(), make_message());
    else
      add(severity, {}, {});
  }
  template <class At, class MakeMessage>
  void error(const At& at, const MakeMessage& make_message) {
    report(Severity::error, at, make_message);
  }
  template <class At, class MakeMessage>
  void warning(const At& at, const MakeMessage& make_message) {
    report(Severity::warning, at, make_message);
  }

  /// An error whose cause lies elsewhere, such as a variable that is not set: it is kept once, and then only counted.
  template <class At, class MakeMessage>
  void error_once(const std::string& cause, const At& at, const MakeMessage& make_message) {
    if (!count_repeat(cause)) error(at, make_message);
  }

  /// Appends those of another file.
  void append(const Diagnostics& other);

  /// Counts the diagnostics of another, without keeping them.
  void count(const Diagnostics& other);

  bool has_errors() const { return error_count_ > 0; }
  std::size_t error_count() const { return error_count_; }
  std::size_t warning_count() const { return warning_count_; }
  /// The name that messages show.
  const std::string& file() const { return file_; }
  /// In the order of their discovery.
  const std::vector<Diagnostic>& kept() const { return kept_; }

  /// True while another diagnostic of that severity would be kept.
  bool keeps_another(Severity severity) const {
    return (severity == Severity::error ? error_count_ - repeat_count_ : warning_count_) < limit_;
  }

  /// One line each, "file:line:column: error: message", in the order of the file, those of other files behind, file by
  /// file, then the counts of those not kept. A line or column of 0 is left out.
  void print(std::ostream& out) const;

 private:
  /// Null: its own.
  const IncludedFile* file_of(std::uint32_t line) const;

  /// Whether an error of that cause is kept; the error at hand is then counted. Otherwise the next error is its first.
  bool count_repeat(const std::string& cause);

  std::string file_;
  std::vector<IncludedFile> included_;
  std::size_t limit_ = most_kept;
  std::vector<Diagnostic> kept_;
  std::size_t error_count_ = 0, warning_count_ = 0, repeat_count_ = 0;
  std::map<std::string, std::size_t> causes_;  ///< the kept diagnostic of each
};

}  // namespace raytrace
