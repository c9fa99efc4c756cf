// Clay: which materials become it, what is left of them, and what stays.
#include "raytrace/description/clay.h"

#include <string>

#include "support/catch.h"
#include "support/parsed_scene.h"

namespace raytrace::test {

namespace {

const std::string textures = "<textures><checkers><checker><name>squares</name></checker></checkers></textures>";

std::string scene_of(const std::string& materials, const std::string& of_ball = "wall",
                     const std::string& integrator = "<path/>") {
  return "<raytracer>" + (integrator.empty() ? "" : "<integrator>" + integrator + "</integrator>") +
         "<viewplane><hres>4</hres><vres>4</vres></viewplane><camera><eye x='0' y='0' z='5'/>"
         "<lookat x='0' y='0' z='0'/><fov>40</fov></camera>" +
         textures + "<materials>" + materials +
         "</materials><groups><group><name>g</name><objects><spheres><sphere><center x='0' y='0' z='0'/>"
         "<radius>1</radius><material>" +
         of_ball +
         "</material></sphere></spheres></objects></group></groups><objects><spheres><sphere>"
         "<center x='3' y='0' z='0'/><radius>1</radius><material>" +
         of_ball +
         "</material></sphere></spheres><instances><instance><group>g</group></instance><instance><group>g</group>"
         "<material>" +
         of_ball + "</material></instance></instances></objects></raytracer>";
}

std::string clay_of(const std::string& materials, const std::string& of_ball = "wall",
                    const std::vector<std::string>& kept = {}) {
  SceneDescription scene = parsed_scene(scene_of(materials, of_ball));
  const OptionalMessage problem = make_clay(scene, kept);
  INFO(problem.value_or(""));
  REQUIRE_FALSE(problem);
  return print_scene(scene);
}

std::string printed(const std::string& materials, const std::string& of_ball = "wall") {
  return print_scene(parsed_scene(scene_of(materials, of_ball)));
}

/// As it is written by hand.
std::string clay(const std::string& name, const std::string& opacity = "") {
  return "<matte><name>" + name + "</name><ka>1</ka><kd>1</kd><cd red='0.5' green='0.5' blue='0.5'/>" + opacity +
         "</matte>";
}

const std::string relief = "<normalmap texture='squares'/><bump texture='squares' height='0.1'/>";
const std::string wall_of_clay = "<mattes>" + clay("wall") + "</mattes>";

}  // namespace

TEST_CASE("what is opaque becomes grey clay without textures, gloss and relief, wherever it is") {
  for (const std::string& wall :
       {"<mattes><matte><name>wall</name><ka>0.25</ka><kd>0.2</kd><cd red='1' green='0' blue='0' texture='squares'/>" +
            relief + "</matte></mattes>",
        "<phongs><phong><name>wall</name><ka>0.25</ka><kd>0.2</kd><cd red='1' green='0' blue='0'/><ks>0.5</ks>"
        "<cs red='1' green='1' blue='1'/><exp>20</exp>" +
            relief + "</phong></phongs>",
        std::string("<mirrors><mirror><name>wall</name><cr red='1' green='1' blue='1'/></mirror></mirrors>"),
        std::string("<conductors><conductor><name>wall</name><metal>gold</metal></conductor></conductors>"),
        "<openpbrs><openpbr><name>wall</name><base_color red='1' green='0' blue='0' texture='squares'/>"
        "<coat_weight>1</coat_weight><subsurface_weight>0.5</subsurface_weight>" +
            relief + "</openpbr></openpbrs>",
        // Of metals nothing comes through, whatever they say.
        std::string("<openpbrs><openpbr><name>wall</name><base_metalness>1</base_metalness><transmission_weight>1"
                    "</transmission_weight></openpbr></openpbrs>"),
        // What has a luminance and no colour does not shine.
        std::string("<openpbrs><openpbr><name>wall</name><emission_luminance>1</emission_luminance>"
                    "<emission_color red='0' green='0' blue='0'/></openpbr></openpbrs>")}) {
    INFO(wall);
    CHECK(clay_of(wall) == printed(wall_of_clay));
  }
}

TEST_CASE("clay reflects of ambient light what its material did, to what it scatters") {
  const auto matte = [](const std::string& ka, const std::string& kd, const std::string& cd) {
    return "<mattes><matte><name>wall</name><ka>" + ka + "</ka><kd>" + kd + "</kd><cd red='" + cd + "' green='" + cd +
           "' blue='" + cd + "'/></matte></mattes>";
  };
  CHECK(clay_of(matte("0.125", "0.5", "1")) == printed(matte("0.25", "1", "0.5")));
  CHECK(clay_of(matte("0.5", "0", "1")) == printed(matte("1", "1", "0.5")));
}

TEST_CASE("clay has the holes that a material's opacity cuts") {
  const std::string holes = "<opacity texture='squares' channel='green'>0.7</opacity>";
  const std::string wanted = printed("<mattes>" + clay("wall", holes) + "</mattes>");
  CHECK(clay_of("<openpbrs><openpbr><name>wall</name>" + holes + relief + "</openpbr></openpbrs>") == wanted);
  CHECK(clay_of("<mirrors><mirror><name>wall</name><cr red='1' green='1' blue='1'/>" + holes + relief +
                "</mirror></mirrors>") == wanted);
}

TEST_CASE("what shines, clear glass and fogs stay as they are") {
  for (const std::string& wall :
       {"<emissives><emissive><name>wall</name><ce red='1' green='0' blue='0' texture='squares'/>" + relief +
            "</emissive></emissives>",
        "<dielectrics><dielectric><name>wall</name>" + relief + "</dielectric></dielectrics>",
        std::string("<fogs><fog><name>wall</name><color red='1' green='1' "
                    "blue='1'/><meanfreepath>1</meanfreepath></fog></fogs>"),
        "<openpbrs><openpbr><name>wall</name><transmission_weight texture='squares'>0.1</transmission_weight>"
        "<coat_weight>1</coat_weight>" +
            relief + "</openpbr></openpbrs>",
        std::string("<openpbrs><openpbr><name>wall</name><base_metalness texture='squares'/><transmission_weight>1"
                    "</transmission_weight></openpbr></openpbrs>")}) {
    INFO(wall);
    CHECK(clay_of(wall) == printed(wall));
  }
}

TEST_CASE("an openpbr that shines in places keeps its light, and is clay otherwise") {
  const std::string light =
      "<emission_luminance>3</emission_luminance><emission_color red='1' green='0.5' blue='0' texture='squares'/>"
      "<geometry_thin_walled>true</geometry_thin_walled><group>eyes</group><opacity texture='squares'>0.5</opacity>";
  const auto openpbr = [&](const std::string& base) {
    return "<openpbrs><openpbr><name>wall</name>" + base + light + "</openpbr></openpbrs>";
  };
  CHECK(clay_of(openpbr("<base_color red='1' green='0' blue='0' texture='squares'/><base_metalness>1</base_metalness>" +
                        relief)) ==
        printed(openpbr("<base_color red='0.5' green='0.5' blue='0.5'/><specular_weight>0</specular_weight>")));
  // glTF's unlit pictures reflect nothing.
  CHECK(clay_of(openpbr("<base_weight>0</base_weight><specular_weight>0</specular_weight>")) ==
        printed(openpbr("<base_weight>0</base_weight><base_color red='0.5' green='0.5' blue='0.5'/>"
                        "<specular_weight>0</specular_weight>")));
}

TEST_CASE("materials that are named stay, and each object has its own") {
  const std::string
      gold = "<conductors><conductor><name>gold</name><metal>gold</metal></conductor></conductors>",
      mirror =
          "<mirrors><mirror><name>wall</name><cr red='1' green='1' blue='1'/></mirror><mirror><name>other</name><cr "
          "red='1' green='1' blue='1'/></mirror></mirrors>",
      bright =
          "<mattes><matte><name>bright</name><ka>1</ka><kd>1</kd><cd red='1' green='1' blue='1'/>"
          "</matte></mattes>";
  CHECK(clay_of(bright + gold + mirror, "gold", {"gold", "other"}) ==
        printed("<mattes>" + clay("bright") + clay("wall") + "</mattes>" + gold +
                    "<mirrors><mirror><name>other</name><cr red='1' green='1' blue='1'/></mirror></mirrors>",
                "gold"));
  SceneDescription scene = parsed_scene(scene_of(bright + gold + mirror));
  const std::string before = print_scene(scene);
  CHECK(make_clay(scene, {"gold", "othr"}).value_or("") == "there is no material 'othr'; did you mean 'other'?");
  CHECK(make_clay(scene, {"something"}).value_or("") ==
        "there is no material 'something'; there are 'bright', 'wall', 'other', 'gold'");
  CHECK(print_scene(scene) == before);
}

TEST_CASE("a scene has the integrator in clay that it has without") {
  const auto is_path = [](const std::string& materials) {
    SceneDescription scene = parsed_scene(scene_of(materials, "wall", ""));
    REQUIRE_FALSE(make_clay(scene));
    return std::holds_alternative<Path::Parameters>(scene.integrator.value());
  };
  CHECK(is_path("<mirrors><mirror><name>wall</name><cr red='1' green='1' blue='1'/></mirror></mirrors>"));
  CHECK_FALSE(is_path(wall_of_clay));
}

}  // namespace raytrace::test
