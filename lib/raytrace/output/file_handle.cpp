#include "raytrace/output/file_handle.h"

#include <sys/mman.h>
#include <unistd.h>

#include <new>

namespace raytrace {

FileHandle open_memory_file() {
  const int number = memfd_create("picture", MFD_CLOEXEC);
  FileHandle file(number < 0 ? nullptr : fdopen(number, "w+b"));
  if (!file) {
    if (number >= 0) close(number);
    throw std::bad_alloc();
  }
  return file;
}

}  // namespace raytrace
