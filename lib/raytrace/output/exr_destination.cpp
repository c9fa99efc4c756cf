#include "raytrace/output/exr_destination.h"

#include <cerrno>

#include "raytrace/output/output_error.h"

namespace raytrace {

void ExrDestination::write(const char data[], int size) {
  errno = 0;
  if (std::fwrite(data, 1, static_cast<std::size_t>(size), file_) != static_cast<std::size_t>(size)) fail();
  position_ += static_cast<std::uint64_t>(size);
}

void ExrDestination::seekp(std::uint64_t position) {
  errno = 0;
  if (fseeko(file_, static_cast<off_t>(position), SEEK_SET) != 0) fail();
  position_ = position;
}

void ExrDestination::finish() {
  errno = 0;
  if (error_ != 0 || std::fflush(file_) != 0) fail();
}

void ExrDestination::fail() {
  if (error_ == 0) error_ = errno != 0 ? errno : EIO;
  throw OutputError("the destination failed");
}

}  // namespace raytrace
