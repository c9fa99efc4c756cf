#include "raytrace/film/film.h"

#include <sys/mman.h>

#include <new>
#include <type_traits>

namespace raytrace {

void Film::Unmap::operator()(Pixel* pixels) const { munmap(pixels, bytes); }

Film::Film(int full_width, int full_height, Region region)
    : full_width_(full_width), full_height_(full_height), region_(region) {
  static_assert(std::is_trivially_copyable_v<Pixel>);
  const std::size_t bytes = count() * sizeof(Pixel);
  if (bytes == 0) return;
  void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  pixels_ = {static_cast<Pixel*>(memory), Unmap{bytes}};
  madvise(memory, bytes, MADV_HUGEPAGE);  // where the system has larger pages: fewer to be asked for
}

}  // namespace raytrace
