// The renders of a run: each frame of each scene.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "options.h"

namespace raytrace {

class Jobs {
 public:
  /// Throws UsageError if a file that is written would be another file of the run, too, or if the scenes cannot be read
  /// so often. Opens none of them.
  explicit Jobs(Options options);

  /// All frames of the first scene, then those of the next.
  std::size_t count() const { return scenes_.size() * frame_count(); }

  /// The run's options with the render's scene, frame and file names.
  Options operator[](std::size_t i) const;

  /// "scene.xml, frame 7"
  std::string name(std::size_t i) const;

  /// The names of some, in their order, those of a scene's frames together: "scene.xml, frames 1-7,9"
  std::vector<std::string> names(const std::vector<std::size_t>& some) const;

 private:
  std::size_t frame_count() const { return frames_.empty() ? 1 : frames_.size(); }
  std::optional<int> frame(std::size_t i) const;
  std::string scene(std::size_t i) const;
  void refuse_clashes() const;

  Options options_;  // without scenes and frames, of which there may be many: all renders' options are copies
  std::vector<std::string> scenes_;
  std::vector<int> frames_;
};

/// Renders all jobs by `run`, which gives an exit code or throws. One that fails does not stop the others; in the end
/// they are named, and what several have in common is reported for the first of them. The exit code is the one that all
/// that failed have in common, or exit_code::failed. A signal stops them all.
int run_all(const Jobs& jobs, const std::function<int(const Options&)>& run);

/// What `action` gives; if it throws, the exit code for that, and the error is reported.
int run_reporting_errors(const std::function<int()>& action);

}  // namespace raytrace
