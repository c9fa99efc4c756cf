#include "jobs.h"

#include <algorithm>
#include <new>
#include <system_error>
#include <typeinfo>
#include <unordered_set>
#include <utility>
#include <vector>

#include "exit_code.h"
#include "file_clash.h"
#include "file_names.h"
#include "frame_numbers.h"
#include "memory_limit.h"
#include "messages.h"
#include "raytrace/memory/out_of_memory.h"
#include "raytrace/output/output_error.h"

namespace raytrace {

Jobs::Jobs(Options options) : options_(std::move(options)) {
  std::swap(scenes_, options_.scenes);
  std::swap(frames_, options_.frames);
  if (!frames_.empty()) {
    for (auto* const names : {&scenes_, &options_.outputs})
      for (std::string& name : *names) name = with_folders_kept(name);
    for (auto* const name : {&options_.statistics, &options_.checkpoint}) *name = with_folders_kept(*name);
  }
  const auto from_standard_input = std::count(scenes_.begin(), scenes_.end(), "-");
  if (from_standard_input > 1 || (from_standard_input == 1 && frame_count() > 1)) {
    throw UsageError("standard input can be read once; give a file for " +
                     std::string(frame_count() > 1 ? "several frames" : "the second scene"));
  }
  if (options_.print_scene && count() > 1) {
    throw UsageError(
        "--print-scene prints one scene; give one" +
        (frame_count() > 1 ? ", and one frame, e.g. --frames " + std::to_string(frames_.front()) : std::string()));
  }
  refuse_clashes();
}

void Jobs::refuse_clashes() const {
  UsedFiles files;
  if (!options_.log_file.empty()) files.add({"--log-file", options_.log_file, true});
  const auto add_written = [&](const std::string& option, const std::string& pattern, const std::string& name) {
    const UsedFile file{option, name, true};
    const UsedFile* const other = files.add(file);
    if (other == nullptr) return;
    if (other->role != option || other->file != name) refuse_clash(file, *other);
    const std::string tokens = with_tokens(pattern, frame_count() > 1, scenes_.size() > 1);
    throw UsageError(
        option + ": more than one render would write " + name + "; " +
        (tokens == pattern ? "give scenes and outputs names that differ" : "use a name such as " + tokens));
  };
  std::string last_scene;
  for (std::size_t i = 0; i < count(); ++i) {
    const Options job = (*this)[i];
    if (job.scene != last_scene) add_file(files, {"the scene", job.scene == "-" ? "/dev/stdin" : job.scene, false});
    last_scene = job.scene;
    if (!options_.renders()) continue;
    for (std::size_t k = 0; k < job.outputs.size(); ++k) add_written("--output", options_.outputs[k], job.outputs[k]);
    if (job.has_statistics_file()) add_written("--stats", options_.statistics, job.statistics);
    if (!job.checkpoint.empty()) add_written("--checkpoint", options_.checkpoint, job.checkpoint);
  }
}

std::optional<int> Jobs::frame(std::size_t i) const {
  if (frames_.empty()) return std::nullopt;
  return frames_[i % frame_count()];
}

std::string Jobs::scene(std::size_t i) const { return scene_file_name(scenes_[i / frame_count()], frame(i)); }

std::string Jobs::name(std::size_t i) const {
  const std::optional<int> number = frame(i);
  return scene(i) + (number ? ", frame " + std::to_string(*number) : "");
}

Options Jobs::operator[](std::size_t i) const {
  Options job = options_;
  job.scene = scene(i);
  job.frame = frame(i).value_or(job.frame);
  job.is_one_of_frames = frame(i).has_value();
  job.job_index = i;
  job.job_count = count();
  const NameValues values{frame(i), job.tile ? std::optional(job.tile->index) : std::nullopt, job.scene};
  for (std::string& output : job.outputs) output = file_name(output, values);
  if (job.has_statistics_file()) job.statistics = file_name(job.statistics, values);
  if (!job.checkpoint.empty()) job.checkpoint = file_name(job.checkpoint, values);
  return job;
}

std::vector<std::string> Jobs::names(const std::vector<std::size_t>& some) const {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < some.size();) {
    const std::size_t scene_number = some[k] / frame_count();
    std::vector<int> numbers;
    const std::size_t first = some[k];
    for (; k < some.size() && some[k] / frame_count() == scene_number; ++k)
      numbers.push_back(frame(some[k]).value_or(0));
    names.push_back(numbers.size() == 1 ? name(first) : scenes_[scene_number] + ", frames " + frames_text(numbers));
  }
  return names;
}

int run_all(const Jobs& jobs, const std::function<int(const Options&)>& run) {
  if (jobs.count() == 1) return run(jobs[0]);
  std::vector<std::size_t> failed;
  int common_code = exit_code::done;
  for (std::size_t i = 0; i < jobs.count(); ++i) {
    const Options job = jobs[i];
    log_step(jobs.name(i) + " (" + std::to_string(i + 1) + " of " + std::to_string(jobs.count()) + ")");
    const std::size_t told_before = message_count();
    const int code = run_reporting_errors([&] { return run(job); });
    if (code == exit_code::done) continue;
    // All others say that the program was stopped.
    if (code != exit_code::failed && code != exit_code::usage && code != exit_code::out_of_memory) {
      log_note("stopped at " + jobs.name(i) + ", " + std::to_string(i + 1) + " of " + counted(jobs.count(), "render"));
      return code;
    }
    if (message_count() > told_before) log_error(jobs.name(i) + ": failed");
    common_code = failed.empty() || code == common_code ? code : exit_code::failed;
    failed.push_back(i);
  }
  if (failed.empty()) return exit_code::done;
  std::vector<std::string> names;
  for (const std::string& name : jobs.names(failed)) names.push_back("  " + name);
  log_error(std::to_string(failed.size()) + " of " + counted(jobs.count(), "render") + " failed:", names);
  return common_code;
}

namespace {

/// An error that several renders have in common is reported once.
void log_new_error(const std::string& text, const std::vector<std::string>& more_lines = {}) {
  static std::unordered_set<std::string> told;
  if (told.insert(text).second) log_error(text, more_lines);
}

}  // namespace

int run_reporting_errors(const std::function<int()>& action) {
  const auto log_no_memory = [](const std::string& more) {
    log_new_error("out of memory" + memory_limit_text() + more);
    return exit_code::out_of_memory;
  };
  try {
    return action();
  } catch (const UsageError& error) {
    std::vector<std::string> more_lines = error.more_lines();
    more_lines.emplace_back("Try 'raytrace --help'.");
    log_new_error(error.what(), more_lines);
    return exit_code::usage;
  } catch (const SizeError& error) {  // what was asked for cannot be, and nothing was rendered for it
    log_new_error(error.what());
    return exit_code::usage;
  } catch (const std::bad_alloc&) {
    return log_no_memory("");
  } catch (const std::system_error& error) {
    // Mostly of a thread that could not be started.
    if (error.code() != std::errc::resource_unavailable_try_again && error.code() != std::errc::not_enough_memory) {
      log_new_error(error.what());
      return exit_code::failed;
    }
    return log_no_memory(std::string(" or of threads, of which -t N takes fewer: ") + error.what());
  } catch (const std::exception& error) {
    const bool is_library_error = typeid(error) == typeid(std::runtime_error);  // oneTBB's; others bear names of files
    if (is_library_error && says_out_of_memory(error.what())) return log_no_memory(std::string(": ") + error.what());
    log_new_error(error.what());
    return exit_code::failed;
  }
}

}  // namespace raytrace
