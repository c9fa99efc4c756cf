// Files of a run that are one file.
#include <filesystem>

#include "raytrace/batch/settings_error.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

namespace fs = std::filesystem;

TEST_CASE("all spellings of a file are one file, whether it is there or not") {
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "sub");
  fs::create_directory_symlink("sub", folder.path() / "link");
  const bool exists = GENERATE(true, false);
  if (exists) write_text(folder.file("sub/a.exr"), "");
  fs::create_symlink("link/a.exr", folder.file("to-a"));
  fs::create_symlink("to-a", folder.file("to-to-a"));
  UsedFiles files;
  REQUIRE(files.add({"--output", folder.file("sub/a.exr"), true}) == nullptr);
  for (const char* const spelling :
       {"sub/a.exr", "link/a.exr", "./sub//a.exr", "sub/../link/./a.exr", "to-a", "to-to-a"}) {
    INFO(spelling);
    const UsedFile* const other = files.add({"the scene", folder.file(spelling)});
    REQUIRE(other != nullptr);
    CHECK(other->file == folder.file("sub/a.exr"));
    CHECK(other->role == "--output");
  }
  for (const char* const another : {"a.exr", "sub/b.exr", "link/A.exr", "sub/a.exr.exr"})
    CHECK(files.add({"--output", folder.file(another), true}) == nullptr);
  const fs::path here = fs::current_path();
  fs::current_path(folder.path() / "sub");
  CHECK(files.add({"--stats", "a.exr", true}) != nullptr);
  fs::current_path(here);
}

TEST_CASE("a hard link is the same file, and so are names in a folder that is missing") {
  const TemporaryFolder folder;
  write_text(folder.file("a"), "");
  fs::create_hard_link(folder.path() / "a", folder.path() / "b");
  UsedFiles files;
  CHECK(files.add({"the scene", folder.file("a")}) == nullptr);
  CHECK(files.add({"--log-file", folder.file("b"), true}) != nullptr);
  CHECK(files.add({"--output", folder.file("missing/a"), true}) == nullptr);
  CHECK(files.add({"--output", folder.file("missing/./a"), true}) != nullptr);
}

TEST_CASE("what is only read may be read twice, and what is no regular file is shared") {
  const TemporaryFolder folder;
  UsedFiles files;
  for (int i = 0; i < 2; ++i) {
    CHECK(files.add({"the scene", folder.file("a.xml")}) == nullptr);
    CHECK(files.add({"--log-file", "/dev/null", true}) == nullptr);
  }
  CHECK(files.add({"--output", folder.file("a.xml"), true}) != nullptr);
}

}  // namespace raytrace::test
