// Each file of bad/ has one fault; the file of the same name that ends in .expected has what must be said about it.
#include <algorithm>
#include <filesystem>
#include <sstream>
#include <vector>

#include "raytrace/description/scene_description.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

TEST_CASE("each bad scene is refused with exactly its message") {
  std::vector<std::filesystem::path> scenes;
  for (const auto& entry : std::filesystem::directory_iterator(RAYTRACE_SOURCE_DIR "/tests/description/bad")) {
    if (entry.path().extension() == ".xml") scenes.push_back(entry.path());
  }
  std::sort(scenes.begin(), scenes.end());
  REQUIRE(scenes.size() > 100);
  for (const std::filesystem::path& scene : scenes) {
    Diagnostics diagnostics(scene.filename().string());
    CHECK_FALSE(parse_scene(bytes_of(scene), diagnostics));
    CHECK(diagnostics.has_errors());
    std::ostringstream found;
    diagnostics.print(found);
    std::filesystem::path expected = scene;
    CHECK(found.str() == bytes_of(expected.replace_extension(".expected")));
  }
}

TEST_CASE("the seed's sample gives exactly one warning") {
  const std::string file = RAYTRACE_SOURCE_DIR "/scenes/seed.xml";
  Diagnostics diagnostics(file);
  const auto scene = load_scene(file, diagnostics);
  REQUIRE(scene);
  CHECK(scene->file == file);
  CHECK(diagnostics.error_count() == 0);
  REQUIRE(diagnostics.warning_count() == 1);
  CHECK(diagnostics.kept()[0].location.line == 27);
  CHECK(diagnostics.kept()[0].location.column == 18);
  CHECK(std::get<LightItems<PointLight>>(scene->lights).at(0).parameters.shadows);
  CHECK(std::get<ObjectItems<Triangle>>(scene->objects).at(0).name == "triangle1");
  CHECK(std::get<ObjectItems<Triangle>>(scene->objects).at(0).line == 51);
}

}  // namespace raytrace::test
