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

std::optional<MemoryLimit> limit_on(int resource, const char* used_field) {
  rlimit limit{};
  if (getrlimit(static_cast<decltype(RLIMIT_AS)>(resource), &limit) != 0 || limit.rlim_cur == RLIM_INFINITY)
    return std::nullopt;
  const std::uint64_t used = process_status_bytes(used_field);
  return MemoryLimit{limit.rlim_cur, limit.rlim_cur > used ? limit.rlim_cur - used : 0};
}

}  // namespace

std::uint64_t process_status(const std::string& field) { return number_in_file("/proc/self/status", field); }

std::optional<MemoryLimit> address_space_limit() { return limit_on(RLIMIT_AS, "VmSize"); }
std::optional<MemoryLimit> data_limit() { return limit_on(RLIMIT_DATA, "VmData"); }

std::size_t available_memory() {
  std::uint64_t available = number_in_file("/proc/meminfo", "MemAvailable") << 10U;
  if (available == 0) available = std::numeric_limits<std::size_t>::max();  // no such system
  if (const auto limit = data_limit()) available = std::min(available, limit->left);
  return available;
}

}  // namespace raytrace
