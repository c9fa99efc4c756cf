// Models among a scene's objects: each is a mesh and the lights of its file.
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "raytrace/description/check_scene.h"
#include "raytrace/description/scene_description.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/gltf.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

namespace {

/// A triangle of wood, and a lamp, a spot and a sun, two units above it.
std::string lamp_gltf() {
  GltfFile file;
  file.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 5126, 3);
  return file.text(
      R"("scenes":[{"nodes":[0,1,2,3]}],"extensionsUsed":["KHR_lights_punctual"],
         "nodes":[{"mesh":0},{"translation":[0,0,2],"extensions":{"KHR_lights_punctual":{"light":0}}},
                  {"translation":[0,0,2],"extensions":{"KHR_lights_punctual":{"light":1}}},
                  {"extensions":{"KHR_lights_punctual":{"light":2}}}],
         "extensions":{"KHR_lights_punctual":{"lights":[
             {"type":"point","intensity":8,"color":[1,0.5,0.25]},
             {"type":"spot","intensity":3,"spot":{"innerConeAngle":0.1,"outerConeAngle":0.2}},
             {"type":"directional","intensity":2}]}},
         "materials":[{"name":"wood","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,1,1]}}],
         "meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}])");
}

const std::string sections_of_models =
    "<raytracer><viewplane><hres>8</hres><vres>8</vres></viewplane>\n"
    "<camera><eye x='0' y='0' z='5'/><lookat x='0' y='0' z='0'/><viewdistance>8</viewdistance></camera>\n"
    "<materials><mattes><matte><name>wood</name><ka>1</ka><kd>1</kd><cd red='1' green='0' "
    "blue='0'/></matte></mattes></materials>\n";

/// A folder with lamp.gltf and slab.obj, whose material wood is in slab.mtl; and what is said of scenes there.
class ModelFolder {
 public:
  ModelFolder() {
    write_text(folder_.file("lamp.gltf"), lamp_gltf());
    write_text(folder_.file("slab.obj"), "mtllib slab.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wood\nf 1 2 3\n");
    write_text(folder_.file("slab.mtl"), "newmtl wood\nKd 0.25 0.5 0.75\n");
  }

  /// The whole text of a scene, loaded with its meshes; REQUIREs it to be fine.
  SceneDescription load_text(const std::string& text) {
    std::optional<SceneDescription> scene = try_to_load(text);
    INFO(messages_);
    REQUIRE(scene);
    return std::move(*scene);
  }
  SceneDescription load(const std::string& sections) {
    return load_text(sections_of_models + sections + "</raytracer>");
  }

  std::string errors(const std::string& sections) {
    CHECK_FALSE(try_to_load(sections_of_models + sections + "</raytracer>"));
    return messages_;
  }

  /// What was said of the last scene.
  const std::string& messages() const { return messages_; }
  const TemporaryFolder& folder() const { return folder_; }

 private:
  std::optional<SceneDescription> try_to_load(const std::string& text) {
    write_text(folder_.file("scene.xml"), text);
    Diagnostics diagnostics("scene.xml");
    std::optional<SceneDescription> scene = load_scene(folder_.file("scene.xml"), diagnostics, 1);
    if (scene && !load_meshes(*scene, diagnostics, 1)) scene.reset();
    std::ostringstream printed;
    diagnostics.print(printed);
    messages_ = printed.str();
    const std::string folder = folder_.path().string() + "/";
    for (std::size_t at = 0; (at = messages_.find(folder, at)) != std::string::npos;)
      messages_.erase(at, folder.size());
    return scene;
  }

  TemporaryFolder folder_;
  std::string messages_;
};

const std::string step_of_models = "<transform><scale x='2' y='2' z='2'/><translate x='1' y='0' z='0'/></transform>";

}  // namespace

TEST_CASE("a model is a mesh and its file's lights") {
  ModelFolder files;
  const SceneDescription model = files.load(
      "<lights><pointlights><pointlight><location x='9' y='9' z='9'/></pointlight></pointlights></lights>"
      "<objects><models><model><name>lamp</name><file>lamp.gltf</file>" +
      step_of_models +
      "</model><model><file>slab.obj</file></model></models>"
      "<meshes><mesh><file>slab.obj</file><material>wood</material></mesh></meshes></objects>");
  CHECK(files.messages().empty());
  CHECK(std::get<ObjectItems<Model>>(model.objects).empty());
  const auto& spots = std::get<LightItems<SpotLight>>(model.lights);
  REQUIRE(spots.size() == 1);
  const SpotLight::Parameters& spot = spots[0].parameters;
  CHECK(spot.location.x == 1);
  CHECK(spot.location.z == 4);
  CHECK(spot.lookat.z < 4);
  CHECK(spot.color.red == 3);  // at every scale
  CHECK(spot.coneangle == Approx(0.4 * 180 / std::numbers::pi));
  CHECK(spot.penumbraangle == Approx(0.1 * 180 / std::numbers::pi));

  SceneDescription equivalent = files.load(
      "<lights><pointlights><pointlight><location x='9' y='9' z='9'/></pointlight>"
      "<pointlight><location x='1' y='0' z='4'/><color red='8' green='4' blue='2'/><falloff>inversesquare</falloff>"
      "</pointlight></pointlights><directionallights><directionallight><direction x='0' y='0' z='2'/>"
      "<color red='2' green='2' blue='2'/></directionallight></directionallights></lights>"
      "<objects><meshes><mesh><file>slab.obj</file><material>wood</material></mesh>"
      "<mesh><name>lamp</name><file>lamp.gltf</file>" +
      step_of_models + "</mesh><mesh><file>slab.obj</file></mesh></meshes></objects>");
  CHECK(scene_hash(model) != scene_hash(equivalent));
  std::get<LightItems<SpotLight>>(equivalent.lights) = spots;
  CHECK(scene_hash(model) == scene_hash(equivalent));
}

TEST_CASE("a scene's materials may take the place of a file's of the same names") {
  ModelFolder files;
  const auto names = [&](const std::string& model) {
    const SceneDescription scene = files.load("<objects>" + model + "</objects>");
    std::vector<std::string> result;
    for (const auto& mesh : std::get<ObjectItems<Mesh>>(scene.objects))
      with_type(Materials{}, mesh.materials.at(0).type, [&]<class T>(std::type_identity<T>) {
        result.push_back(std::get<MaterialItems<T>>(scene.materials).at(mesh.materials[0].index).name);
      });
    return result;
  };
  const std::string overridden = "<file>slab.obj</file><overridematerials>true</overridematerials>";
  CHECK(names("<models><model>" + overridden + "</model></models>") == std::vector<std::string>{"wood"});
  CHECK(files.messages().empty());
  // The same file in both ways.
  CHECK(names("<meshes><mesh><file>slab.obj</file></mesh><mesh>" + overridden + "</mesh></meshes>") ==
        std::vector<std::string>{"wood#2", "wood"});
  write_text(files.folder().file("slab.mtl"), "newmtl wood!\nKd 0.25 0.5 0.75\n");
  write_text(files.folder().file("slab.obj"), "mtllib slab.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wood!\nf 1 2 3\n");
  CHECK(names("<models><model>" + overridden + "</model></models>") == std::vector<std::string>{"wood!"});
  CHECK(contains(files.messages(),
                 "<overridematerials> changes nothing: no material of the scene has a name of the "
                 "file's, which are 'wood!'"));
}

TEST_CASE("nothing is said of materials of a file in whose place are the scene's") {
  ModelFolder models;
  write_text(models.folder().file("slab.mtl"), "newmtl wood\nKd 0.25 0.5 0.75\nd 0\nmap_Ks gloss.png\n");
  const auto told = [&](const std::string& meshes) {
    models.load("<objects><meshes>" + meshes + "</meshes></objects>");
    return models.messages();
  };
  const std::string plain = "<mesh><file>slab.obj</file></mesh>";
  const std::string covered = "<mesh><file>slab.obj</file><material>wood</material></mesh>";
  CHECK(contains(told(plain), "'map_ks' is left out"));
  CHECK(contains(told(plain), "an opacity of 0"));
  CHECK(told(covered).empty());
  CHECK(told("<mesh><file>slab.obj</file><overridematerials>true</overridematerials></mesh>").empty());
  // Of a file that several meshes have it is said once.
  CHECK(told(covered + plain) == told(plain));
}

TEST_CASE("a mesh has its file's materials beside one with its own") {
  ModelFolder models;
  const SceneDescription scene = models.load(
      "<objects><meshes><mesh><file>slab.obj</file><material>wood</material></mesh><mesh><file>slab.obj</file></mesh>"
      "</meshes></objects>");
  const auto& meshes = std::get<ObjectItems<Mesh>>(scene.objects);
  const auto& mattes = std::get<MaterialItems<Matte>>(scene.materials);
  REQUIRE(meshes.size() == 2);
  CHECK(mattes.at(meshes[0].materials.at(0).index).name == "wood");
  CHECK(mattes.at(meshes[1].materials.at(0).index).name == "wood#2");
  CHECK(meshes[0].data == meshes[1].data);
}

TEST_CASE("an MTL's highlight and diffuse colour reflect together no more than comes in") {
  ModelFolder files;
  const auto phong = [&](const std::string& statements) {
    write_text(files.folder().file("slab.mtl"), "newmtl wood\n" + statements);
    const SceneDescription scene =
        files.load("<objects><models><model><file>slab.obj</file></model></models></objects>");
    const auto& phongs = std::get<MaterialItems<Phong>>(scene.materials);
    REQUIRE(phongs.size() == 1);
    return phongs[0].parameters;
  };
  const auto lobe = [](double ns) { return 2 * std::numbers::pi / (ns + 2); };
  // Enough is left for it: nothing changes.
  const Phong::Parameters usual = phong("Kd 0.8 0.5 0\nKs 1 0.5 0.25\nNs 96\n");
  CHECK(usual.cd.red == 0.8);
  CHECK(usual.cs.red == 1);
  CHECK(usual.cs.blue == 0.25);
  const Phong::Parameters wide = phong("Kd 0.5 0.25 0\nKs 1 1 1\nNs 0\n");
  CHECK(wide.cd.red == Approx(0.5));
  CHECK(wide.cd.green == 0.25);
  CHECK(wide.cs.red * lobe(0) == Approx(0.5));
  CHECK(wide.cs.green == wide.cs.red);
  // White keeps what a smooth surface has.
  const Phong::Parameters white = phong("Kd 1 1 1\nKs 1 1 1\nNs 10\n");
  CHECK(white.cs.red * lobe(10) == Approx(0.04));
  CHECK(white.cd.red == Approx(0.96));
}

TEST_CASE("the printed scene of models is the same scene, and materials keep apart") {
  ModelFolder files;
  const SceneDescription scene = files.load(
      "<objects><models><model><file>lamp.gltf</file></model><model><file>slab.obj</file></model>"
      "<model><file>lamp.gltf</file><material>wood</material>" +
      step_of_models + "</model></models></objects>");
  std::vector<std::string> names;
  for (const auto& mesh : std::get<ObjectItems<Mesh>>(scene.objects)) {
    REQUIRE(mesh.materials.size() == 1);
    with_type(Materials{}, mesh.materials[0].type, [&]<class T>(std::type_identity<T>) {
      names.push_back(std::get<MaterialItems<T>>(scene.materials).at(mesh.materials[0].index).name);
    });
  }
  CHECK(names == std::vector<std::string>{"wood#2", "wood#3", "wood"});
  const std::string printed = print_scene(scene);
  CHECK_FALSE(contains(printed, "<model"));
  CHECK(std::get<LightItems<PointLight>>(scene.lights).size() == 2);
  const SceneDescription again = files.load_text(printed);
  CHECK(scene_hash(again) == scene_hash(scene));
  CHECK(print_scene(again) == printed);
}

TEST_CASE("a model in a group has no lights, which one warning says") {
  ModelFolder files;
  const std::string group =
      "<groups><group><name>g</name><objects>\n<models><model><file>lamp.gltf</file></model>"
      "<model><file>lamp.gltf</file>" +
      step_of_models + "</model></models></objects></group></groups>";
  const SceneDescription scene =
      files.load("<objects><instances><instance><group>g</group></instance></instances></objects>\n" + group);
  CHECK(files.messages() ==
        "scene.xml:6:22: warning: lamp.gltf: its lights are left out, since the <model> is in a <group>, which has "
        "none\n");
  REQUIRE(scene.groups.size() == 1);
  CHECK(std::get<ObjectItems<Mesh>>(scene.groups[0].objects).size() == 2);
  CHECK(std::get<LightItems<PointLight>>(scene.lights).empty());
}

TEST_CASE("a model of an included file is looked for beside it, and missed there") {
  ModelFolder files;
  write_text(files.folder().file("part.xml"),
             "<raytracer>\n<objects><models><model><file>lamp.gltf</file></model></models></objects></raytracer>");
  CHECK(std::get<ObjectItems<Mesh>>(files.load("<include><file>part.xml</file></include>").objects).size() == 1);
  write_text(files.folder().file("part.xml"),
             "<raytracer>\n<objects><models><model><file>none.glb</file></model></models></objects></raytracer>");
  CHECK(files.errors("<include><file>part.xml</file></include>") ==
        "part.xml:2:31: error: none.glb: cannot read it: No such file or directory\n");
}

TEST_CASE("files that are missing are reported with what else is wrong") {
  ModelFolder files;
  CHECK(files.errors("<objects>\n<spheres><sphere><radius>1</radius><material>wood</material></sphere></"
                     "spheres>\n<models><model><file>none.glb"
                     "</file></model></models><meshes><mesh><file>slab.obj</file></mesh><mesh>\n<file>none.ply</file>"
                     "</mesh></meshes></objects>") ==
        "scene.xml:5:10: error: missing <center> in <sphere>; add <center x=\"1\" y=\"1\" z=\"1\"/>\n"
        "scene.xml:6:22: error: none.glb: cannot read it: No such file or directory\n"
        "scene.xml:7:7: error: none.ply: cannot read it: No such file or directory\n");
}

TEST_CASE("what is wrong with a model is said where its file is named") {
  ModelFolder files;
  const auto with_model = [&](const std::string& text) {
    return files.errors("<objects><models>\n<model>" + text + "</model></models></objects>");
  };
  CHECK(with_model("<file>none.glb</file>") ==
        "scene.xml:5:14: error: none.glb: cannot read it: No such file or directory\n");
  CHECK(contains(with_model("<file>scene.xml</file>"), "scene.xml:5:14: error: scene.xml: is no mesh by its name"));
  CHECK(contains(with_model("<file>lamp.gltf</file><variant>red</variant>"), "has no material variant 'red'"));
  CHECK(contains(with_model("<file>slab.obj</file><animation>go</animation>"), "it is no glTF"));
  CHECK(contains(with_model("<name>a</name>"), "missing <file> in <model>"));
  CHECK(contains(with_model("<file>lamp.gltf</file><positions>0 0 0</positions>"), "unknown element <positions>"));
}

TEST_CASE("the names of a file's nodes, of which ids are, count in the hash where there are several") {
  ModelFolder files;
  const auto hash = [&](const std::string& nodes, const std::string& roots) {
    GltfFile file;
    file.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 5126, 3);
    write_text(files.folder().file("nodes.gltf"),
               file.text("\"scenes\":[{\"nodes\":" + roots + "}],\"nodes\":[" + nodes +
                         "],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}]"));
    return scene_hash(files.load("<objects><models><model><file>nodes.gltf</file></model></models></objects>"));
  };
  const std::string left = R"({"mesh":0,"name":"left"})", right = R"({"mesh":0,"name":"right"})";
  const std::string two = hash(left + ',' + right, "[0,1]");
  CHECK(hash(left + ',' + right, "[0,1]") == two);
  CHECK(hash(R"({"mesh":0,"name":"LEFT"},)" + right, "[0,1]") != two);
  CHECK(hash(right, "[0]") == hash(left, "[0]"));
}

TEST_CASE("a model that has not been loaded is refused, and counts in the hash") {
  SceneDescription scene;
  const std::string without = scene_hash(scene);
  std::get<ObjectItems<Model>>(scene.objects).emplace_back().parameters.file.path = "lamp.gltf";
  CHECK(scene_hash(scene) != without);
  Diagnostics diagnostics("scene");
  check_scene(scene, diagnostics);
  bool refused = false;
  for (const Diagnostic& diagnostic : diagnostics.kept())
    refused = refused || contains(diagnostic.message, "<model> [0] has not been loaded");
  CHECK(refused);
}

}  // namespace raytrace::test
