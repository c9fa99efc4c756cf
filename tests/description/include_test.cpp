// Scenes in several files.
#include <filesystem>
#include <fstream>
#include <sstream>

#include "raytrace/description/scene_description.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

namespace {

const std::string view_sections =
    "<viewplane><hres>8</hres><vres>8</vres></viewplane>\n"
    "<camera><eye x='0' y='0' z='5'/><lookat x='0' y='0' z='0'/><viewdistance>8</viewdistance></camera>\n";
const std::string red_material =
    "<materials><mattes><matte><name>red</name><ka>1</ka><kd>1</kd><cd red='1' green='0' "
    "blue='0'/></matte></mattes></materials>\n";

std::string ball_section(const std::string& name, const std::string& material = "red") {
  return "<objects><spheres><sphere><name>" + name + "</name><center x='0' y='0' z='0'/><radius>1</radius><material>" +
         material + "</material></sphere></spheres></objects>\n";
}

std::string include_of(const std::string& file) { return "<include><file>" + file + "</file></include>\n"; }

/// A scene of several files in a folder of its own.
class SceneFolder {
 public:
  void write(const std::string& name, const std::string& sections) const {
    std::filesystem::create_directories(std::filesystem::path(folder_.file(name)).parent_path());
    std::ofstream(folder_.file(name), std::ios::binary) << "<raytracer>\n" << sections << "</raytracer>\n";
  }
  std::string file(const std::string& name) const { return folder_.file(name); }

  /// Of main.xml.
  std::optional<SceneDescription> load(const SceneSettings& settings = {}) {
    diagnostics_ = Diagnostics(file("main.xml"));
    return load_scene(file("main.xml"), diagnostics_, 1, settings);
  }

  /// What was wrong, without the folder's name.
  std::string errors() {
    CHECK_FALSE(load());
    std::ostringstream printed;
    diagnostics_.print(printed);
    std::string text = printed.str();
    const std::string folder = folder_.path().string() + "/";
    for (std::size_t at = 0; (at = text.find(folder, at)) != std::string::npos;) text.erase(at, folder.size());
    return text;
  }

 private:
  TemporaryFolder folder_;
  Diagnostics diagnostics_{""};
};

}  // namespace

TEST_CASE("a scene of several files is that of one with their sections in their order") {
  SceneFolder files;
  files.write("main.xml", include_of("parts/all.xml") + ball_section("a") + view_sections + include_of("last.xml"));
  files.write("parts/all.xml", include_of("red.xml") + ball_section("b", "$paint"));
  files.write("parts/red.xml", red_material);
  files.write("last.xml", "<groups><group><name>g</name>" + ball_section("c") + "</group></groups>" +
                              ball_section("d") +
                              "<objects><instances><instance><group>g</group></instance></instances></objects>");
  const SceneSettings settings{1, {{"paint", "red"}}};
  const auto scene = files.load(settings);
  REQUIRE(scene);
  CHECK(scene->file == files.file("main.xml"));
  std::vector<std::string> names;
  for (const IncludedFile& file : scene->included) names.push_back(file.name);
  CHECK(names ==
        std::vector<std::string>{files.file("parts/all.xml"), files.file("parts/red.xml"), files.file("last.xml")});
  names.clear();
  for (const auto& sphere : std::get<ObjectItems<Sphere>>(scene->objects)) names.push_back(sphere.name);
  CHECK(names == std::vector<std::string>{"b", "a", "d"});

  SceneFolder merged;
  merged.write("main.xml", red_material + ball_section("b", "$paint") + ball_section("a") + view_sections +
                               "<groups><group><name>g</name>" + ball_section("c") + "</group></groups>" +
                               ball_section("d") +
                               "<objects><instances><instance><group>g</group></instance></instances></objects>");
  const auto one = merged.load(settings);
  REQUIRE(one);
  CHECK(scene_hash(*scene) == scene_hash(*one));
  CHECK(print_scene(*scene) == print_scene(*one));
}

TEST_CASE("what is wrong in an included file has that file's name and lines") {
  SceneFolder files;
  files.write("main.xml", view_sections + include_of("b.xml") + "<lihgts/>\n");
  files.write("b.xml", red_material +
                           "<objects><spheres>\n<sphere><center x='0' y='0' z='0'/><radius>-1</radius>"
                           "<material>red</material></sphere></spheres></objects>\n" +
                           ball_section("x", "blue"));
  CHECK(files.errors() ==
        "main.xml:5:1: error: unknown element <lihgts> in <raytracer>; did you mean <lights>?\n"
        "b.xml:4:44: error: '-1' in <radius> must be greater than 0\n"
        "b.xml:5:96: error: unknown material 'blue' in <sphere>; add one of that name to <materials>\n");
}

