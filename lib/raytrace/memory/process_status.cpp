#include "raytrace/memory/process_status.h"

#include <fstream>

namespace raytrace {

std::uint64_t process_status(const std::string& field) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    std::uint64_t number = 0;
    if (word == field + ":" && status >> number) return number;
  }
  return 0;
}

}  // namespace raytrace
