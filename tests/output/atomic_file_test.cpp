#include "raytrace/output/atomic_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "pictures.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

namespace {

namespace fs = std::filesystem;

mode_t permissions_of(const std::string& file) {
  struct stat status{};
  REQUIRE(stat(file.c_str(), &status) == 0);
  return status.st_mode & 0777U;
}

template <class Action>
std::string message_of(const Action& action) {
  try {
    action();
  } catch (const OutputError& error) {
    return error.what();
  }
  return {};
}

std::string refusal(const std::string& file) {
  return message_of([&] { const AtomicFile atomic(file); });
}

}  // namespace

TEST_CASE("a file appears at its commit") {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.txt");
  {
    AtomicFile atomic(file);
    write_text(atomic.temporary_name(), "new");
    CHECK_FALSE(fs::exists(file));
    atomic.commit();
    CHECK(bytes_of(file) == "new");
  }
  CHECK(folder.names() == std::vector<std::string>{"a.txt"});
}

TEST_CASE("without a commit all is as it was") {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.txt");
  write_text(file, "old");
  {
    const AtomicFile atomic(file);
    write_text(atomic.temporary_name(), "new");
  }
  CHECK(bytes_of(file) == "old");
  CHECK(folder.names() == std::vector<std::string>{"a.txt"});
}

TEST_CASE("the temporary file is in the same folder, is hidden and has the same extension") {
  const TemporaryFolder folder;
  const AtomicFile atomic(folder.file("a.exr"));
  const fs::path temporary = atomic.temporary_name();
  CHECK(temporary.parent_path() == folder.path());
  CHECK(temporary.filename().string().front() == '.');
  CHECK(temporary.extension() == ".exr");
  CHECK(fs::exists(temporary));
}

TEST_CASE("several files may be under way for one name") {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.txt");
  AtomicFile first(file), second(file);
  REQUIRE(first.temporary_name() != second.temporary_name());
  write_text(first.temporary_name(), "first");
  write_text(second.temporary_name(), "second");
  second.commit();
  first.commit();
  CHECK(bytes_of(file) == "first");
}

TEST_CASE("a name as long as names can be is fine") {
  const TemporaryFolder folder;
  const std::string file = folder.file(std::string(251, 'n') + ".txt");
  AtomicFile atomic(file);
  write_text(atomic.temporary_name(), "long");
  atomic.commit();
  CHECK(bytes_of(file) == "long");
}

TEST_CASE("permissions are what the umask leaves") {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.exr");
  const mode_t before = umask(0027);
  write_image(file, distinct_film(4, 4), {}, {});
  umask(before);
  CHECK(permissions_of(file) == 0640);
}

TEST_CASE("a symbolic link stays, and what it points to is written") {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "elsewhere");
  const std::string link = folder.file("a.txt"), target = folder.file("elsewhere/target.txt");
  const bool exists_before = GENERATE(true, false);
  const bool chained = GENERATE(true, false);
  if (exists_before) write_text(target, "old");
  if (chained) {
    fs::create_symlink(folder.file("b.txt"), link);
    fs::create_symlink("elsewhere/target.txt", folder.file("b.txt"));
  } else {
    fs::create_symlink("elsewhere/target.txt", link);
  }

  AtomicFile atomic(link);
  CHECK(fs::path(atomic.temporary_name()).parent_path() == folder.path() / "elsewhere");
  write_text(atomic.temporary_name(), "new");
  atomic.commit();
  CHECK(fs::is_symlink(link));
  CHECK(bytes_of(target) == "new");
}

TEST_CASE("a folder that is gone at the commit is told") {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "removed");
  AtomicFile atomic(folder.file("removed/a.exr"));
  fs::remove_all(folder.path() / "removed");
  const std::string message = message_of([&] { atomic.commit(); });
  CHECK(contains(message, "there is no folder " + folder.file("removed")));
}

TEST_CASE("what cannot be written is refused at once, with the reason") {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.exr");

  SECTION("no folder") { CHECK(contains(refusal(folder.file("missing/a.exr")), "there is no folder")); }
  SECTION("a file instead of the folder") {
    write_text(folder.file("plain"), "");
    CHECK(contains(refusal(folder.file("plain/a.exr")), "is not a folder"));
  }
  SECTION("a folder instead of the file") {
    fs::create_directory(file);
    CHECK(contains(refusal(file), "it is a folder"));
  }
  SECTION("a read-only file, even for root") {
    write_text(file, "old");
    fs::permissions(file, fs::perms::owner_read);
    CHECK(contains(refusal(file), "read-only"));
    CHECK(bytes_of(file) == "old");
  }
  SECTION("a link to a read-only file") {
    write_text(folder.file("kept"), "old");
    fs::permissions(folder.file("kept"), fs::perms::owner_read);
    fs::create_symlink("kept", file);
    CHECK(contains(refusal(file), "read-only"));
  }
  SECTION("a read-only folder, even for root") {
    fs::create_directory(folder.path() / "kept");
    fs::permissions(folder.path() / "kept", fs::perms::owner_read | fs::perms::owner_exec);
    CHECK(contains(refusal(folder.file("kept/a.exr")), "read-only"));
  }
  SECTION("something that is no file") {
    REQUIRE(mkfifo(file.c_str(), 0600) == 0);
    CHECK(contains(refusal(file), "not a regular file"));
  }
  SECTION("links in a circle") {
    fs::create_symlink("a.exr", folder.file("b.exr"));
    fs::create_symlink("b.exr", file);
    CHECK(contains(refusal(file), "cannot write"));
  }
  SECTION("a name beyond what the system takes") {
    CHECK(contains(refusal(folder.file(std::string(300, 'n') + ".exr")), "cannot write"));
  }
}

TEST_CASE("whoever reads while pictures are written sees whole ones only") {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.exr");
  FloatPicture black(64, 64, {0, 0, 64, 64}), white(64, 64, {0, 0, 64, 64});
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) white.at(x, y) = {1, 1, 1, 1};
  }
  ImageFileSettings settings;
  settings.threads = 1;
  write_image(file, black, {}, settings);
  // The first time that OpenImageIO reads an EXR it resizes OpenEXR's pool of threads, which the writer below uses.
  CHECK(read_picture(file).values.front() == 0);

  std::atomic<bool> done = false;
  std::thread writer([&] {
    for (int i = 0; i < 40; ++i) write_image(file, i % 2 == 0 ? white : black, {}, settings);
    done = true;
  });
  int read = 0, torn = 0;
  do {
    try {
      const ReadPicture picture = read_picture(file);
      const float first = picture.values.front();
      for (const float value : picture.values) torn += value != first;
    } catch (const std::runtime_error&) {
      ++torn;
    }
    ++read;
  } while (!done);
  writer.join();
  CHECK(read > 0);
  CHECK(torn == 0);
  CHECK(folder.names() == std::vector<std::string>{"a.exr"});
}

}  // namespace raytrace::test
