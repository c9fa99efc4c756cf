#include "raytrace/output/link_target.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <iterator>
#include <system_error>
#include <vector>

#include "raytrace/output/output_error.h"

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
