#include "raytrace/xml/diagnostics.h"

#include <algorithm>
#include <ostream>
#include <tuple>

namespace raytrace {

Diagnostics Diagnostics::counter() {
  Diagnostics counter{std::string()};
  counter.limit_ = 0;
  return counter;
}

void Diagnostics::count(const Diagnostics& other) {
  error_count_ += other.error_count_;
  warning_count_ += other.warning_count_;
}

void Diagnostics::error(SourceLocation location, std::string message) {
  if (keeps_another(Severity::error)) kept_.push_back({Severity::error, location, std::move(message)});
  ++error_count_;
}

void Diagnostics::warning(SourceLocation location, std::string message) {
  if (keeps_another(Severity::warning)) kept_.push_back({Severity::warning, location, std::move(message)});
  ++warning_count_;
}

bool Diagnostics::repeats(const std::string& cause) {
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
  // At one place in the order of their discovery, which is that of their addresses.
  std::sort(sorted.begin(), sorted.end(), [](const Diagnostic* a, const Diagnostic* b) {
    return std::tie(a->location.line, a->location.column, a) < std::tie(b->location.line, b->location.column, b);
  });

  // Numbers by to_string: a stream's locale may group their digits.
  for (const Diagnostic* diagnostic : sorted) {
    out << file_;
    if (diagnostic->location.line > 0) out << ':' << std::to_string(diagnostic->location.line);
    if (diagnostic->location.column > 0) out << ':' << std::to_string(diagnostic->location.column);
    out << (diagnostic->severity == Severity::error ? ": error: " : ": warning: ") << diagnostic->message;
    if (diagnostic->repeats > 0) out << " (and at " << std::to_string(diagnostic->repeats) << " other places)";
    out << '\n';
  }
  const auto count_rest = [&](std::size_t count, const char* what) {
    if (count > most_kept)
      out << file_ << ": " << std::to_string(count - most_kept) << " more " << what << " not shown\n";
  };
  count_rest(error_count_ - repeat_count_, "errors");
  count_rest(warning_count_, "warnings");
}

}  // namespace raytrace