TEST_CASE("names are unique, and what a scene has once it has once, over all files") {
  SceneFolder files;
  files.write("main.xml", view_sections + red_material + ball_section("a") + include_of("b.xml"));
  files.write("b.xml", "\n" + view_sections + red_material + ball_section("a") +
                           "<groups><group><name>g</name></group></groups>" + include_of("c.xml"));
  files.write("c.xml", "<groups><group><name>g</name></group></groups>");
  CHECK(files.errors() ==
        "b.xml:3:1: error: a second <viewplane>; a scene has one, and the first is in line 2 of main.xml\n"
        "b.xml:4:1: error: a second <camera>; a scene has one, and the first is in line 3 of main.xml\n"
        "b.xml:5:33: error: the material name 'red' is taken by the <matte> in line 4 of main.xml; choose another\n"
        "b.xml:6:33: error: the object name 'a' is taken by the <sphere> in line 5 of main.xml; choose another\n"
        "c.xml:2:22: error: the group name 'g' is taken by the <group> in line 7 of b.xml; choose another\n");
  // One message in place of one a name.
  files.write("main.xml", view_sections + include_of("red.xml") + include_of("red.xml"));
  files.write("red.xml", red_material);
  CHECK(files.errors() == "main.xml:5:16: error: red.xml: it is included twice, and its names can be there but once\n");
  files.write("main.xml", view_sections + include_of("lights.xml") + include_of("lights.xml"));
  files.write("lights.xml", "<lights><pointlights/></lights>");
  CHECK(files.load());
}

TEST_CASE("a texture or mesh of an included file is looked for beside it, and missed there") {
  SceneFolder files;
  files.write("main.xml", view_sections + include_of("parts/b.xml"));
  files.write("parts/b.xml",
              "<textures><images>\n<image><name>wood</name><file>wood.png</file></image></images></textures>\n");
  CHECK(files.errors().starts_with("parts/b.xml:3:31: error: the texture 'parts/wood.png' cannot be used"));
  files.write("parts/b.xml", "<objects><meshes>\n<mesh><file>a.ply</file></mesh></meshes></objects>\n");
  auto scene = files.load();
  REQUIRE(scene);
  Diagnostics of_meshes("main.xml");
  CHECK_FALSE(load_meshes(*scene, of_meshes));
  REQUIRE(of_meshes.kept().size() == 1);
  CHECK(of_meshes.kept()[0].file == files.file("parts/b.xml"));
  CHECK(of_meshes.kept()[0].location.line == 3);
}

TEST_CASE("files that cannot be included are errors where they are named, and nothing else is") {
  SceneFolder files;
  const auto error_of = [&](const std::string& name) {
    files.write("main.xml", include_of(name) + ball_section("a"));
    return files.errors();
  };
  std::filesystem::create_directory(files.file("folder"));
  CHECK(error_of("none.xml") == "main.xml:2:16: error: none.xml: cannot read the scene: No such file or directory\n");
  CHECK(error_of("folder") == "main.xml:2:16: error: folder: cannot read the scene: it is a folder\n");
  CHECK(error_of("/dev/zero") == "main.xml:2:16: error: /dev/zero: cannot read the scene: it is not a regular file\n");
  std::ofstream(files.file("bad.xml")) << "<raytracer>\n<lights>\n</raytracer>\n";
  CHECK(error_of("bad.xml").starts_with("bad.xml:3:1: error: "));
  std::ofstream(files.file("model.ply")) << "ply\nformat ascii 1.0\n";
  CHECK(error_of("model.ply").starts_with("model.ply:1:1: error: this seems to be a PLY model"));
  std::ofstream(files.file("svg.xml")) << "\n<svg/>";
  CHECK(error_of("svg.xml") == "svg.xml:2:1: error: the scene starts with <svg>; it must be <raytracer>\n");
  // Nor is the camera missed where it may be in what was meant by this.
  files.write("main.xml", "<inculde><file>a.xml</file></inculde>" + ball_section("a"));
  CHECK(files.errors() == "main.xml:2:1: error: unknown element <inculde> in <raytracer>; did you mean <include>?\n");
}

TEST_CASE("files that include each other without end are refused, and ten thousand are not") {
  SceneFolder files;
  files.write("main.xml", view_sections + include_of("b.xml"));
  files.write("b.xml", "\n" + include_of("./main.xml"));
  CHECK(files.errors() == "b.xml:3:16: error: ./main.xml: it would include itself\n");

  for (int i = 0; i < 70; ++i) files.write("deep" + std::to_string(i), include_of("deep" + std::to_string(i + 1)));
  files.write("main.xml", view_sections + include_of("deep0"));
  CHECK(files.errors() ==
        "deep62:2:16: error: deep63: a file that is included may include others, but not more than 64 one in the "
        "other\n");

  std::string all;
  for (int i = 0; i < 10000; ++i) all += include_of("empty.xml");
  files.write("empty.xml", "");
  files.write("many.xml", all);
  files.write("main.xml", view_sections + include_of("many.xml"));
  const auto scene = files.load();
  REQUIRE(scene);
  CHECK(scene->included.size() == 10001);
  files.write("main.xml", view_sections + include_of("many.xml") + include_of("many.xml"));
  CHECK(files.errors().find("a scene has at most 20000 files") != std::string::npos);
}

}  // namespace raytrace::test
