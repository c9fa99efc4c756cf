#include "raytrace/memory/out_of_memory.h"

#include <algorithm>
#include <array>
#include <new>

namespace raytrace {

bool says_out_of_memory(std::string_view message) {
  constexpr std::array<std::string_view, 9> phrases = {
      "bad_alloc",
      "out of memory",
      "Out of memory",
      "Cannot allocate memory",  // the C library's text of ENOMEM
      "unable to allocate",
      "Unable to allocate",              // OpenEXR 3.3
      "Data compression (zlib) failed",  // OpenEXR 3.1, which gives zlib all the room that it may want but memory
      "File output failed",  // OpenEXR's of its streams in memory; a disk's failures have another text (ExrDestination)
      "pthread_create has failed"};  // oneTBB
  return std::any_of(phrases.begin(), phrases.end(),
                     [&](std::string_view phrase) { return message.find(phrase) != std::string_view::npos; });
}

void rethrow_out_of_memory(const std::exception& exception) {
  if (dynamic_cast<const std::bad_alloc*>(&exception) != nullptr || says_out_of_memory(exception.what()))
    throw std::bad_alloc();
}

}  // namespace raytrace
