// Disks that take no more: the error is reported, and an earlier picture stays.
#include <sys/mount.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>

#include "pictures.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

namespace {

/// No file of this process may grow beyond `bytes`: a full disk that needs no special rights.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

/// A file system of 128 KiB, where this process may mount one.
class TinyDisk {
 public:
  TinyDisk() : mounted_(mount("tmpfs", folder_.path().c_str(), "tmpfs", 0, "size=128k") == 0) {}
  ~TinyDisk() {
    if (mounted_) umount(folder_.path().c_str());
  }
  TinyDisk(const TinyDisk&) = delete;
  TinyDisk& operator=(const TinyDisk&) = delete;

  bool mounted() const { return mounted_; }
  const TemporaryFolder& folder() const { return folder_; }

 private:
  TemporaryFolder folder_;
  bool mounted_;
};

std::string failure(const std::string& file, const FloatPicture& film) {
  try {
    write_image(file, film, some_metadata(), {});
  } catch (const OutputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

TEST_CASE("a write that fails in the middle leaves the earlier picture and nothing else") {
  const TemporaryFolder folder;
  const std::string name = GENERATE("a.exr", "a.png", "a.hdr", "a.bmp", "a.ppm", "a.tga", "a.jpg");
  const std::string file = folder.file(name);
  write_image(file, distinct_film(16, 16), {}, {});
  const std::string before = bytes_of(file);
  const FloatPicture film = noise_film(400, 400);
  {
    const FileSizeLimit limit(40000);
    CHECK(contains(failure(file, film), "File too large"));
  }
  CHECK(bytes_of(file) == before);
  CHECK(folder.names() == std::vector<std::string>{name});
  write_image(file, film, {}, {});
  CHECK(bytes_of(file).size() > 40000);
}

TEST_CASE("a full disk is reported as such, in every format") {
  const TinyDisk disk;
  if (!disk.mounted()) {
    WARN("not run: this process may not mount a file system");
    return;
  }
  const std::string name = GENERATE("a.exr", "a.png", "a.hdr", "a.bmp", "a.ppm", "a.tga", "a.tif", "a.sgi", "a.rla");
  const std::string file = disk.folder().file(name);
  check_format(file, {});
  write_image(file, distinct_film(16, 16), {}, {});
  const std::string before = bytes_of(file);

  CHECK(contains(failure(file, noise_film(400, 400)), "No space left on device"));
  CHECK(bytes_of(file) == before);
  CHECK(disk.folder().names() == std::vector<std::string>{name});
}

TEST_CASE("a disk without a free byte is reported as such, too") {
  const TinyDisk disk;
  if (!disk.mounted()) {
    WARN("not run: this process may not mount a file system");
    return;
  }
  write_text(disk.folder().file("filler"), std::string(256 * 1024, 'x'));
  CHECK(contains(failure(disk.folder().file("a.exr"), distinct_film(16, 16)), "No space left on device"));
  CHECK(disk.folder().names() == std::vector<std::string>{"filler"});
}

}  // namespace raytrace::test
