#include "raytrace/memory/large_array.h"

#include <sys/mman.h>
#include <unistd.h>

#include <new>

namespace raytrace {

namespace {

void* in_large_pages(void* memory, std::size_t bytes) {
  if (memory == nullptr && bytes > 0) throw std::bad_alloc();
  prefer_large_pages(memory, bytes);
  return memory;
}

}  // namespace

void* zeroed_memory(std::size_t bytes) { return in_large_pages(std::calloc(bytes, 1), bytes); }

void* unset_memory(std::size_t bytes) { return in_large_pages(std::malloc(bytes), bytes); }

void prefer_large_pages(void* memory, std::size_t bytes) {
  constexpr std::size_t large = std::size_t{4} << 20U;
  if (bytes < large || std::align(static_cast<std::size_t>(sysconf(_SC_PAGESIZE)), 1, memory, bytes) == nullptr) return;
  madvise(memory, bytes, MADV_HUGEPAGE);
}

}  // namespace raytrace
