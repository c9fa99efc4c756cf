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

void fill(const AtomicFile& atomic, const char* text) { std::fputs(text, atomic.stream()); }

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
    fill(atomic, "new");
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
    fill(atomic, "new");
  }
  CHECK(bytes_of(file) == "old");
  CHECK(folder.names() == std::vector<std::string>{"a.txt"});
}

TEST_CASE("the temporary file is in the same folder, is hidden and has the same extension") {
  const TemporaryFolder folder;
  const AtomicFile atomic(folder.file("a.exr"));
  REQUIRE(folder.names().size() == 1);
  const fs::path temporary = folder.names().front();
  CHECK(temporary.string().front() == '.');
  CHECK(temporary.extension() == ".exr");
}

TEST_CASE("several files may be under way for one name") {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.txt");
  AtomicFile first(file), second(file);
  REQUIRE(folder.names().size() == 2);
  fill(first, "first");
  fill(second, "second");
  second.commit();
  first.commit();
  CHECK(bytes_of(file) == "first");
}

TEST_CASE("a name as long as names can be is fine") {
  const TemporaryFolder folder;
  const std::string file = folder.file(std::string(251, 'n') + ".txt");
  AtomicFile atomic(file);
  fill(atomic, "long");
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

TEST_CASE("a file that is replaced keeps its permissions") {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.txt");
  write_text(file, "old");
  for (const mode_t mode : {0600U, 0664U, 0666U, 0755U}) {
    REQUIRE(chmod(file.c_str(), mode) == 0);
    AtomicFile atomic(file);
    fill(atomic, "new");
    atomic.commit();
    CHECK(permissions_of(file) == mode);
  }
}

TEST_CASE("a file that root replaces stays its owner's") {
  if (geteuid() != 0) return;
  const TemporaryFolder folder;
  const std::string file = folder.file("a.txt");
  write_text(file, "old");
  REQUIRE(chown(file.c_str(), 1234, 4321) == 0);
  AtomicFile atomic(file);
  atomic.commit();
  struct stat status{};
  REQUIRE(stat(file.c_str(), &status) == 0);
  CHECK(status.st_uid == 1234);
  CHECK(status.st_gid == 4321);
}

TEST_CASE("another user's link in a folder for everyone is not followed") {
  if (geteuid() != 0) return;  // who alone can make a link of another user
  const TemporaryFolder folder;
  fs::create_directories(folder.path() / "mine");
  fs::create_directory(folder.path() / "shared");
  fs::permissions(folder.path() / "shared", fs::perms::all | fs::perms::sticky_bit);
  write_text(folder.file("mine/kept.txt"), "kept");
  const bool is_folder = GENERATE(false, true);
  const std::string link = folder.file("shared/link");
  fs::create_symlink(is_folder ? "../mine" : "../mine/kept.txt", link);
  const std::string file = is_folder ? link + "/kept.txt" : link;

  CHECK(refusal(file) == "");  // our own
  REQUIRE(lchown(link.c_str(), 1234, 1234) == 0);
  const FileIdentity kept = *file_identity(folder.file("mine/kept.txt"));
  CHECK(contains(refusal(file), "another user's symbolic link"));
  CHECK_FALSE(remove_file(file, kept));
  CHECK(bytes_of(folder.file("mine/kept.txt")) == "kept");

  REQUIRE(chown(folder.file("shared").c_str(), 1234, 1234) == 0);
  CHECK(refusal(file) == "");  // the folder's owner's
}

TEST_CASE("a file is removed if it is the very one") {
  const TemporaryFolder folder;
  const std::string file = folder.file("a.txt"), link = folder.file("link"), other = folder.file("other");
  AtomicFile atomic(file);
  atomic.commit();
  const FileIdentity identity = atomic.identity();
  fs::create_symlink("a.txt", link);
  write_text(other, "other");
  CHECK_FALSE(remove_file(other, identity));
  CHECK(fs::exists(other));
  CHECK(remove_file(link, identity));
  CHECK(folder.names().size() == 2);
  CHECK(fs::is_symlink(link));
  CHECK(remove_file(file, identity));  // it is gone
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
  CHECK(folder.names().size() == (chained ? 3 : 2));  // the temporary file is beside the target
  fill(atomic, "new");
  atomic.commit();
  CHECK(fs::is_symlink(link));
  CHECK(bytes_of(target) == "new");
}

TEST_CASE("a folder that is gone at the commit is reported") {
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
  SECTION("another user's file in a folder where only its owner may replace it") {
    if (geteuid() != 0) return;  // who alone can make one
    fs::permissions(folder.path(), fs::perms::all | fs::perms::sticky_bit);
    write_text(file, "old");
    fs::permissions(file, fs::perms::owner_all | fs::perms::others_all);
    REQUIRE(chown(file.c_str(), 1234, 1234) == 0);
    REQUIRE(chown(folder.path().c_str(), 1234, 1234) == 0);
    REQUIRE(seteuid(4321) == 0);
    const std::string message = refusal(file);
    REQUIRE(seteuid(0) == 0);
    CHECK(contains(message, "belongs to another user"));
    CHECK(bytes_of(file) == "old");
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
  int read = 0, mixed = 0;
  do {
    try {
      const ReadPicture picture = read_picture(file);
      const float first = picture.values.front();
      for (const float value : picture.values) mixed += value != first;
    } catch (const std::runtime_error&) {
      ++mixed;
    }
    ++read;
  } while (!done);
  writer.join();
  CHECK(read > 0);
  CHECK(mixed == 0);
  CHECK(folder.names() == std::vector<std::string>{"a.exr"});
}

}  // namespace raytrace::test
