// Settings of a render or a merge that cannot be meant.
#pragma once

#include <stdexcept>

namespace raytrace {

/// Settings that contradict each other, the scene, or the files that there are. what() calls a setting what the command
/// calls its option, and says what would be right.
class SettingsError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace raytrace
