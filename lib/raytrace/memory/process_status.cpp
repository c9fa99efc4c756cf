#include "raytrace/memory/process_status.h"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>

namespace raytrace {
namespace {

std::uint64_t number_in_file(const char* file, const std::string& field) {
  std::ifstream lines(file);
  for (std::string word; lines >> word;) {
    std::uint64_t number = 0;
    if (word == field + ":" && lines >> number) return number;
  }
  return 0;
}

}  // namespace

std::uint64_t process_status(const std::string& field) { return number_in_file("/proc/self/status", field); }

std::size_t available_memory() {
  std::uint64_t available = number_in_file("/proc/meminfo", "MemAvailable") << 10U;
  if (available == 0) available = std::numeric_limits<std::size_t>::max();  // no such system
  rlimit data{};
  if (getrlimit(RLIMIT_DATA, &data) == 0 && data.rlim_cur != RLIM_INFINITY) {
    const std::uint64_t used = process_status_bytes("VmData");
    available = std::min<std::uint64_t>(available, data.rlim_cur > used ? data.rlim_cur - used : 0);
  }
  return available;
}

}  // namespace raytrace
