// What the program wants of its process before it does anything else, and what the machine leaves it of threads and
// memory.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace raytrace {

/// What the program's exit code says. (docs/command-line.md)
namespace exit_code {
inline constexpr int done = 0;
inline constexpr int failed = 1;          ///< the scene, the render, or a file
inline constexpr int usage = 2;           ///< the command line
inline constexpr int out_of_memory = 33;  ///< render farms give a job more memory on it
inline constexpr int resumable = 75;      ///< stopped by a signal, with a checkpoint to go on from
inline constexpr int stopped = 128;       ///< plus the signal's number
}  // namespace exit_code

/// Ends the process with the exit code of `program`, which runs in a process where
/// - files 0 to 2 are open: if one was closed, the next file that is opened, a picture perhaps, would get its number
///   and whatever is printed;
/// - writing to a pipe that nobody reads, or beyond the limit on a file's size, is an error and no signal
///   (SIGPIPE, SIGXFSZ), and SIGUSR1, which asks a render for its picture, ends nothing that is no render;
/// - every stack is large enough, whatever `ulimit -s` says: the program's own and those of threads that libraries
///   start.
[[noreturn]] void run_in_prepared_process(const std::function<int()>& program);

/// As many of the wanted threads as a render should use: all, if they can be started;
/// where a limit on memory (`ulimit -v`) or on threads does not allow that, half of those that can, so that something
/// is left for the scene. Starts them for a moment, since nothing else says how many there can be.
int threads_with_room(int wanted);

/// Warns if fewer threads are used than are wanted.
void log_missing_threads(int wanted, int used);

/// The kernel kills what grows beyond the memory limit of its control group (cgroup), without a word. So that the
/// program can report it instead, and end as it does where the machine itself has no more, it may from now on take no
/// more data (RLIMIT_DATA) than the group allows. What is reserved and never touched does not count: what there is of
/// it now, the stacks that are still to come where so many threads work, and untouched_to_come, in bytes. So it is
/// called again when that has changed. Does nothing without a limit.
void obey_group_memory_limit(int threads, std::uint64_t untouched_to_come = 0);

/// ": the control group of this process allows 200 MiB", or the same of its address space or its data: of the limit
/// that leaves the least. Nothing if there is none.
std::string memory_limit_text();

/// A group's own folder, and those of the groups that it is part of up to the root; no folder if memory is not
/// controlled. cgroups, mountinfo: what the files of these names in /proc/self hold.
/// https://docs.kernel.org/admin-guide/cgroup-v2.html, and man 7 cgroups
std::vector<std::string> memory_group_folders(const std::string& cgroups, const std::string& mountinfo);

}  // namespace raytrace
