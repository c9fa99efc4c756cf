#include "process.h"

#include <fcntl.h>
#include <malloc.h>
#include <pthread.h>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>
#include <sstream>

#include "messages.h"
#include "raytrace/memory/process_status.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

/// Until whoever holds it lets it go.
void* wait_at(void* gate) {
  const std::lock_guard passing(*static_cast<std::mutex*>(gate));
  return nullptr;
}

/// A file's text; empty if there is none.
std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// Whether `name` is one of the words between commas.
bool lists(const std::string& words, const std::string& name) {
  return ("," + words + ",").find("," + name + ",") != std::string::npos;
}

/// The path of this process in the hierarchy that controls memory: that of version 1, or of version 2 if there is none.
/// Lines of /proc/self/cgroup: number, controllers, path; version 2 has no controllers.
struct GroupPath {
  bool version_1 = false;
  std::string path;
};

std::optional<GroupPath> group_path(const std::string& cgroups) {
  std::optional<GroupPath> result;
  std::istringstream lines(cgroups);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const bool version_1 = lists(controllers, "memory");
    if (version_1 || (controllers.empty() && !result)) result = {version_1, line.substr(second + 1)};
  }
  return result;
}

/// Where that hierarchy is mounted, and the group that is its root there.
/// Lines of /proc/self/mountinfo: number, parent, device, root, mount point, options, ..., "-", type, source, options.
struct GroupMount {
  std::string root, folder;
};

std::optional<GroupMount> group_mount(const std::string& mountinfo, bool version_1) {
  std::istringstream lines(mountinfo);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t separator = line.find(" - ");
    if (separator == std::string::npos) continue;
    std::istringstream start(line), end(line.substr(separator + 3));
    std::string skipped, type, options;
    GroupMount mount;
    start >> skipped >> skipped >> skipped >> mount.root >> mount.folder;
    end >> type >> skipped >> options;
    if (version_1 ? type == "cgroup" && lists(options, "memory") : type == "cgroup2") return mount;
  }
  return std::nullopt;
}

/// That of one group; "max" and the largest number that there is mean none.
std::optional<std::uint64_t> limit_in(const std::string& folder) {
  constexpr std::uint64_t none = std::uint64_t{1} << 60U;
  for (const char* const name : {"/memory.max", "/memory.limit_in_bytes"}) {
    std::uint64_t limit = 0;
    if (std::istringstream(text_of(folder + name)) >> limit && limit < none) return limit;
  }
  return std::nullopt;
}

/// What was freed, whose pages go back to the system: it is reserved, but will be touched again.
std::uint64_t given_back() {
#if defined(__GLIBC__)
  malloc_trim(0);
  return mallinfo2().fordblks;
#else
  return 0;
#endif
}

/// What is reserved, and counts for RLIMIT_DATA, but is never touched, and does not count for the group: large parts
/// of stacks, and 128 MiB of a device of Embree 3.
std::uint64_t untouched_memory() {
  const std::uint64_t to_be_touched = given_back();
  const std::uint64_t reserved = process_status_bytes("VmData"), touched = process_status_bytes("RssAnon");
  return reserved - std::min(touched + to_be_touched, reserved);
}

/// Of OpenEXR's and OpenImageIO's threads, for each worker.
constexpr std::uint64_t library_stacks = std::uint64_t{2} << 20U;

std::uint64_t worker_stack() { return tbb::global_control::active_value(tbb::global_control::thread_stack_size); }

std::uint64_t kept_stacks = 0;  ///< of threads that ended, which glibc keeps for those to come

/// What the threads that are still to be started will reserve for their stacks. oneTBB starts no more than there are
/// processors.
std::uint64_t stacks_to_come(int threads) {
  const int workers = std::min(threads, tbb::info::default_concurrency()) - 1;
  const std::uint64_t wanted =
      static_cast<std::uint64_t>(workers) * worker_stack() + static_cast<std::uint64_t>(threads) * library_stacks;
  const std::uint64_t running = (process_status("Threads") - 1) * worker_stack();
  return wanted - std::min(wanted, std::max(running, kept_stacks));
}

/// The least that a group of this process allows, in bytes.
std::optional<std::uint64_t> group_memory_limit() {
  std::optional<std::uint64_t> least;
  for (const std::string& folder :
       memory_group_folders(text_of("/proc/self/cgroup"), text_of("/proc/self/mountinfo"))) {
    const std::optional<std::uint64_t> limit = limit_in(folder);
    if (limit) least = std::min(*limit, least.value_or(*limit));
  }
  return least;
}

std::uint64_t obeyed_limit = 0;  ///< a group's; 0: none

constexpr std::size_t main_stack = std::size_t{8} << 20U;     // as Linux gives it by default
constexpr std::size_t library_stack = std::size_t{1} << 20U;  // of which a few KiB are used

/// Each is replaced by a file that it cannot be used with: one that is opened the other way round, so that reading and
/// writing fail as they would have.
void occupy_standard_files() {
  for (const int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(number, F_GETFD) >= 0 || errno != EBADF) continue;
    if (open("/dev/null", number == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0) open("/", O_PATH);
  }
}

