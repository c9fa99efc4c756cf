// What libpng reports through callbacks while it reads or writes a file.
#pragma once

#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <cstdlib>

namespace raytrace {

/// To be passed to libpng as both its error and its memory pointer.
struct PngErrors {
  bool out_of_memory = false;
  char message[128] = {};  ///< libpng's

  static void note_error(png_structp png, const char* message) {
    auto* const errors = static_cast<PngErrors*>(png_get_error_ptr(png));
    std::snprintf(errors->message, sizeof errors->message, "%s", message);
    png_longjmp(png, 1);
  }
  static void ignore_warning(png_structp, const char*) {}

  static void* allocate(png_structp png, png_alloc_size_t size) {
    void* const memory = std::malloc(size);
    if (memory == nullptr) static_cast<PngErrors*>(png_get_mem_ptr(png))->out_of_memory = true;
    return memory;
  }
  static void release(png_structp, void* memory) { std::free(memory); }
};

/// Runs calls of libpng, whose errors are jumps: `calls` must make no object that has a destructor. False if one
/// failed.
template <class Calls>
bool run_png_calls(png_structp png, const Calls& calls) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  calls();
  return true;
}

}  // namespace raytrace
