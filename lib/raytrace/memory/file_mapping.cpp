#include "raytrace/memory/file_mapping.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>

namespace raytrace {
namespace {

[[noreturn]] void give_up(const std::string& folder, int error = errno) {
  throw std::system_error(error, std::generic_category(), folder);
}

/// A file that no other process can open.
class NamelessFile {
 public:
  explicit NamelessFile(const std::string& folder) {
    descriptor_ = open(folder.c_str(), O_TMPFILE | O_EXCL | O_RDWR | O_CLOEXEC, S_IRUSR | S_IWUSR);
    if (descriptor_ >= 0) return;
    // Some file systems have no such files.
    if (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL) give_up(folder);
    std::string name = folder + "/raytrace-XXXXXX";
    descriptor_ = mkostemp(name.data(), O_CLOEXEC);
    if (descriptor_ < 0) give_up(folder);
    unlink(name.c_str());
  }
  NamelessFile(const NamelessFile&) = delete;
  NamelessFile& operator=(const NamelessFile&) = delete;
  ~NamelessFile() { close(descriptor_); }

  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace

FileMapping::FileMapping(const void* bytes, std::size_t size, const std::string& folder) {
  const NamelessFile file(folder);
  const auto* from = static_cast<const std::byte*>(bytes);
  constexpr std::size_t most_at_once = std::size_t{1} << 28U;
  // Written, not set through the mapping, so that a full disk is an error and not a signal.
  for (std::size_t left = size; left > 0;) {
    const ssize_t written = write(file.descriptor(), from, std::min(left, most_at_once));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) give_up(folder, written < 0 ? errno : ENOSPC);
    from += written;
    left -= static_cast<std::size_t>(written);
  }
  void* const mapped = mmap(nullptr, size, PROT_READ, MAP_SHARED, file.descriptor(), 0);
  if (mapped == MAP_FAILED) give_up(folder);
  data_ = static_cast<const std::byte*>(mapped);
  size_ = size;
}

FileMapping::FileMapping(FileMapping&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}

FileMapping& FileMapping::operator=(FileMapping&& other) noexcept {
  std::swap(data_, other.data_);
  std::swap(size_, other.size_);
  return *this;
}

FileMapping::~FileMapping() {
  if (data_ != nullptr) munmap(const_cast<std::byte*>(data_), size_);
}

std::string folder_for_large_files() {
  const char* const folder = std::getenv("TMPDIR");
  return folder != nullptr && *folder != '\0' ? folder : "/var/tmp";
}

}  // namespace raytrace
