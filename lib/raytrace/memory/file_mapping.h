// Bytes in a file without a name, which the system reads into memory where they are used, and may forget there again.
#pragma once

#include <cstddef>
#include <string>

namespace raytrace {

/// Owns the file, which is gone with it. Empty at first.
class FileMapping {
 public:
  FileMapping() = default;
  /// Of a copy of so many bytes, at least 1. Throws std::system_error, which says what is wrong with the folder.
  FileMapping(const void* bytes, std::size_t size, const std::string& folder);
  FileMapping(FileMapping&& other) noexcept;
  FileMapping& operator=(FileMapping&& other) noexcept;
  ~FileMapping();

  /// Null if it is empty.
  const std::byte* data() const { return data_; }

 private:
  const std::byte* data_ = nullptr;
  std::size_t size_ = 0;
};

/// Where such files belong: $TMPDIR, or else /var/tmp, which is on a disk where /tmp may be memory.
std::string folder_for_large_files();

}  // namespace raytrace
