// The layout of a scene: sections, groups and names.
#include <string>
#include <vector>

#include "raytrace/description/scene_layout.h"
#include "raytrace/text/message.h"
#include "reported.h"
#include "support/catch.h"
#include "support/contains.h"

namespace raytrace::test {
namespace {

const std::string sphere = "<sphere><center x='0' y='0' z='0'/><radius>1</radius><material>clay</material></sphere>";

template <class T>
std::size_t count(const SceneDescription& scene) {
  return std::get<ObjectItems<T>>(scene.objects).size();
}

}  // namespace

TEST_CASE("sections and groups may be missing, empty and repeated") {
  CHECK(count<Sphere>(accepted(scene_with(""))) == 0);
  CHECK(count<Sphere>(accepted(scene_with("<objects/>"))) == 0);
  CHECK(count<Sphere>(accepted(scene_with("<objects> <spheres/> <spheres> </spheres> <!-- --> </objects><lights/>"))) ==
        0);
  CHECK(count<Sphere>(
            accepted(scene_with("<objects><spheres>" + sphere + sphere + "</spheres><planes/><spheres>" + sphere +
                                "</spheres></objects><objects><spheres>" + sphere + "</spheres></objects>"))) == 4);
  const SceneDescription lit = accepted(scene_with(
      "<lights><pointlights><pointlight><location x='0' y='1' z='2'/></pointlight></pointlights></lights><lights>"
      "<ambientlight/></lights><lights><pointlights><pointlight><location x='3' y='4' "
      "z='5'/></pointlight></pointlights></lights>"));
  CHECK(std::get<LightItems<PointLight>>(lit.lights).size() == 2);
  CHECK(std::get<LightItems<PointLight>>(lit.lights)[1].parameters.location.z == 5);
  CHECK(std::get<LightItems<AmbientLight>>(lit.lights).size() == 1);
}

TEST_CASE("order is free: objects may come before their materials") {
  const std::string text = scene_with("");
  const std::string late_materials = text.substr(0, text.find("<materials>")) + "<objects><spheres>" + sphere +
                                     "</spheres></objects>" + text.substr(text.find("<materials>"));
  const SceneDescription scene = accepted(late_materials);
  REQUIRE(count<Sphere>(scene) == 1);
  CHECK(std::get<ObjectItems<Sphere>>(scene.objects)[0].material.type == index_of<Matte>(Materials{}));
  CHECK(std::get<ObjectItems<Sphere>>(scene.objects)[0].material.index == 0);
}

TEST_CASE("objects refer to materials by type and index") {
  const SceneDescription scene = accepted(scene_with(
      "<materials><phongs><phong><name>gold</name><ka>0</ka><kd>1</kd><ks>1</ks><cd red='1' green='1' blue='1'/>"
      "<cs red='1' green='1' blue='1'/></phong></phongs></materials><objects><spheres><sphere><material>gold</material>"
      "<radius>1</radius><center x='0' y='0' z='0'/></sphere></spheres></objects>"));
  const MaterialReference gold = std::get<ObjectItems<Sphere>>(scene.objects).at(0).material;
  CHECK(gold.type == index_of<Phong>(Materials{}));
  CHECK(std::get<MaterialItems<Phong>>(scene.materials).at(gold.index).name == "gold");
}

TEST_CASE("defaults stand where nothing is said") {
  const SceneDescription scene = accepted(scene_with(
      "<lights><ambientlight/><directionallights><directionallight><direction x='0' y='1' z='0'/></directionallight>"
      "</directionallights></lights><objects><toruses><torus><sweptradius>2</sweptradius><tuberadius>1</tuberadius>"
      "<material>clay</material></torus></toruses></objects>"));
  CHECK(scene.viewplane.pixelsize == 1);
  CHECK(scene.viewplane.samples == 1);
  CHECK(scene.viewplane.background.green == 0);
  CHECK(std::get<PinholeCamera::Parameters>(scene.camera).up.y == 1);
  CHECK(std::get<LightItems<AmbientLight>>(scene.lights).at(0).parameters.scaleradiance == 1);
  CHECK(std::get<LightItems<DirectionalLight>>(scene.lights).at(0).parameters.shadows);
  CHECK(std::get<LightItems<DirectionalLight>>(scene.lights).at(0).parameters.color.blue == 1);
  CHECK(std::get<ObjectItems<Torus>>(scene.objects).at(0).parameters.axis.y == 1);
  CHECK(std::get<MaterialItems<Phong>>(scene.materials).at(0).parameters.exp == 20);
}

TEST_CASE("a scene may name its integrator, anywhere at its root") {
  CHECK_FALSE(accepted(scene_with("")).integrator);
  for_each_type(Integrators{}, [&]<class T>(std::type_identity<T>) {
    const std::string element = "<integrator> <!-- --> <" + std::string(T::element) + "/> </integrator>";
    const auto scene = accepted(scene_with("<objects/>" + element + "<lights/>"));
    REQUIRE(scene.integrator);
    CHECK(scene.integrator->index() == index_of<T>(Integrators{}));
  });
  CHECK(contains(reported(scene_with("<integrator name='raycast'/>")), "unexpected attribute 'name' in <integrator>"));
}

TEST_CASE("the message for an element that stands elsewhere says where it belongs") {
  const std::vector<LayoutEntry> layout = scene_layout();
  for (const LayoutEntry& entry : layout) {
    for (const LayoutEntry& other : layout) {
      if (other.parent == entry.parent) continue;
      CHECK(explain_misplaced(entry.element, other.parent) ==
            tag(entry.element) + " does not belong in " + tag(other.parent) + "; put it into " + tag(entry.parent));
    }
    const std::string misspelt = std::string(entry.element) + "x";
    CHECK(explain_misplaced(misspelt, entry.parent) == "unknown element " + tag(misspelt) + " in " + tag(entry.parent) +
                                                           "; did you mean " + tag(entry.element) + "?");
  }
  CHECK(explain_misplaced("shpere", "objects") == "unknown element <shpere> in <objects>; did you mean <spheres>?");
  CHECK(explain_misplaced("directionalligth", "lights") ==
        "unknown element <directionalligth> in <lights>; did you mean <directionallights>?");
  CHECK(explain_misplaced("matt", "raytracer") ==
        "unknown element <matt> in <raytracer>; did you mean <matte>, which belongs in <mattes>?");
  CHECK(explain_misplaced("prism", "spheres") == "unknown element <prism> in <spheres>; it takes <sphere>");
}

TEST_CASE("a degenerate triangle is a warning and is left out, its name stays taken") {
  const std::string flat =
      "<triangle><name>flat</name><vertexposition1 x='0' y='0' z='0'/><vertexposition2 x='1' y='0' z='0'/>"
      "<vertexposition3 x='2' y='0' z='0'/><material>clay</material></triangle>";
  const std::string scene = scene_with("<objects><triangles>" + flat + "</triangles></objects>");
  CHECK(count<Triangle>(accepted(scene)) == 0);
  CHECK(reported(scene) == "s:2:21: warning: the triangle is degenerate (its corners lie on a line) and is left out\n");
  CHECK(contains(reported(scene_with("<objects><triangles>" + flat + flat + "</triangles></objects>")),
                 "error: the object name 'flat' is taken by the <triangle> in line 2; choose another\n"));
}

TEST_CASE("an object may have the name of a material, and names count by letter") {
  const std::string scene =
      scene_with_sphere("<name>clay</name><center x='0' y='0' z='0'/><radius>1</radius><material>clay</material>");
  CHECK(reported(scene) == "");
  CHECK(contains(reported(scene_with_sphere("<center x='0' y='0' z='0'/><radius>1</radius><material>Clay</material>")),
                 "unknown material 'Clay' in <sphere>; did you mean 'clay'?"));
}

TEST_CASE("of several things of one name each but the first is reported") {
  const std::string named =
      "<sphere><name>a</name><center x='0' y='0' z='0'/><radius>1</radius><material>clay</material></sphere>\n";
  const std::string found =
      reported(scene_with("<objects><spheres>\n" + named + named + named + "</spheres></objects>"));
  CHECK(found ==
        "s:4:15: error: the object name 'a' is taken by the <sphere> in line 3; choose another\n"
        "s:5:15: error: the object name 'a' is taken by the <sphere> in line 3; choose another\n");
}

TEST_CASE("a faulty material is no second fault for the objects that use it") {
  const std::string text = scene_with_sphere("<center x='0' y='0' z='0'/><radius>1</radius><material>clay</material>");
  std::string faulty = text;
  faulty.replace(faulty.find("<ka>0</ka>"), 10, "<ka>x</ka>");
  const std::string found = reported(faulty);
  CHECK(contains(found, "'x' in <ka> is not a number"));
  CHECK_FALSE(contains(found, "unknown material"));
}

TEST_CASE("what is only misspelt or misplaced is not reported as missing, too") {
  const std::string good = scene_with_sphere("<center x='0' y='0' z='0'/><radius>1</radius><material>clay</material>");
  const auto with = [&](const std::vector<std::pair<std::string, std::string>>& changes) {
    std::string text = good;
    for (const auto& [from, to] : changes) text.replace(text.find(from), from.size(), to);
    return reported(text);
  };
  REQUIRE(with({}).empty());
  CHECK(with({{"<viewplane>", "<viewPlane>"}, {"</viewplane>", "</viewPlane>"}}) ==
        "s:1:12: error: unknown element <viewPlane> in <raytracer>; did you mean <viewplane>?\n");
  CHECK(with({{"<camera>", "<cameras>"}, {"</camera>", "</cameras>"}}) ==
        "s:1:63: error: unknown element <cameras> in <raytracer>; did you mean <camera>?\n");
  CHECK(with({{"<viewplane>", "<lights><viewplane>"}, {"</viewplane>", "</viewplane></lights>"}}) ==
        "s:1:20: error: <viewplane> does not belong in <lights>; put it into <raytracer>\n");
  for (const char* const name : {"materials", "mattes", "matte"}) {
    const std::string element(name);
    const std::string found =
        with({{"<" + element + ">", "<" + element + "x>"}, {"</" + element + ">", "</" + element + "x>"}});
    INFO(found);
    CHECK(contains(found, "unknown element <" + element + "x> in"));
    CHECK_FALSE(contains(found, "unknown material"));
  }
  CHECK(contains(with({{"<materials><mattes>", "<mattes>"}, {"</mattes>", "</mattes><materials>"}}),
                 "<mattes> does not belong in <raytracer>; put it into <materials>\n"));
  const std::string unnamed = with({{"<name>clay</name>", "<nam>clay</nam>"}});
  CHECK(contains(unnamed, "unknown element <nam> in <matte>; did you mean <name>?"));
  CHECK_FALSE(contains(unnamed, "unknown material"));
  // What has nothing to do with it is reported all the same.
  CHECK(contains(with({{"<viewplane>", "<stuff/><viewplane>"}, {"<material>clay", "<material>cley"}}),
                 "unknown material 'cley'"));
  CHECK(contains(reported("<raytracer><stuff/></raytracer>"), "the scene has no <camera>; add one"));
}

TEST_CASE("a vector or colour that is written in another way is shown with its own numbers") {
  const auto center = [](const std::string& element) {
    return reported(scene_with_sphere(element + "<radius>1</radius><material>clay</material>"));
  };
  const std::string right = "<center x=\"0\" y=\"1\" z=\"-2.5\"/>";
  for (const char* const element :
       {"<center>0 1 -2.5</center>", "<center>0, 1, -2.5</center>", "<center>(0;1;-2.5)</center>",
        "<center>\n0\t1\n-2.5</center>", "<center><x>0</x><y>1</y><z>-2.5</z></center>",
        "<center><z>-2.5</z><x>0</x><y>1</y></center>", "<center value='0 1 -2.5'/>", "<center a='0' b='1' c='-2.5'/>",
        "<center x='0' y='1' depth='-2.5'/>", "<center x='0' y='1' z='-2.5' w='1'/>",
        "<center x='0' y='1'>-2.5</center>"})
    CHECK(contains(center(element), right));
  CHECK(contains(center("<center>$x 0 1e3</center>"), "<center x=\"$x\" y=\"0\" z=\"1e3\"/>"));
  CHECK(contains(center("<center x='0' z='5'/>"), "write <center x=\"0\" y=\"1\" z=\"5\"/>"));
  for (const char* const element : {"<center>here</center>", "<center>1 2</center>", "<center>1 2 3 4</center>"})
    CHECK(contains(center(element), "<center x=\"1\" y=\"1\" z=\"1\"/>"));
  CHECK(contains(center("<center><key frame='3'>0 1 -2.5</key></center>"),
                 "<key frame=\"3\" x=\"0\" y=\"1\" z=\"-2.5\"/>\n"));

  const auto color = [](const std::string& element) {
    return reported(scene_with("<lights><ambientlight>" + element + "</ambientlight></lights>"));
  };
  const std::string warm = "<color red=\"1\" green=\"0.5\" blue=\"0\"/>";
  for (const char* const element :
       {"<color>1 0.5 0</color>", "<color r='1' g='0.5' b='0'/>", "<color rgb='1, 0.5, 0'/>"})
    CHECK(contains(color(element), warm));
  CHECK(contains(color("<color>0.3</color>"), "<color red=\"0.3\" green=\"0.3\" blue=\"0.3\"/>"));
  CHECK(contains(color("<scaleradiance value='3'/>"),
                 "unexpected attribute 'value' in <scaleradiance>; write its value between its tags: "
                 "<scaleradiance>3</scaleradiance>\n"));
}

TEST_CASE("the root may name its schema, and nothing else") {
  std::string scene = scene_with("");
  scene.replace(0, 10,
                "<raytracer xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
                "xsi:noNamespaceSchemaLocation=\"raytracer.xsd\"");
  CHECK(reported(scene) == "");
  scene.replace(scene.find("2001"), 4, "2002");
  CHECK(contains(reported(scene), "s:1:12: error: unexpected attribute 'xmlns:xsi' in <raytracer>; remove it"));
}

TEST_CASE("the stray > of the seed's sample is a warning before every boolean, and an error elsewhere") {
  const auto lit = [](const std::string& shadows, const std::string& radiance) {
    return scene_with("<lights><pointlights><pointlight><location x='0' y='1' z='2'/><shadows>" + shadows +
                      "</shadows><scaleradiance>" + radiance + "</scaleradiance></pointlight></pointlights></lights>");
  };
  CHECK(reported(lit("> false", "1")) ==
        "s:2:72: warning: stray '>' before 'false' in <shadows> is ignored; remove it\n");
  CHECK_FALSE(std::get<LightItems<PointLight>>(accepted(lit(">false", "1")).lights).at(0).parameters.shadows);
  CHECK(contains(reported(lit("true", ">1")), "error: '>1' in <scaleradiance> is not a number"));
}

}  // namespace raytrace::test
