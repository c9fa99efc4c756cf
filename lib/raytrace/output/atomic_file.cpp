#include "raytrace/output/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
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

/// Where writing to `file` ends up: links followed, the last one's target need not exist.
fs::path follow_links(const std::string& file) {
  constexpr int most_links = 40;  // as the kernel's own limit
  fs::path path = file;
  std::error_code error;
  for (int links = 0; fs::is_symlink(path, error); ++links) {
    if (links == most_links) fail(file, ELOOP);
    const fs::path target = fs::read_symlink(path, error);
    if (error) fail(file, error.message());
    path = path.parent_path() / target;  // an absolute target replaces the whole
  }
  return path;
}

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

/// Of a call that failed about what is in the target's folder: that the folder is gone says more than the call does.
[[noreturn]] void fail(const std::string& file, const fs::path& target, int error_number) {
  const fs::path folder = folder_of(target);
  std::error_code error;
  if (error_number == ENOENT && !fs::exists(folder, error)) fail(file, "there is no folder " + folder.string());
  fail(file, error_number);
}

void refuse_unwritable(const std::string& file, const fs::path& target) {
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

  if (stat(target.c_str(), &status) != 0) {
    if (errno == ENOENT) return;  // a new file
    fail(file, errno);
  }
  if (S_ISDIR(status.st_mode)) fail(file, "it is a folder");
  if ((status.st_mode & any_write) == 0 || (access(target.c_str(), W_OK) != 0 && errno == EACCES)) {
    fail(file, "the file is read-only");
  }
}

/// Closes a descriptor at the end of the scope.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

}  // namespace

AtomicFile::AtomicFile(const std::string& file) : file_(file), target_(follow_links(file)) {
  refuse_unwritable(file_, target_);
  // Short, so that it fits wherever the name itself does; hidden, so that no "*.exr" finds it.
  static std::atomic<unsigned> counter = 0;
  for (;;) {
    const std::string name = ".raytrace-" + std::to_string(getpid()) + "-" + std::to_string(counter++);
    const std::string candidate = (folder_of(target_) / (name + target_.extension().string())).string();
    // 0666 and no more: the umask decides, as for any new file.
    const Descriptor created(open(candidate.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666));
    if (created.number() >= 0) {
      temporary_ = candidate;
      return;
    }
    if (errno != EEXIST) fail(errno);  // EEXIST: another machine's process on a shared disk
  }
}

AtomicFile::~AtomicFile() {
  if (!temporary_.empty()) unlink(temporary_.c_str());
}

void AtomicFile::fail(int error_number) const { raytrace::fail(file_, target_, error_number); }

void AtomicFile::commit() {
  {
    const Descriptor written(open(temporary_.c_str(), O_RDONLY | O_CLOEXEC));
    if (written.number() < 0 || fsync(written.number()) != 0) fail(errno);
  }
  if (rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
  // So that the new name survives a power cut as well. Not every file system can; the picture is there either way.
  const Descriptor folder(open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.number() >= 0) fsync(folder.number());
}

}  // namespace raytrace
