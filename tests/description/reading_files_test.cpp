#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "raytrace/xml/scene_text.h"
#include "reported.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

namespace raytrace::test {
namespace {

std::string reported_of_file(const std::string& file) {
  Diagnostics diagnostics(file);
  const auto scene = load_scene(file, diagnostics);
  CHECK(scene.has_value() != diagnostics.has_errors());
  std::ostringstream out;
  diagnostics.print(out);
  return out.str();
}

/// Standard input from a file, as long as it lives.
class StandardInput {
 public:
  explicit StandardInput(const std::string& contents) : saved_(dup(STDIN_FILENO)) {
    std::FILE* const file = std::tmpfile();
    std::fwrite(contents.data(), 1, contents.size(), file);
    std::fseek(file, 0, SEEK_SET);
    std::clearerr(stdin);
    dup2(fileno(file), STDIN_FILENO);
    std::fclose(file);
  }
  ~StandardInput() {
    dup2(saved_, STDIN_FILENO);
    close(saved_);
    std::clearerr(stdin);
  }
  StandardInput(const StandardInput&) = delete;
  StandardInput& operator=(const StandardInput&) = delete;

 private:
  int saved_;
};

}  // namespace

TEST_CASE("a file that cannot be read is an error of the file, not of a line") {
  CHECK(reported_of_file("/no such folder/scene.xml") ==
        "/no such folder/scene.xml: error: cannot read the scene: No such file or directory\n");
  CHECK(reported_of_file("/") == "/: error: cannot read the scene: Is a directory\n");
  CHECK(reported_of_file("") == ": error: cannot read the scene: No such file or directory\n");
  CHECK(reported_of_file("/dev/null") == "/dev/null:1:1: error: the file is empty; a scene starts with <raytracer>\n");
}

TEST_CASE("files of points are known from scenes by their names") {
  const TemporaryFolder folder;
  const std::string file = folder.file("atoms.xyz");
  std::ofstream(file) << "2\nwater\nO 0 0 0\nH 1 0 0\n";
  CHECK(reported_of_file(file) == file +
                                      ":1:1: error: this is no scene by its name: points are read by the "
                                      "<spherecloud> of a scene, from a .ply with x, y and z\n");
}

TEST_CASE("standard input is given as -, and shown as <stdin>") {
  {
    const StandardInput empty("");
    CHECK(reported_of_file("-") == "<stdin>:1:1: error: the file is empty; a scene starts with <raytracer>\n");
  }
  // Larger than what is read at first.
  const StandardInput input(std::string(200000, '\n') + scene_with("<lights/>"));
  Diagnostics diagnostics("-");
  const auto scene = load_scene("-", diagnostics);
  REQUIRE(scene);
  CHECK(scene->file == "-");
  CHECK(scene->viewplane.hres == 4);
}

TEST_CASE("a large file is read by several threads as by one") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "large.xml";
  // Each line is another number, so that no part can stand for another.
  std::string text = scene_with("<lights/>") + "\n<!--";
  for (int line = 0; text.size() < (std::size_t{40} << 20); ++line) text += "\n" + std::to_string(line);
  text += "\n-->\n";
  write_text(file, text + "wrong");
  const auto lines = std::to_string(std::count(text.begin(), text.end(), '\n') + 1);
  for (const int threads : {1, 3}) {
    Diagnostics diagnostics(file.string());
    const auto read = read_text_file(file.string(), threads, diagnostics);
    REQUIRE(read);
    CHECK(read->text() == text + "wrong");
    CHECK(!load_scene(file.string(), diagnostics, threads));
    std::ostringstream out;
    diagnostics.print(out);
    CHECK(out.str() == file.string() + ":" + lines + ":1: error: text after the end of the scene; remove it\n");
  }
}

TEST_CASE("diagnostics are printed in the order of the file, at most 100 of a severity, and the rest counted") {
  Diagnostics diagnostics("scene.xml");
  diagnostics.error({3, 1}, "third");
  diagnostics.warning({2, 7}, "second");
  diagnostics.error({2, 5}, "first");
  diagnostics.error({}, "of the file");
  for (int i = 0; i < 100; ++i) diagnostics.error({9, 9}, "more");
  CHECK(diagnostics.error_count() == 103);
  CHECK_FALSE(diagnostics.keeps_another(Severity::error));
  CHECK(diagnostics.keeps_another(Severity::warning));
  CHECK(diagnostics.kept().size() == 101);
  std::ostringstream out;
  diagnostics.print(out);
  CHECK(out.str().starts_with(
      "scene.xml: error: of the file\nscene.xml:2:5: error: first\n"
      "scene.xml:2:7: warning: second\nscene.xml:3:1: error: third\nscene.xml:9:9: error: more\n"));
  CHECK(out.str().ends_with("scene.xml: 3 more errors not shown\n"));
}

}  // namespace raytrace::test
