#include "raytrace/memory/freed_memory.h"

#include <cstdlib>  // which says what C library it is
#include <limits>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace raytrace {

#if defined(__GLIBC__)

void keep_freed_memory() {
  mallopt(M_MMAP_MAX, 0);  // what has a mapping of its own goes with it
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
}

void give_back_freed_memory() { malloc_trim(0); }

#else

void keep_freed_memory() {}

void give_back_freed_memory() {}

#endif

}  // namespace raytrace
