// Parts of a file, which several threads may read at once.
#pragma once

#include <unistd.h>

#include <cerrno>
#include <cstddef>

namespace raytrace {

/// The bytes of an open file from an offset on, as many as there are up to `count`; fewer where it cannot be read.
inline std::size_t read_file_at(int file, char* bytes, std::size_t count, std::size_t offset) {
  std::size_t done = 0;
  while (done < count) {
    const ssize_t more = pread(file, bytes + done, count - done, static_cast<off_t>(offset + done));
    if (more < 0 && errno == EINTR) continue;
    if (more <= 0) break;
    done += static_cast<std::size_t>(more);
  }
  return done;
}

}  // namespace raytrace
