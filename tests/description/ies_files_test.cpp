// The IES files that a scene's lights name.
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "raytrace/description/scene_description.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

namespace {

const std::string lamp_file = "TILT=NONE\n1 1 1 3 1 1 2 0 0 0 1 1 1\n0 45 90\n0\n4 2 1\n";

/// A folder with a scene of a point light, whose IES file has that in it.
class LitScene {
 public:
  explicit LitScene(const std::string& ies) {
    write_text(folder_.path() / "lamp.ies", ies);
    write_text(file_, R"(<raytracer>
  <viewplane> <hres>4</hres> <vres>3</vres> </viewplane>
  <camera> <eye x="0" y="0" z="9"/> <lookat x="0" y="0" z="0"/> <viewdistance>4</viewdistance> </camera>
  <lights> <pointlights> <pointlight>
    <location x="1" y="2" z="3"/> <iesfile>lamp.ies</iesfile>
  </pointlight> </pointlights> </lights>
</raytracer>
)");
  }
  std::optional<SceneDescription> load() { return load_scene(file_.string(), diagnostics_); }
  const Diagnostics& diagnostics() const { return diagnostics_; }

 private:
  TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "scene.xml";
  Diagnostics diagnostics_{"scene.xml"};
};

}  // namespace

TEST_CASE("a light's IES file is loaded with the scene") {
  const auto scene = LitScene(lamp_file).load();
  REQUIRE(scene);
  const auto& light = std::get<LightItems<PointLight>>(scene->lights).at(0);
  REQUIRE(light.photometry.shares);
  CHECK(light.photometry.shares->shares.at(0) == 1);
}

TEST_CASE("an IES file that is broken is an error where the light names it") {
  LitScene lit("TILT=NONE\n1 1 1 3 1 1 2 0 0 0 1 1 1\n0 45 90\n0\n4 -2 1\n");
  CHECK_FALSE(lit.load());
  REQUIRE(lit.diagnostics().error_count() == 1);
  const Diagnostic& error = lit.diagnostics().kept().front();
  CHECK(error.location.line == 5);
  CHECK(error.location.column == 44);
  CHECK(error.message.find("line 5, column 3: an intensity is negative") != std::string::npos);
}

TEST_CASE(
    "what is wrong with files is reported beside all else, even where a material has a texture that was refused") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "scene.xml";
  write_text(file, R"(<raytracer>
  <viewplane> <hres>4</hres> <vres>3</vres> </viewplane>
  <camera> <eye x="0" y="0" z="9"/> <lookat x="0" y="0" z="0"/> <viewdistance>4</viewdistance> </camera>
  <lights> <pointlights> <pointlight> <location x="1" y="2" z="3"/> <iesfile>no.ies</iesfile> </pointlight> </pointlights> </lights>
  <textures> <images>
    <image> <name>skin</name> <file>no.png</file> </image>
    <image> <name>hair</name> <flie>no.png</flie> </image>
  </images> </textures>
  <materials> <mattes> <matte> <name>m</name> <ka>0</ka> <kd>1</kd> <cd texture="hair"/> </matte> </mattes> </materials>
</raytracer>
)");
  Diagnostics diagnostics("scene.xml");
  CHECK_FALSE(load_scene(file.string(), diagnostics));
  std::vector<std::uint32_t> lines;
  for (const Diagnostic& error : diagnostics.kept()) lines.push_back(error.location.line);
  std::sort(lines.begin(), lines.end());
  CHECK(lines == std::vector<std::uint32_t>{4, 6, 7});
}

TEST_CASE("a scene's hash has the bytes of its IES files") {
  const auto one = LitScene(lamp_file).load(), same = LitScene(lamp_file).load(),
             other = LitScene(lamp_file + " ").load();
  REQUIRE((one && same && other));
  CHECK(scene_hash(*one) == scene_hash(*same));
  CHECK(scene_hash(*one) != scene_hash(*other));
}

}  // namespace raytrace::test
