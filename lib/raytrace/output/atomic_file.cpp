#include "raytrace/output/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <new>
#include <optional>
#include <system_error>

namespace raytrace {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const std::string& file, const std::string& reason) {
  throw OutputError("cannot write " + file + ": " + reason);
}

[[noreturn]] void fail(const std::string& file, int error_number) {
  fail(file, std::generic_category().message(error_number));
}

/// Of a call that failed about what is in the target's folder: that the folder is gone says more than the call does.
[[noreturn]] void fail(const std::string& file, const fs::path& target, int error_number) {
  const fs::path folder = folder_of(target);
  std::error_code error;
  if (error_number == ENOENT && !fs::exists(folder, error)) fail(file, "there is no folder " + folder.string());
  fail(file, error_number);
}

/// Why no process, or not this one, may rename another file to the target; empty if it may.
std::string protection(const fs::path& target, const struct stat& its, const struct stat& folder) {
  const uid_t me = geteuid();
  if ((folder.st_mode & S_ISVTX) != 0 && me != 0 && me != its.st_uid && me != folder.st_uid)
    return "it belongs to another user, who alone may replace it in a folder such as this (sticky)";
  struct statx extended{};
  if (statx(AT_FDCWD, target.c_str(), 0, STATX_BASIC_STATS, &extended) != 0) return {};
  if ((extended.stx_attributes & (STATX_ATTR_IMMUTABLE | STATX_ATTR_APPEND)) != 0)
    return "it has an attribute against changes (chattr)";
  if ((extended.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0)
    return "it is mounted by itself, so that no other file can replace it; mount its folder";
  return {};
}

/// The status of the file that is to be replaced, if there is one.
std::optional<struct stat> refuse_unwritable(const std::string& file, const fs::path& target) {
  constexpr mode_t any_write = S_IWUSR | S_IWGRP | S_IWOTH;
  const fs::path folder = folder_of(target);
  struct stat status{};
  // First, for the link of a pipe (/dev/stdout) leads to no path.
  if (stat(file.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode)) {
    fail(file, "it is not a regular file, which alone appears whole or not at all; write to one, and copy it");
  }
  if (stat(folder.c_str(), &status) != 0) fail(file, target, errno);
  if (!S_ISDIR(status.st_mode)) fail(file, folder.string() + " is not a folder");
  if ((status.st_mode & any_write) == 0) fail(file, "the folder " + folder.string() + " is read-only");

  const struct stat its_folder = status;
  if (stat(target.c_str(), &status) != 0) {
    if (errno == ENOENT) return std::nullopt;  // a new file
    fail(file, errno);
  }
  if (S_ISDIR(status.st_mode)) fail(file, "it is a folder");
  if (const std::string reason = protection(target, status, its_folder); !reason.empty()) fail(file, reason);
  if ((status.st_mode & any_write) == 0 || (access(target.c_str(), W_OK) != 0 && errno == EACCES)) {
    fail(file, "the file is read-only");
  }
  return status;
}

/// Makes a new file like the one that it replaces, as far as this process may.
void keep_owner_and_mode(int descriptor, const struct stat& replaced) {
  constexpr mode_t permissions = 0777, groups = 0070;
  mode_t mode = replaced.st_mode & permissions;
  static_cast<void>(!fchown(descriptor, replaced.st_uid, static_cast<gid_t>(-1)));  // root alone gives files away
  // What was allowed to one group must not be to another.
  if (fchown(descriptor, static_cast<uid_t>(-1), replaced.st_gid) != 0)
    mode = (mode & ~groups) | (mode & (mode << 3U) & groups);
  fchmod(descriptor, mode);
}

}  // namespace

AtomicFile::AtomicFile(const std::string& file) : file_(file), target_(link_target(file)) {
  const std::optional<struct stat> replaced = refuse_unwritable(file_, target_);
  // Of a new file, the umask decides. Nobody may read before the time what few were allowed to.
  const mode_t mode = replaced ? 0600 : 0666;
  // Short, so that it fits wherever the name itself does; hidden, so that no "*.exr" finds it.
  static std::atomic<unsigned> counter = 0;
  int created = -1;
  while (created < 0) {
    const std::string name = ".raytrace-" + std::to_string(getpid()) + "-" + std::to_string(counter++);
    temporary_ = (folder_of(target_) / (name + target_.extension().string())).string();
    created = open(temporary_.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, mode);
    if (created < 0 && errno != EEXIST) fail(errno);  // EEXIST: another machine's process on a shared disk
  }
  stream_.reset(fdopen(created, "wb"));
  if (!stream_) {
    close(created);
    unlink(temporary_.c_str());
    throw std::bad_alloc();
  }
  if (replaced) keep_owner_and_mode(created, *replaced);
}

AtomicFile::~AtomicFile() {
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

void AtomicFile::fail(int error_number) const { raytrace::fail(file_, target_, error_number); }

void AtomicFile::commit() {
  if (std::fflush(stream_.get()) != 0 || fsync(fileno(stream_.get())) != 0) fail(errno);
  if (rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
  // So that the new name survives a power cut as well. Not every file system can; the picture is there either way.
  const int folder = open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (folder < 0) return;
  fsync(folder);
  close(folder);
}

}  // namespace raytrace
