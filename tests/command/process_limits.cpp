// Where the limits of a process' control groups stand.
#include "process.h"
#include "support/catch.h"

namespace raytrace::test {

using Folders = std::vector<std::string>;

TEST_CASE("the groups of a process in version 2 are found up to the root") {
  const std::string mounts =
      "24 30 0:22 / /proc rw,nosuid shared:13 - proc proc rw\n"
      "35 24 0:30 / /sys/fs/cgroup rw,nosuid shared:9 - cgroup2 cgroup2 rw,nsdelegate\n";
  CHECK(memory_group_folders("0::/system.slice/job_7/step_0\n", mounts) ==
        Folders{"/sys/fs/cgroup/system.slice/job_7/step_0", "/sys/fs/cgroup/system.slice/job_7",
                "/sys/fs/cgroup/system.slice", "/sys/fs/cgroup"});
  CHECK(memory_group_folders("0::/\n", mounts) == Folders{"/sys/fs/cgroup"});
}

TEST_CASE("where version 1 controls memory, its groups count") {
  const std::string mounts =
      "32 31 0:29 / /sys/fs/cgroup/cpu rw - cgroup cgroup rw,cpu,cpuacct\n"
      "35 31 0:32 / /sys/fs/cgroup/memory rw - cgroup cgroup rw,memory\n"
      "41 31 0:38 / /sys/fs/cgroup/unified rw - cgroup2 cgroup2 rw\n";
  CHECK(memory_group_folders("5:cpu,cpuacct:/a\n4:memory:/slurm/job_7\n1:name=systemd:/b\n0::/c\n", mounts) ==
        Folders{"/sys/fs/cgroup/memory/slurm/job_7", "/sys/fs/cgroup/memory/slurm", "/sys/fs/cgroup/memory"});
}

TEST_CASE("in a container the group that is mounted is the own one or above it") {
  const std::string mounts = "35 24 0:30 /docker/12ab /sys/fs/cgroup ro - cgroup2 cgroup rw\n";
  CHECK(memory_group_folders("0::/docker/12ab\n", mounts) == Folders{"/sys/fs/cgroup"});
  CHECK(memory_group_folders("0::/docker/12ab/job\n", mounts) == Folders{"/sys/fs/cgroup/job", "/sys/fs/cgroup"});
  CHECK(memory_group_folders("0::/\n", mounts) == Folders{"/sys/fs/cgroup"});
}

TEST_CASE("without control groups there is no folder to look into") {
  CHECK(memory_group_folders("", "").empty());
  CHECK(memory_group_folders("0::/a\n", "24 30 0:22 / /proc rw - proc proc rw\n").empty());
  CHECK(memory_group_folders("4:cpu:/a\n", "35 24 0:30 / /sys/fs/cgroup rw - cgroup2 cgroup2 rw\n").empty());
  CHECK(memory_group_folders("no colon\n::\n", "no separator\n - \n").empty());
}

}  // namespace raytrace::test
