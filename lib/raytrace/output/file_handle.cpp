#include "raytrace/output/file_handle.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <new>
#include <system_error>

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

FileHandle open_regular_file(const std::string& name) {
  const auto refuse = [&](const std::string& reason) { throw InputError("cannot read " + name + ": " + reason); };
  struct stat status{};
  // Before it is opened, since a device may do something then; and without waiting, should it change meanwhile.
  if (stat(name.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
    refuse(S_ISDIR(status.st_mode) ? "it is a folder" : "it is not a regular file");
  const int number = open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  FileHandle file(number < 0 ? nullptr : fdopen(number, "rb"));
  if (!file) {
    const int error = errno;
    if (number >= 0) close(number);
    refuse(std::generic_category().message(error));
  }
  if (fstat(number, &status) != 0 || !S_ISREG(status.st_mode)) refuse("it is not a regular file");
  return file;
}

std::uint64_t file_size(std::FILE* file) {
  struct stat status{};
  return fstat(fileno(file), &status) == 0 ? static_cast<std::uint64_t>(status.st_size) : 0;
}

bool CheckedFile::write(const void* data, std::size_t size) {
  errno = 0;
  if (error_ == 0 && std::fwrite(data, 1, size, file_) != size) error_ = errno != 0 ? errno : EIO;
  return error_ == 0;
}

bool CheckedFile::seek(std::uint64_t position) {
  if (error_ == 0 && fseeko(file_, static_cast<off_t>(position), SEEK_SET) != 0) error_ = errno;
  return error_ == 0;
}

bool CheckedFile::flush() {
  errno = 0;
  if (error_ == 0 && (std::fflush(file_) != 0 || std::ferror(file_) != 0)) error_ = errno != 0 ? errno : EIO;
  return error_ == 0;
}

}  // namespace raytrace
