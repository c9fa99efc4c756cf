#include "raytrace/output/file_identity.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>

#include "raytrace/output/link_target.h"
#include "raytrace/output/output_error.h"

namespace raytrace {

namespace fs = std::filesystem;

std::optional<FileIdentity> file_identity(const std::string& file) {
  struct stat status{};
  if (file.empty()) return std::nullopt;
  if (stat(file.c_str(), &status) == 0) {
    if (!S_ISREG(status.st_mode)) return std::nullopt;
    return FileIdentity{status.st_dev, status.st_ino, {}};
  }
  std::error_code error;
  const fs::path target = last_link_target(file);
  if (stat(folder_of(target).c_str(), &status) == 0)
    return FileIdentity{status.st_dev, status.st_ino, target.filename().string()};
  const fs::path spelled_one_way = fs::weakly_canonical(target, error);
  return FileIdentity{0, 0, (error ? target : spelled_one_way).string()};
}

FileIdentity file_identity(int descriptor) {
  struct stat status{};
  fstat(descriptor, &status);
  return {status.st_dev, status.st_ino, {}};
}

bool remove_file(const std::string& file, const FileIdentity& identity) {
  try {
    const fs::path target = link_target(file);
    struct stat status{};
    if (lstat(target.c_str(), &status) != 0) return errno == ENOENT;
    return status.st_dev == identity.device && status.st_ino == identity.inode && unlink(target.c_str()) == 0;
  } catch (const OutputError&) {
    return false;
  }
}

}  // namespace raytrace
