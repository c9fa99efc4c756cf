// The date that pictures carry, fixed or not.
#pragma once

#include <cstdlib>
#include <optional>
#include <string>

namespace raytrace::test {

/// SOURCE_DATE_EPOCH in the environment, or not, for a while.
class SourceDateEpoch {
 public:
  explicit SourceDateEpoch(const char* value) {
    if (const char* const before = std::getenv(name)) before_ = before;
    set(value);
  }
  ~SourceDateEpoch() { set(before_ ? before_->c_str() : nullptr); }
  SourceDateEpoch(const SourceDateEpoch&) = delete;
  SourceDateEpoch& operator=(const SourceDateEpoch&) = delete;

 private:
  static constexpr const char* name = "SOURCE_DATE_EPOCH";
  static void set(const char* value) {
    if (value != nullptr) {
      setenv(name, value, 1);
    } else {
      unsetenv(name);
    }
  }
  std::optional<std::string> before_;
};

}  // namespace raytrace::test
