// Makes what a control group (cgroup) of Linux allows a limit that the program sees.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace raytrace {

/// A group's own folder, and those of the groups that it is part of up to the root; no folder if memory is not
/// controlled. cgroups, mountinfo: what the files of these names in /proc/self hold.
/// https://docs.kernel.org/admin-guide/cgroup-v2.html, and man 7 cgroups
std::vector<std::string> memory_group_folders(const std::string& cgroups, const std::string& mountinfo);

/// The kernel kills what grows beyond its group's memory limit, without a word. So that the program can tell it
/// instead, and end as it does where the machine itself has no more, it may from now on take no more data (RLIMIT_DATA)
/// than the group allows. What is reserved and never touched does not count: what there is of it now, the stacks that
/// are still to come where so many threads work, and untouched_to_come, in bytes. Does nothing without a limit.
void obey_group_memory_limit(int threads, std::uint64_t untouched_to_come = 0);

/// ": the control group of this process allows 200 MiB" if that is what is obeyed, else nothing.
std::string memory_limit_text();

}  // namespace raytrace
