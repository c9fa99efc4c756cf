#include "run_all.h"

#include <new>
#include <string>
#include <system_error>
#include <typeinfo>
#include <unordered_set>
#include <vector>

#include "messages.h"
#include "option_values.h"
#include "process.h"
#include "raytrace/memory/out_of_memory.h"
#include "raytrace/output/file_handle.h"
#include "raytrace/text/message.h"

namespace raytrace {

int run_all(const RenderBatch& batch, const std::function<int(const RenderJob&, std::size_t)>& run) {
  if (batch.size() == 1) return run(batch[0], 0);
  std::vector<std::size_t> failed;
  int common_code = exit_code::done;
  const std::string count = std::to_string(batch.size());
  for (std::size_t i = 0; i < batch.size(); ++i) {
    log_step(batch.name(i) + " (" + std::to_string(i + 1) + " of " + count + ")");
    const std::size_t messages_before = message_count();
    const int code = run_reporting_errors([&] { return run(batch[i], i); });
    if (code == exit_code::done) continue;
    // All others say that the program was stopped.
    if (code != exit_code::failed && code != exit_code::usage && code != exit_code::out_of_memory) {
      log_note("stopped at " + batch.name(i) + ", " + std::to_string(i + 1) + " of " + count + " renders");
      return code;
    }
    if (message_count() > messages_before) log_error(batch.name(i) + ": failed");
    common_code = failed.empty() || code == common_code ? code : exit_code::failed;
    failed.push_back(i);
  }
  if (failed.empty()) return exit_code::done;
  std::vector<std::string> names;
  for (const std::string& name : batch.names(failed)) names.push_back("  " + name);
  log_error(std::to_string(failed.size()) + " of " + count + " renders failed:", names);
  return common_code;
}

namespace {

/// An error that several renders have in common is reported once.
void log_new_error(const std::string& text, const std::vector<std::string>& more_lines = {}) {
  static std::unordered_set<std::string> reported;
  if (reported.insert(text).second) log_error(text, more_lines);
}

}  // namespace

int run_reporting_errors(const std::function<int()>& action) {
  const auto log_no_memory = [](const std::string& more) {
    log_new_error("out of memory" + memory_limit_text() + more);
    return exit_code::out_of_memory;
  };
  const auto log_misuse = [](const std::exception& error, std::vector<std::string> more_lines) {
    more_lines.emplace_back("Try 'raytrace --help'.");
    log_new_error(error.what(), more_lines);
    return exit_code::usage;
  };
  try {
    return action();
  } catch (const UsageError& error) {
    return log_misuse(error, error.more_lines());
  } catch (const SettingsError& error) {
    return log_misuse(error, {});
  } catch (const FormatError& error) {  // what was asked for cannot be, and nothing was rendered for it
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
