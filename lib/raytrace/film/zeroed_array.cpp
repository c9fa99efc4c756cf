#include "raytrace/film/zeroed_array.h"

#include <sys/mman.h>
#include <unistd.h>

#include <new>

namespace raytrace {

void* zeroed_memory(std::size_t bytes) {
  void* const memory = std::calloc(bytes, 1);
  if (memory == nullptr && bytes > 0) throw std::bad_alloc();
  constexpr std::size_t large = std::size_t{4} << 20U;
  if (bytes >= large) {
    void* first_page = memory;
    std::size_t rest = bytes;
    if (std::align(static_cast<std::size_t>(sysconf(_SC_PAGESIZE)), 1, first_page, rest) != nullptr) {
      madvise(first_page, rest, MADV_HUGEPAGE);
    }
  }
  return memory;
}

}  // namespace raytrace
