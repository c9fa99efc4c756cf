// AOVs for denoisers: what paths meet behind mirrors and glass.
//
// Not with the thread sanitizer: code that cuts_test runs in threads.
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

#include "render/scenes.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

/// Of the picture's only pixel.
struct Features {
  std::array<double, 3> albedo{}, normal{};
};

Features features_of(const std::string& integrator, int samples, const std::string& materials,
                     const std::string& objects, const std::string& more = "") {
  const SceneDescription description =
      parsed_scene("<raytracer><integrator>" + integrator + "</integrator><viewplane><hres>1</hres><vres>1</vres>" +
                   "<pixelsize>0.001</pixelsize><samples>" + std::to_string(samples) + "</samples></viewplane>" +
                   "<orthographiccamera><eye x='0' y='0' z='5'/><lookat x='0' y='0' z='0'/></orthographiccamera>" +
                   more + "<materials>" + materials + "</materials><objects>" + objects + "</objects></raytracer>");
  const ImageBand band = picture_aovs(description, {"denoise_albedo", "denoise_normal"});
  Features features;
  for (std::size_t i = 0; i < 3; ++i) {
    features.albedo[i] = std::get<std::vector<float>>(band.planes[i])[0];
    features.normal[i] = std::get<std::vector<float>>(band.planes[3 + i])[0];
  }
  return features;
}

void check(const std::array<double, 3>& got, const std::array<double, 3>& wanted, double margin = 1e-5) {
  for (std::size_t i = 0; i < 3; ++i) CHECK(got[i] == Approx(wanted[i]).margin(margin));
}

const std::string path = "<path/>", branching_path = "<path><indirectsamples>3</indirectsamples></path>";
const std::string wall_material =
    "<mattes><matte><name>wall</name><ka>1</ka><kd>0.5</kd><cd red='0.8' green='0.4' blue='0.2'/></matte></mattes>";
const std::array<double, 3> wall_albedo{0.4, 0.2, 0.1};

/// Which turns rays along -z towards +x.
const std::string tilted =
    "<planes><plane><point x='0' y='0' z='0'/><normal x='1' y='0' z='1'/><material>m</material>"
    "</plane></planes>";
/// Across the way there.
const std::string wall_aside =
    "<disks><disk><center x='10' y='0' z='0'/><normal x='1' y='0' z='0'/><radius>3</radius>"
    "<material>wall</material></disk></disks>";
const std::string wall_behind =
    "<disks><disk><center x='0' y='0' z='-9'/><normal x='0' y='0' z='1'/><radius>3</radius>"
    "<material>wall</material></disk></disks>";

std::string mirror(const std::string& color) {
  return "<mirrors><mirror><name>m</name><cr " + color + "/></mirror></mirrors>";
}

}  // namespace

TEST_CASE("what a mirror shows is followed, in the mirror's colour") {
  const Features seen = features_of(GENERATE(path, branching_path), 16,
                                    wall_material + mirror("red='0.5' green='1' blue='0.25'"), tilted + wall_aside);
  check(seen.albedo, {0.2, 0.2, 0.025});
  check(seen.normal, {-1, 0, 0});
}

TEST_CASE("a mirror that shows nothing is itself") {
  const Features seen = features_of(path, 16, mirror("red='0.5' green='1' blue='0.25'"), tilted);
  check(seen.albedo, {0.5, 1, 0.25});
  check(seen.normal, {0.70711, 0, 0.70711});
}

TEST_CASE("a way that is too long ends at its last mirror") {
  const std::string facing =
      "<disks><disk><center x='0' y='0' z='-1'/><normal x='0' y='0' z='1'/><radius>1</radius>"
      "<material>m</material></disk><disk><center x='0' y='0' z='9'/><normal x='0' y='0' z='1'/>"
      "<radius>1</radius><material>m</material></disk></disks>";
  const Features seen =
      features_of("<path><maxdepth>2</maxdepth></path>", 16, mirror("red='0.5' green='0.5' blue='0.5'"), facing);
  check(seen.albedo, {0.25, 0.25, 0.25});  // at the second, for there is nothing that shines
  check(seen.normal, {0, 0, -1});
}

TEST_CASE("through a ball of glass, both walls show in the parts that its surface sends there") {
  const std::string ball =
      "<spheres><sphere><center x='0' y='0' z='0'/><radius>1</radius><material>m</material>"
      "</sphere></spheres>";
  const std::string glass = "<dielectrics><dielectric><name>m</name><ior>1.5</ior></dielectric></dielectrics>";
  const Features seen = features_of(path, 4096, wall_material + glass, ball + wall_behind);
  // 0.04 is reflected at each surface: 0.9231 of all arrive at the wall, the others at the eye's side, where nothing
  // is; they end at the glass, whose albedo is 1 and whose normal is against the ray that left it, either way.
  const double through = 0.96 / 1.04;
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(seen.albedo[i] == Approx(through * wall_albedo[i] + (1 - through)).margin(0.01));
  CHECK(seen.normal[2] > 0.85);
}

TEST_CASE("rough metal, matte surfaces and what shines are what is seen") {
  const std::string metal =
      "<conductors><conductor><name>m</name><cr red='0.9' green='0.6' blue='0.3'/>"
      "<roughness>0.3</roughness></conductor></conductors>";
  check(features_of(path, 16, wall_material + metal, tilted + wall_aside).albedo, {0.9, 0.6, 0.3});
  const std::string lamp = "<emissives><emissive><name>m</name><ce red='1' green='1' blue='1'/></emissive></emissives>";
  const Features seen = features_of(path, 16, wall_material + lamp, tilted + wall_aside);
  check(seen.albedo, {0, 0, 0});
  check(seen.normal, {0.70711, 0, 0.70711});
}

TEST_CASE("other integrators give what rays meet first") {
  const Features seen =
      features_of("<normals/>", 16, wall_material + mirror("red='0.5' green='1' blue='0.25'"), tilted + wall_aside);
  check(seen.albedo, {0.5, 1, 0.25});
  check(seen.normal, {0.70711, 0, 0.70711});
}

TEST_CASE("what fog scatters shows nothing, and the rest what is behind it") {
  const std::string fog = "<fogs><fog><name>fog</name><meanfreepath>4</meanfreepath></fog></fogs>";
  const std::string box =
      "<boxes><box><min x='-5' y='-5' z='-4'/><max x='5' y='5' z='0'/><material>fog</material>"
      "</box></boxes>";
  const Features seen =
      features_of("<path><maxdepth>1</maxdepth></path>", 4096, wall_material + fog, box + wall_behind);
  const double clear = std::exp(-1.0);
  check(seen.albedo, {0.4 * clear, 0.2 * clear, 0.1 * clear}, 0.01);
  check(seen.normal, {0, 0, clear}, 0.025);
}

}  // namespace raytrace::test
