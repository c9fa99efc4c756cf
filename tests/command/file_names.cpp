// What is put into the names of files.
#include <filesystem>

#include "raytrace/batch/frames.h"
#include "raytrace/batch/settings_error.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

TEST_CASE("the frame's number stands in for its tokens") {
  const auto name = [](const std::string& text, int frame) { return file_name(text, {frame, {}, "s.xml"}); };
  CHECK(name("a.####.exr", 7) == "a.0007.exr");
  CHECK(name("a.#.exr", 12) == "a.12.exr");
  CHECK(name("a##", 123) == "a123");
  CHECK(name("####", -7) == "-007");
  CHECK(name("%04d/%d/%02d", 7) == "0007/7/07");
  CHECK(name("f##/a.%03d.exr", 5) == "f05/a.005.exr");
  for (const char* const text : {"a.exr", "100%.exr", "%s", "%4d", "%20d", "%0d", "%", "%0", "%00", "{frame}"})
    CHECK(name(text, 7) == text);
}

TEST_CASE("without a frame its tokens stand for themselves") {
  CHECK(file_name("take#1.%04d.exr", {{}, {}, "s.xml"}) == "take#1.%04d.exr");
  CHECK(scene_file_name("C#/s.xml", {}) == "C#/s.xml");
}

TEST_CASE("a # and a % can be written, too") {
  const auto name = [](const std::string& text) { return file_name(text, {5, {}, "s.xml"}); };
  CHECK(name("take{#}1.##.exr") == "take#1.05.exr");
  CHECK(name("{#}{#}#") == "##5");
  CHECK(name("100%%.%d.exr") == "100%.5.exr");
  CHECK(name("%%04d%%%02d") == "%04d%05");
  CHECK(scene_file_name("C{#}/%%d.#.xml", 5) == "C#/%d.5.xml");
  CHECK_FALSE(has_frame_token("{#}%%d"));
  CHECK(has_frame_token("{#}#"));
  CHECK(with_tokens("{#}.exr", true, false) == "{#}.####.exr");
}

TEST_CASE("folders that are there keep their names") {
  const TemporaryFolder folder;
  for (const char* const name : {"C#", "C#/100%d", "f.0001"}) std::filesystem::create_directory(folder.path() / name);
  const auto kept = [&](const std::string& name) {
    return with_folders_kept(folder.file(name)).substr(folder.path().string().size() + 1);
  };
  CHECK(kept("C#/a.####.exr") == "C{#}/a.####.exr");
  CHECK(kept("C#//100%d/%d.exr") == "C{#}//100%%d/%d.exr");
  CHECK(kept("f.####/a.##.exr") == "f.####/a.##.exr");
  CHECK(kept("C#") == "C#");
  CHECK(kept("C{#}/C#/") == "C{#}/C#/");
  CHECK(with_folders_kept("a.#.exr") == "a.#.exr");
}

TEST_CASE("the scene and the tile stand in for their tokens") {
  CHECK(file_name("out/{scene}.exr", {{}, {}, "shots/first.v2.xml"}) == "out/first.v2.exr");
  CHECK(file_name("{scene}.{tile}.exr", {{}, 3, "-"}) == "stdin.3.exr");
  // What is put in is not looked at again.
  CHECK(file_name("{scene}", {5, {}, "{tile}#.xml"}) == "{tile}#");
  CHECK(file_name("{SCENE}{x}{", {{}, {}, "s.xml"}) == "{SCENE}{x}{");
  // No name climbs out of its folder.
  for (const char* const scene : {"...xml", "..xml", "a/...xml", ".xml", "..a"})
    CHECK(file_name("{scene}", {{}, {}, scene}) == std::filesystem::path(scene).filename());
  for (const char* const scene : {"..", ".", "....", "a/..", "a/"})
    CHECK_THROWS_AS(file_name("{scene}/a", {{}, {}, scene}), SettingsError);
  CHECK_THROWS_AS(file_name("a.{tile}.exr", {7, {}, "s.xml"}), SettingsError);
}

TEST_CASE("names of scenes have frames only") {
  CHECK(scene_file_name("{scene}.{tile}.##.xml", 3) == "{scene}.{tile}.03.xml");
}

TEST_CASE("tokens are added before the extension, where they are missing") {
  CHECK(with_tokens("out/a.exr", true, false) == "out/a.####.exr");
  CHECK(with_tokens("out/a.exr", true, true) == "out/a.{scene}.####.exr");
  CHECK(with_tokens("a.#.exr", true, true) == "a.#.{scene}.exr");
  CHECK(with_tokens("{scene}.%03d.exr", true, true) == "{scene}.%03d.exr");
  CHECK(has_frame_token("a.%03d"));
  CHECK_FALSE(has_frame_token("a.%3d"));
}

}  // namespace raytrace::test
