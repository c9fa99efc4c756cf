// What is wrong with a run of several renders, found before the first of them.
#pragma once

#include <string>
#include <unordered_set>

#include "jobs.h"

namespace raytrace {

/// What would fail in the same way again and again is told once: folders that cannot be written to, scenes that cannot
/// be read. Throws OutputError or UsageError for what would fail all renders: a format, a checkpoint that is there
/// without --resume.
class RunChecks {
 public:
  /// Checks nothing of a run of one render.
  explicit RunChecks(const Jobs& jobs);

  /// Whether a render cannot be for what was told.
  bool forbid(const Options& job) const;

 private:
  void check_scene(const Options& job);
  void check_folders(const Options& job);

  std::unordered_set<std::string> checked_, bad_;  ///< scenes and folders
};

}  // namespace raytrace
