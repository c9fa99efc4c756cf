// What scenes may have but hardly mean: warnings, each with its line and column and what to write instead.
#include <sstream>

#include "raytrace/description/check_scene.h"
#include "reported.h"
#include "support/catch.h"
#include "support/contains.h"

namespace raytrace::test {

namespace {

std::string scene_of_materials(const std::string& more) { return scene_with("<materials>" + more + "</materials>"); }

std::string scene_of_matte(const std::string& kd, const std::string& cd) {
  return scene_of_materials("<mattes><matte><name>m</name><ka>1</ka>" + kd + cd + "</matte></mattes>");
}

std::string scene_of_openpbr(const std::string& fields) {
  return scene_of_materials("<openpbrs><openpbr><name>m</name>" + fields + "</openpbr></openpbrs>");
}

std::string scene_of_fog(const std::string& objects) {
  return scene_with(
      "<materials><fogs><fog><name>mist</name><meanfreepath>1</meanfreepath></fog></fogs></materials>"
      "<objects>" +
      objects + "</objects>");
}

const std::string disks =
    "<disks><disk><center x='0' y='0' z='0'/><normal x='0' y='1' z='0'/><radius>1</radius><material>mist</material>"
    "</disk></disks>";
std::string cylinder(const std::string& caps) {
  return "<cylinders><cylinder><bottom x='0' y='0' z='0'/><top x='0' y='1' z='0'/><radius>1</radius>" + caps +
         "<material>mist</material></cylinder></cylinders>";
}

/// What loading the meshes of a scene with these objects says.
std::string said_of(const std::string& materials, const std::string& objects, const std::string& more = "") {
  SceneDescription scene =
      accepted(scene_with("<materials>" + materials + "</materials><objects>" + objects + "</objects>" + more));
  Diagnostics diagnostics("s");
  CHECK(load_meshes(scene, diagnostics));
  std::ostringstream out;
  diagnostics.print(out);
  return out.str();
}

}  // namespace

TEST_CASE("a surface that gives more light than it gets has a warning") {
  CHECK(reported(scene_of_matte("<kd>1</kd>", "<cd red='1' green='1' blue='1'/>")).empty());
  CHECK(reported(scene_of_matte("<kd>0.7</kd>", "<cd red='1.42857142857143' green='0' blue='0'/>")).empty());
  CHECK(reported(scene_of_matte("<kd>0.1</kd>", "<cd red='9' green='0' blue='0'/>")).empty());
  CHECK(reported(scene_of_matte("<kd>0.8</kd>", "<cd red='2' green='1' blue='0'/>")) ==
        "s:2:63: warning: <kd> times <cd> is 1.6, above 1: light grows where it is reflected; write "
        "<cd red=\"1\" green=\"0.5\" blue=\"0\"/>\n");
  CHECK(reported(scene_of_matte("<kd>80</kd>", "<cd red='0.5' green='0.5' blue='0.5'/>")) ==
        "s:2:51: warning: <kd> times <cd> is 40, above 1: light grows where it is reflected; write <kd>1</kd>\n");
  CHECK(contains(reported(scene_of_matte("<kd>2</kd>", "<cd red='2' green='-1' blue='1'/>")),
                 "write <cd red=\"1\" green=\"0\" blue=\"0.5\"/> and <kd>1</kd>\n"));
  CHECK(contains(reported(scene_of_matte("<kd>1</kd>", "<cd red='255' green='128' blue='0'/>")),
                 "write <cd red=\"1\" green=\"0.2159\" blue=\"0\"/>, the linear values of that sRGB colour\n"));
}

TEST_CASE("what a texture multiplies has no warning, since the texture says the rest") {
  const std::string checkers =
      "<textures><checkers><checker><name>t</name><color1 red='0' green='0' blue='0'/>"
      "<color2 red='0.1' green='0.1' blue='0.1'/></checker></checkers></textures>";
  const std::string text = scene_of_matte("<kd>1</kd>", "<cd red='2' green='2' blue='2' texture='t'/>");
  CHECK(reported(text.substr(0, text.find('\n') + 1) + checkers + text.substr(text.find('\n') + 1)).empty());
}

TEST_CASE("all materials that reflect have that warning") {
  const auto has_warning = [](const std::string& text, const std::string& of) {
    return contains(reported(text), ": warning: " + of + " is 3, above 1");
  };
  const std::string three = " red='3' green='0' blue='0'/>", one = " red='1' green='0' blue='0'/>";
  const auto with = [&](const std::string& type, const std::string& fields) {
    return scene_of_materials("<" + type + "s><" + type + "><name>m</name>" + fields + "</" + type + "></" + type +
                              "s>");
  };
  CHECK(has_warning(with("phong", "<ka>0</ka><kd>1</kd><ks>0</ks><cd" + three + "<cs" + one), "<kd> times <cd>"));
  CHECK(has_warning(with("mirror", "<cr" + three), "<cr>"));
  CHECK(has_warning(with("conductor", "<cr" + three), "<cr>"));
  CHECK(has_warning(with("conductor", "<cr" + one + "<edgecolor" + three), "<edgecolor>"));
  CHECK(has_warning(with("dielectric", "<cr" + three), "<cr>"));
  CHECK(has_warning(with("dielectric", "<ct" + three), "<ct>"));
  CHECK(has_warning(with("openpbr", "<base_color" + three), "<base_weight> times <base_color>"));
  CHECK(has_warning(with("openpbr", "<specular_color" + three), "<specular_color>"));
  CHECK(has_warning(with("openpbr", "<fuzz_weight>1</fuzz_weight><fuzz_color" + three),
                    "<fuzz_weight> times <fuzz_color>"));
  // What is not seen.
  CHECK(reported(with("openpbr", "<fuzz_color" + three)).empty());
  CHECK(reported(with("openpbr", "<transmission_weight>1</transmission_weight><base_color" + three)).empty());
}

TEST_CASE("a film whose thickness is one in nanometres has a warning") {
  CHECK(reported(scene_of_openpbr("<thin_film_thickness>20</thin_film_thickness>")).empty());
  CHECK(reported(scene_of_openpbr("<thin_film_thickness>550</thin_film_thickness>")) ==
        "s:2:45: warning: <thin_film_thickness> is in micrometres, of which 550 have no colours; of so many nanometres "
        "write <thin_film_thickness>0.55</thin_film_thickness>\n");
}

TEST_CASE("a fog of a single object that has no inside has a warning") {
  CHECK(reported(scene_of_fog(disks)) ==
        "s:2:111: warning: a <fog> in a <disk>, which has no inside; put it into a closed object, such as a <box>\n");
  CHECK(contains(reported(scene_of_fog(cylinder(""))),
                 "a <fog> in a <cylinder>, which has no inside; close it by <caps>true</caps>\n"));
  CHECK(reported(scene_of_fog(cylinder("<caps>true</caps>"))).empty());
  CHECK(reported(scene_of_fog(cylinder("") + disks)).empty());  // they may be a glass
  CHECK(reported(scene_of_fog("<planes><plane><point x='0' y='0' z='0'/><normal x='0' y='1' z='0'/>"
                              "<material>mist</material></plane></planes>"))
            .empty());  // all below it
}

TEST_CASE("a mesh of glass that is inside out has a warning") {
  const auto tetrahedron = [](const std::string& faces, const std::string& more) {
    return "<mesh><positions>0 0 0, 1 0 0, 0 1 0, 0 0 1</positions><faces>" + faces + "</faces>" + more +
           "<material>m</material></mesh>";
  };
  const auto said = [](const std::string& material, const std::string& meshes) {
    return said_of(material, "<meshes>" + meshes + "</meshes>");
  };
  const std::string glass = "<dielectrics><dielectric><name>m</name></dielectric></dielectrics>";
  const std::string outwards = "0 2 1, 0 1 3, 0 3 2, 1 2 3", inwards = "0 1 2, 0 3 1, 0 2 3, 1 3 2";
  const std::string mirrored = "<transform><scale x='-1' y='1' z='1'/></transform>";
  const std::string larger = "<transform><translate x='-0.2' y='-0.2' z='-0.2'/><scale x='9' y='9' z='9'/></transform>";
  CHECK(said(glass, tetrahedron(inwards, "")) ==
        "s:2:107: warning: the fronts of the mesh's faces are inside: as glass it is inside out; give its faces the "
        "other order of corners, counter-clockwise where they are looked at from outside\n");
  CHECK(contains(said(glass, tetrahedron(inwards, mirrored)), "inside out"));
  CHECK(contains(
      said("<openpbrs><openpbr><name>m</name><transmission_weight>1</transmission_weight></openpbr></openpbrs>",
           tetrahedron(inwards, "")),
      "inside out"));
  CHECK(said(glass, tetrahedron(outwards, "")).empty());
  CHECK(said(glass, tetrahedron(outwards, mirrored)).empty());
  CHECK(said(glass, tetrahedron("0 1 2, 0 3 1, 0 2 3", "")).empty());                    // open
  CHECK(said(glass, tetrahedron(outwards, larger) + tetrahedron(inwards, "")).empty());  // a bubble
  CHECK(said_of(glass,
                "<spheres><sphere><center x='0' y='0' z='0'/><radius>3</radius><material>m</material></sphere>"
                "</spheres><meshes>" +
                    tetrahedron(inwards, "") + "</meshes>")
            .empty());
  CHECK(contains(said(glass, tetrahedron(inwards, "") + tetrahedron(inwards, "")), "inside out"));
  CHECK(said("<dielectrics><dielectric><name>m</name><thinwalled>true</thinwalled></dielectric></dielectrics>",
             tetrahedron(inwards, ""))
            .empty());
  CHECK(said("<mirrors><mirror><name>m</name><cr red='1' green='1' blue='1'/></mirror></mirrors>",
             tetrahedron(inwards, ""))
            .empty());
}

TEST_CASE("a pane of solid glass under a sun has a warning, unless something brings its light") {
  const std::string glass = "<dielectrics><dielectric><name>m</name></dielectric></dielectrics>";
  const std::string sun =
      "<lights><directionallights><directionallight><direction x='0' y='1' z='1'/></directionallight>"
      "</directionallights></lights>";
  const auto box = [](const std::string& thickness) {
    return "<boxes><box><min x='0' y='0' z='0'/><max x='1' y='1.5' z='" + thickness +
           "'/><material>m</material></box></boxes>";
  };
  CHECK(
      said_of(glass, box("0.02"), sun) ==
      "s:2:106: warning: suns, points and spots do not shine through what is flat and of solid glass; let the material "
      "of a pane be thin-walled, or give <path> <caustics>light</caustics>\n");
  const std::string mesh =
      "<meshes><mesh><positions>0 0 0, 1 0 0, 0 1 0, 0 0 0.01</positions><faces>0 2 1, 0 1 3, 0 3 2, 1 2 3</faces>"
      "<material>m</material></mesh></meshes>";
  CHECK(contains(said_of(glass, mesh, sun), "what is flat and of solid glass"));
  CHECK(said_of(glass, box("0.02")).empty());
  CHECK(said_of("<dielectrics><dielectric><name>m</name><roughness>0.3</roughness></dielectric></dielectrics>",
                box("0.02"), sun)
            .empty());
  CHECK(said_of(glass, box("0.5"), sun).empty());
  const std::string flattened =
      "<boxes><box><min x='0' y='0' z='0'/><max x='1' y='1' z='1'/><material>m</material>"
      "<transform><scale x='1' y='1' z='0.01'/></transform></box></boxes>";
  CHECK(contains(said_of(glass, flattened, sun), "what is flat and of solid glass"));
  CHECK(contains(said_of("<openpbrs><openpbr><name>m</name><transmission_weight>0.9</transmission_weight>"
                         "<specular_roughness>0</specular_roughness></openpbr></openpbrs>",
                         box("0.02"), sun),
                 "what is flat and of solid glass"));
  CHECK(said_of(glass,
                "<meshes><mesh><positions>0 0 0, 9 0 0, 9 0 9, 0 0 9</positions><faces>0 3 2 1</faces><material>m"
                "</material></mesh></meshes>",
                sun)
            .empty());  // water
  for (const char* const integrator : {"<path><caustics>light</caustics></path>", "<raycast/>"})
    CHECK(said_of(glass, box("0.02"), sun + "<integrator>" + integrator + "</integrator>").empty());
  CHECK(said_of("<dielectrics><dielectric><name>m</name><thinwalled>true</thinwalled></dielectric></dielectrics>",
                box("0.02"), sun)
            .empty());
}

TEST_CASE("items that are read by a pattern have their warnings, too") {
  std::string mattes;
  for (int i = 0; i < 100; ++i)
    mattes += "<matte><name>m" + std::to_string(i) + "</name><ka>1</ka><kd>" + (i % 10 == 9 ? "2" : "1") +
              "</kd><cd red='1' green='1' blue='1'/></matte>\n";
  Diagnostics diagnostics("s");
  CHECK(parse_scene(scene_of_materials("<mattes>" + mattes + "</mattes>"), diagnostics));
  CHECK(diagnostics.warning_count() == 10);
}

TEST_CASE("a program's description has the same warnings, and no error by them") {
  const SceneDescription scene = accepted(scene_of_matte("<kd>2</kd>", "<cd red='1' green='1' blue='1'/>"));
  Diagnostics diagnostics("s");
  check_scene(scene, diagnostics);
  REQUIRE(diagnostics.kept().size() == 1);
  CHECK(diagnostics.kept()[0].message ==
        "<matte> [1]: <kd> times <cd> is 2, above 1: light grows where it is reflected; write <kd>1</kd>");
  CHECK_NOTHROW(require_good_scene(scene));
}

}  // namespace raytrace::test
