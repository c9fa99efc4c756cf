// Path tracing against closed forms, and its bits against themselves.
//
// Not with the thread sanitizer: statistics of code that cuts_test runs in threads.
#include <cmath>
#include <string>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

std::string with_integrator(std::string text, const std::string& integrator) {
  const std::string root = "<raytracer>";
  text.insert(text.find(root) + root.size(), "<integrator>" + integrator + "</integrator>");
  return text;
}

std::string path_of(int maxdepth) { return "<path><maxdepth>" + std::to_string(maxdepth) + "</maxdepth></path>"; }

struct Extremes {
  double least = 1e30, most = -1e30, mean = 0;
};

Extremes extremes(const FloatPicture& picture) {
  Extremes result;
  for (const Pixel& pixel : picture.pixels())
    for (const float channel : {pixel.red, pixel.green, pixel.blue}) {
      result.least = std::min(result.least, double{channel});
      result.most = std::max(result.most, double{channel});
      result.mean += double{channel} / (3 * static_cast<double>(picture.pixels().size()));
    }
  return result;
}

/// From inside a sphere of radius 1, or from outside at one.
std::string sphere_scene(const std::string& background, const std::string& eye, const std::string& lights,
                         const std::string& material, int samples) {
  return "<raytracer><viewplane><hres>12</hres><vres>12</vres><samples>" + std::to_string(samples) +
         "</samples><background red='" + background + "' green='" + background + "' blue='" + background +
         "'/></viewplane><camera><eye x='0' y='0.2' z='" + eye +
         "'/><lookat x='0.1' y='0' z='0'/><fov>50</fov></camera><lights>" + lights + "</lights><materials>" + material +
         "</materials><objects><spheres><sphere><center x='0' y='0' z='0'/><radius>1</radius>"
         "<material>m</material></sphere></spheres></objects></raytracer>";
}

std::string matte(double kd) {
  return "<mattes><matte><name>m</name><ka>0</ka><kd>" + std::to_string(kd) +
         "</kd><cd red='1' green='1' blue='1'/></matte></mattes>";
}

const std::string light_in_the_middle =
    "<pointlights><pointlight><location x='0' y='0' z='0'/><scaleradiance>3.14159265358979</scaleradiance>"
    "<color red='1' green='1' blue='1'/><falloff>inversesquare</falloff></pointlight></pointlights>";

}  // namespace

TEST_CASE("paths of one scattering are ray casting, to the last bit") {
  const std::string text = busy_scene(61, 47, GENERATE(1, 16));
  for (const std::string& isa : usable_isas()) {
    INFO(isa);
    CHECK(identical(rendered(parsed_scene(with_integrator(text, path_of(1))), 1, isa),
                    rendered(parsed_scene(with_integrator(text, "<raycast/>")), 1, isa)));
  }
}

TEST_CASE("in a sphere of albedo 1/2 about a light, radiance is 1 everywhere") {
  // pbrt's: half of it comes from the light, and half of that half from the sphere...
  const std::string scene = sphere_scene("0", "0.5", light_in_the_middle, matte(0.5), 256);
  for (const std::string& isa : usable_isas()) {
    const Extremes all = extremes(rendered(parsed_scene(with_integrator(scene, path_of(24))), 2, isa));
    INFO(isa << " " << all.least << " " << all.mean << " " << all.most);
    CHECK(std::abs(all.mean - 1) < 0.01);
    CHECK(all.least > 0.8);
    CHECK(all.most < 1.2);
  }
}

TEST_CASE("each scattering adds its own share") {
  const std::string scene = sphere_scene("0", "0.5", light_in_the_middle, matte(0.5), 64);
  double wanted = 0;
  for (int depth = 1; depth <= 3; ++depth) {
    wanted += std::pow(0.5, depth);
    std::string text = with_integrator(scene, path_of(depth));
    text.insert(text.find("</path>"), "<roulettedepth>9</roulettedepth>");
    const Extremes all = extremes(rendered(parsed_scene(text)));
    CHECK(std::abs(all.least - wanted) < 1e-4);
    CHECK(std::abs(all.most - wanted) < 1e-4);
  }
}

TEST_CASE("a white matte sphere under a white sky cannot be seen") {
  const Extremes all =
      extremes(rendered(parsed_scene(with_integrator(sphere_scene("1", "3", "", matte(1), 16), path_of(64)))));
  CHECK(all.least > 1 - 1e-5);
  CHECK(all.most < 1 + 1e-5);
}

TEST_CASE("a Phong sphere reflects no more of a white sky than it gets, and the share that its lobes say") {
  const std::string phong =
      "<phongs><phong><name>m</name><ka>0</ka><kd>0.4</kd><ks>0.1</ks><cd red='1' green='1' blue='1'/>"
      "<cs red='1' green='1' blue='1'/><exp>8</exp></phong></phongs>";
  // Straight on, where no part of the lobe is below the surface: kd + 2 pi ks / (exp + 2).
  std::string text = with_integrator(sphere_scene("1", "400", "", phong, 4096), path_of(4));
  const std::string fov = "<fov>50</fov>";
  text.replace(text.find(fov), fov.size(), "<fov>0.01</fov>");
  const Extremes all = extremes(rendered(parsed_scene(text), 2));
  const double cosine_mean = 2 * 3.14159265358979 * 0.1 / (8 + 2);
  INFO(all.mean);
  CHECK(std::abs(all.mean - (0.4 + cosine_mean)) < 0.01);
}

TEST_CASE("a white matte sphere in a shining one cannot be seen, and the outer one shines to its front alone") {
  const auto mean = [](const std::string& twosided) {
    std::string text = with_integrator(
        sphere_scene("0", "3", "",
                     matte(1) + "<emissives><emissive><name>sky</name><ce red='1' green='1' blue='1'/>" + twosided +
                         "</emissive></emissives>",
                     256),
        path_of(64));
    const std::string end = "</spheres>";
    text.insert(text.find(end),
                "<sphere><center x='0' y='0' z='0'/><radius>9</radius><material>sky</material></sphere>");
    return extremes(rendered(parsed_scene(text)));
  };
  const Extremes all = mean("<twosided>true</twosided>"), none = mean("");
  CHECK(std::abs(all.mean - 1) < 0.005);  // light is drawn, so samples differ
  CHECK(all.least > 0.9);
  CHECK(all.most < 1.1);
  CHECK(none.most == 0);
}

TEST_CASE("a path does not depend on threads, samples at once, or how the picture is cut") {
  std::string text = with_integrator(busy_scene(61, 47, 16), path_of(5));
  if (GENERATE(false, true)) text.insert(text.find("</matte>"), "<opacity>0.6</opacity>");
  const SceneDescription description = parsed_scene(text);
  check_same_bits(description);
}

}  // namespace raytrace::test
