#include "raytrace/film/zeroed_array.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <new>

namespace raytrace {

void* zeroed_memory(std::size_t bytes) {
  void* const memory = std::calloc(bytes, 1);
  if (memory == nullptr && bytes > 0) throw std::bad_alloc();
  constexpr std::size_t large = std::size_t{4} << 20U;
  if (bytes >= large) {
    const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
    const auto begin = reinterpret_cast<std::uintptr_t>(memory), end = begin + bytes;
    const std::uintptr_t first_page = (begin + page - 1) / page * page;
    madvise(reinterpret_cast<void*>(first_page), end - first_page, MADV_HUGEPAGE);
  }
  return memory;
}

}  // namespace raytrace
