// The C library's files, closed at the end of their scope.
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

namespace raytrace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using FileHandle = std::unique_ptr<std::FILE, CloseFile>;

/// A file in memory. Throws std::bad_alloc.
FileHandle open_memory_file();

/// Opens a regular file to read it. Throws InputError, for pipes, sockets and devices at once: they might never answer.
FileHandle open_regular_file(const std::string& file);

std::uint64_t file_size(std::FILE* file);

}  // namespace raytrace
