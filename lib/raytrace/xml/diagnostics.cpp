#include "raytrace/xml/diagnostics.h"

#include <algorithm>
#include <ostream>
#include <tuple>

#include "raytrace/text/message.h"

namespace raytrace {

void LineMark::pass(std::string_view passed) {
  for (std::size_t at = passed.find('\n'); at != std::string_view::npos; at = passed.find('\n', at + 1)) {
    ++line;
    line_start = offset + at + 1;
  }
  offset += passed.size();
}

SourceLocation LineMark::location() const {
  return {line, static_cast<std::uint32_t>(offset - std::min(offset, line_start) + 1)};
}

LineMark first_mark(std::string_view text, std::uint32_t line) {
  return {0, line, text.starts_with(byte_order_mark) ? byte_order_mark.size() : 0};
}

SourceLocation locate(std::string_view text, std::size_t offset) {
  LineMark mark = first_mark(text);
  mark.pass(text.substr(0, offset));
  return mark.location();
}

Diagnostics Diagnostics::counter() {
  Diagnostics counter{std::string()};
  counter.limit_ = 0;
  return counter;
}

void Diagnostics::count(const Diagnostics& other) {
  error_count_ += other.error_count_;
  warning_count_ += other.warning_count_;
}

void Diagnostics::append(const Diagnostics& other) {
  for (const Diagnostic& diagnostic : other.kept_) {
    if (!keeps_another(diagnostic.severity)) continue;
    kept_.push_back(diagnostic);
    if (diagnostic.file.empty()) kept_.back().file = other.file_;
  }
  count(other);
  repeat_count_ += other.repeat_count_;
}

void Diagnostics::add_files(std::span<const IncludedFile> files) {
  for (const IncludedFile& file : files)
    if (included_.empty() || file.first_line > included_.back().first_line)
      included_.push_back({on_one_line(file.name), file.first_line});
}

const IncludedFile* Diagnostics::file_of(std::uint32_t line) const {
  const auto next = std::upper_bound(included_.begin(), included_.end(), line,
                                     [](std::uint32_t wanted, const IncludedFile& f) { return wanted < f.first_line; });
  return next == included_.begin() ? nullptr : &*(next - 1);
}

std::string Diagnostics::line_name(std::uint32_t line, std::uint32_t from) const {
  const IncludedFile* const file = file_of(line);
  const std::string text = "line " + std::to_string(file != nullptr ? line - file->first_line + 1 : line);
  return file == file_of(from) ? text : text + " of " + (file != nullptr ? file->name : file_);
}

void Diagnostics::add(Severity severity, SourceLocation location, std::string message) {
  if (keeps_another(severity)) {
    Diagnostic& added = kept_.emplace_back(Diagnostic{severity, location, std::move(message)});
    if (const IncludedFile* const file = file_of(location.line)) {
      added.file = file->name;
      added.location.line -= file->first_line - 1;
    }
  }
  ++(severity == Severity::error ? error_count_ : warning_count_);
}

bool Diagnostics::count_repeat(const std::string& cause) {
  if (const auto known = causes_.find(cause); known != causes_.end()) {
    ++kept_[known->second].repeats;
    ++error_count_;
    ++repeat_count_;
    return true;
  }
  if (keeps_another(Severity::error)) causes_[cause] = kept_.size();
  return false;
}

void Diagnostics::print(std::ostream& out) const {
  std::vector<const Diagnostic*> sorted;
  for (const Diagnostic& diagnostic : kept_) sorted.push_back(&diagnostic);
  // Files, and what is at one location, in the order of their discovery, which for the latter is that of addresses.
  std::map<std::string_view, std::size_t> files{{{}, 0}};
  for (const Diagnostic& diagnostic : kept_) files.try_emplace(diagnostic.file, files.size());
  std::sort(sorted.begin(), sorted.end(), [&](const Diagnostic* a, const Diagnostic* b) {
    return std::tuple(files.at(a->file), a->location.line, a->location.column, a) <
           std::tuple(files.at(b->file), b->location.line, b->location.column, b);
  });

  // Numbers by to_string: a stream's locale may group their digits.
  for (const Diagnostic* diagnostic : sorted) {
    out << (diagnostic->file.empty() ? file_ : diagnostic->file);
    if (diagnostic->location.line > 0) out << ':' << std::to_string(diagnostic->location.line);
    if (diagnostic->location.column > 0) out << ':' << std::to_string(diagnostic->location.column);
    out << (diagnostic->severity == Severity::error ? ": error: " : ": warning: ") << diagnostic->message;
    if (diagnostic->repeats > 0) out << " (and at " << std::to_string(diagnostic->repeats) << " other places)";
    out << '\n';
  }
  const auto print_rest = [&](std::size_t count, const char* what) {
    if (count > most_kept)
      out << file_ << ": " << std::to_string(count - most_kept) << " more " << what << " not shown\n";
  };
  print_rest(error_count_ - repeat_count_, "errors");
  print_rest(warning_count_, "warnings");
}

}  // namespace raytrace
