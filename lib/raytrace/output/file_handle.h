// The C library's files, closed at the end of their scope.
#pragma once

#include <cstdio>
#include <memory>

namespace raytrace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using FileHandle = std::unique_ptr<std::FILE, CloseFile>;

/// A file in memory. Throws std::bad_alloc.
FileHandle open_memory_file();

}  // namespace raytrace
