#include "run_checks.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>

#include "messages.h"
#include "raytrace/output/atomic_file.h"
#include "signals.h"
#include "stages.h"

namespace raytrace {

namespace {

/// With a "/" at its end, so that none has the name of a scene.
std::string folder_of(const std::string& file) { return (std::filesystem::path(file).parent_path() / "").string(); }

/// Throws OutputError.
void try_to_write(const std::string& file) { const AtomicFile made_and_removed(file); }

bool takes_files(const std::string& folder) {
  try {
    try_to_write(folder + ".raytrace-checked");
    return true;
  } catch (const OutputError&) {
    return false;
  }
}

}  // namespace

RunChecks::RunChecks(const Jobs& jobs) {
  if (jobs.count() == 1) return;
  const StopSignalsWait no_temporary_file_stays;
  for (std::size_t i = 0; i < jobs.count(); ++i) {
    const Options job = jobs[i];
    if (i == 0 && job.renders()) check_formats(job);
    check_scene(job);
    if (!job.renders() || might_be_skipped(job)) continue;  // what is skipped may be in a folder that is read-only
    check_checkpoint(job);
    check_folders(job);
  }
}

void RunChecks::check_scene(const Options& job) {
  if (job.scene == "-" || !checked_.insert(job.scene).second || access(job.scene.c_str(), R_OK) == 0) return;
  // Reading it tells why.
  Statistics unused;
  if (!load(job, unused)) bad_.insert(job.scene);
}

void RunChecks::check_folders(const Options& job) {
  for (const std::string& file : job.files()) {
    const std::string folder = folder_of(file);
    if (!checked_.insert(folder).second || takes_files(folder)) continue;
    bad_.insert(folder);
    try {
      try_to_write(file);  // its error tells the user's name
    } catch (const OutputError& error) {
      log_error(error.what());
    }
  }
}

bool RunChecks::forbid(const Options& job) const {
  if (bad_.empty()) return false;
  if (bad_.contains(job.scene)) return true;
  if (!job.renders() || might_be_skipped(job)) return false;
  const std::vector<std::string> files = job.files();
  return std::any_of(files.begin(), files.end(),
                     [&](const std::string& file) { return bad_.contains(folder_of(file)); });
}

}  // namespace raytrace
