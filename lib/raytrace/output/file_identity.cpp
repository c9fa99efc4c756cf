#include "raytrace/output/file_identity.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <iterator>
#include <system_error>
#include <vector>

#include "raytrace/output/file_handle.h"

namespace raytrace {

namespace fs = std::filesystem;

namespace {

constexpr int most_links = 40;  // as the kernel's own limit

[[noreturn]] void refuse_link(const std::string& file, const std::string& reason) {
  throw OutputError("cannot write " + file + ": " + reason);
}

void refuse_trap(const std::string& file, const fs::path& link, const struct stat& its) {
  struct stat folder{};
  const bool anyone_writes =
      stat(folder_of(link).c_str(), &folder) == 0 && (folder.st_mode & S_ISVTX) != 0 && (folder.st_mode & S_IWOTH) != 0;
  if (anyone_writes && its.st_uid != geteuid() && its.st_uid != folder.st_uid)
    refuse_link(file, link.string() + " is another user's symbolic link in a folder that everyone can write to");
}

/// The parts of a path, the last one first.
std::vector<fs::path> reversed(const fs::path& path) {
  std::vector<fs::path> parts(path.begin(), path.end());
  return {std::make_move_iterator(parts.rbegin()), std::make_move_iterator(parts.rend())};
}

}  // namespace

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

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

fs::path link_target(const std::string& file) {
  fs::path reached;  // without a link
  std::vector<fs::path> ahead = reversed(file);
  int links = 0;
  while (!ahead.empty()) {
    const fs::path next = reached / ahead.back();
    ahead.pop_back();
    struct stat status{};
    if (lstat(next.c_str(), &status) != 0 || !S_ISLNK(status.st_mode)) {
      reached = next;
      continue;
    }
    if (++links > most_links) refuse_link(file, std::generic_category().message(ELOOP));
    refuse_trap(file, next, status);
    std::error_code error;
    const fs::path target = fs::read_symlink(next, error);
    if (error) refuse_link(file, error.message());
    for (fs::path& part : reversed(target)) ahead.push_back(std::move(part));  // an absolute one begins anew, at "/"
  }
  return reached;
}

fs::path last_link_target(const std::string& file) {
  fs::path path = file;
  std::error_code error;
  for (int links = 0; links < most_links && fs::is_symlink(path, error); ++links) {
    const fs::path target = fs::read_symlink(path, error);
    if (error) break;
    path = path.parent_path() / target;
  }
  return path;
}

}  // namespace raytrace