/// By default each reserves as much as `ulimit -s` says, whether that is 16 KiB or 1 GiB.
void set_library_stacks() {
#if defined(__GLIBC__)
  pthread_attr_t attributes;
  if (pthread_getattr_default_np(&attributes) != 0) return;
  pthread_attr_setstacksize(&attributes, library_stack);
  pthread_setattr_default_np(&attributes);
  pthread_attr_destroy(&attributes);
#endif
}

/// Ends the process. Where memory ran out, without what libraries would do at its end: OpenImageIO's pool of threads
/// crashes if not all of them could be started.
[[noreturn]] void end_process(int code) {
  if (code != exit_code::out_of_memory) std::exit(code);
  std::fflush(nullptr);
  _exit(code);
}

/// The first thread's stack ends where `ulimit -s` says; that of another one can be larger.
void* run_to_the_end(void* program) { end_process((*static_cast<const std::function<int()>*>(program))()); }

/// Ends the process with the program's exit code; returns if there can be no such thread.
void run_on_another_stack(const std::function<int()>& program) {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, main_stack);
  pthread_t thread{};
  const int error =
      pthread_create(&thread, &attributes, run_to_the_end, const_cast<void*>(static_cast<const void*>(&program)));
  pthread_attr_destroy(&attributes);
  if (error != 0) return;
  sigset_t all;  // handlers want a stack, too
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, nullptr);
  pthread_join(thread, nullptr);
}

}  // namespace

int threads_with_room(int wanted) {
  if (wanted == 1) return 1;  // there already
  const std::size_t stack = worker_stack() + library_stacks;
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, stack);
  std::vector<pthread_t> threads;
  {
    std::mutex gate;
    std::unique_lock closed(gate);
    pthread_t thread{};
    while (static_cast<int>(threads.size()) < wanted && pthread_create(&thread, &attributes, wait_at, &gate) == 0)
      threads.push_back(thread);
    closed.unlock();
    for (const pthread_t started : threads) pthread_join(started, nullptr);
  }
  pthread_attr_destroy(&attributes);
  const int started = static_cast<int>(threads.size());
  constexpr std::uint64_t glibc_keeps = std::uint64_t{40} << 20U;  // glibc.pthread.stack_cache_size
  kept_stacks = std::min(static_cast<std::uint64_t>(started) * stack, glibc_keeps);
  return started == wanted ? wanted : std::max(1, started / 2);
}

void log_missing_threads(int wanted, int used) {
  if (used == wanted) return;
  log_warning("there is no room for " + std::to_string(wanted) +
              " threads: " + counted(static_cast<std::uint64_t>(used), "thread") + " used");
}

std::vector<std::string> memory_group_folders(const std::string& cgroups, const std::string& mountinfo) {
  const std::optional<GroupPath> group = group_path(cgroups);
  if (!group) return {};
  const std::optional<GroupMount> mount = group_mount(mountinfo, group->version_1);
  if (!mount) return {};
  // In a container the path may be one that only the machine around it sees: there what is mounted is the own group.
  std::filesystem::path inside = group->path;
  if (mount->root != "/") inside = inside.lexically_relative(mount->root);
  inside = inside.relative_path();
  if (inside.empty() || inside == "." || *inside.begin() == "..") inside.clear();
  std::vector<std::string> folders;
  for (; !inside.empty(); inside = inside.parent_path()) folders.push_back(mount->folder + "/" + inside.string());
  folders.push_back(mount->folder);
  return folders;
}

void obey_group_memory_limit(int threads, std::uint64_t untouched_to_come) {
  const std::optional<std::uint64_t> allowed = group_memory_limit();
  rlimit data{};
  if (!allowed || getrlimit(RLIMIT_DATA, &data) != 0) return;
  static const rlim_t asked = data.rlim_cur;  // by `ulimit -d`
  // What is not data: the kernel's tables, the group's other processes, files on their way to the disk.
  const std::uint64_t others = *allowed / 16;
  data.rlim_cur =
      std::min<rlim_t>(asked, *allowed - others + untouched_memory() + stacks_to_come(threads) + untouched_to_come);
  if (setrlimit(RLIMIT_DATA, &data) == 0) obeyed_limit = data.rlim_cur < asked ? *allowed : 0;
}

std::string memory_limit_text() {
  const auto allows = [](const char* what, std::uint64_t bytes) {
    return std::string(": the ") + what + " allows " + std::to_string(bytes >> 20U) + " MiB";
  };
  // What was wanted counts for both, so it was the one that has less left.
  const std::optional<MemoryLimit> space = address_space_limit(), data = data_limit();
  if (space && (!data || space->left < data->left))
    return allows("address-space limit of this process (ulimit -v)", space->bytes);
  if (data && obeyed_limit > 0) return allows("control group of this process", obeyed_limit);
  return data ? allows("data limit of this process (ulimit -d)", data->bytes) : "";
}

void run_in_prepared_process(const std::function<int()>& program) {
  occupy_standard_files();
  for (const int number : {SIGPIPE, SIGXFSZ, SIGUSR1}) std::signal(number, SIG_IGN);
  set_library_stacks();
  rlimit stack{};
  const bool is_small = getrlimit(RLIMIT_STACK, &stack) == 0 && stack.rlim_cur < main_stack;
  if (is_small) run_on_another_stack(program);  // does not return if it can
  end_process(program());
}

}  // namespace raytrace
