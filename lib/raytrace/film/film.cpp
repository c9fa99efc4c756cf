#include "raytrace/film/film.h"

#include <sys/mman.h>

#include <cstdint>
#include <new>

namespace raytrace {

Film::Film(int full_width, int full_height, Region region)
    : full_width_(full_width), full_height_(full_height), region_(region) {
  static_assert(std::is_trivially_copyable_v<Pixel>);
  if (count() == 0) return;
  pixels_.reset(static_cast<Pixel*>(std::calloc(count(), sizeof(Pixel))));
  if (!pixels_) throw std::bad_alloc();

  // Pages of 2 MiB where the system has them: 500 times fewer to be asked for. Only those that lie wholly inside.
  constexpr std::uintptr_t page = 2U << 20U;
  const auto begin = (reinterpret_cast<std::uintptr_t>(pixels_.get()) + page - 1) / page * page;
  const auto end = reinterpret_cast<std::uintptr_t>(pixels_.get() + count()) / page * page;
  if (begin < end) madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

}  // namespace raytrace
