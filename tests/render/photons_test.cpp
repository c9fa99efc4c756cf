// Photons: what they bring against closed forms, and against paths from the camera that chance to meet the lamps.
//
// Not with the thread sanitizer: statistics of code that cuts_test runs in threads.
#include "raytrace/film/photons.h"

#include <atomic>
#include <cmath>
#include <numbers>
#include <string>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/sanitized.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

std::string with_path(const std::string& path, int width, int height, int samples, const std::string& rest) {
  return "<raytracer><integrator><path>" + path + "</path></integrator><viewplane><hres>" + std::to_string(width) +
         "</hres><vres>" + std::to_string(height) + "</vres><samples>" + std::to_string(samples) +
         "</samples></viewplane>" + rest + "</raytracer>";
}

const std::string floor_matte =
    "<mattes><matte><name>floor</name><ka>0</ka><kd>1</kd><cd red='0.5' green='0.5' blue='0.5'/></matte></mattes>";

/// A camera that sees a floor in a mirror above it, which shows it a lamp below the mirror as well.
std::string floor_in_mirror(const std::string& path, const std::string& lights) {
  return with_path(path, 24, 16, 256,
                   "<camera><eye x='0' y='1' z='0'/><lookat x='0' y='2' z='0'/><up x='0' y='0' z='-1'/><fov>30</fov>"
                   "</camera><lights>" +
                       lights + "</lights><materials>" + floor_matte +
                       "<mirrors><mirror><name>mirror</name><cr red='0.8' green='0.8' blue='0.8'/></mirror></mirrors>"
                       "</materials><objects><planes><plane><point x='0' y='0' z='0'/><normal x='0' y='1' z='0'/>"
                       "<material>floor</material></plane></planes><rectangles><rectangle><corner x='-9' y='3' z='-9'/>"
                       "<edge1 x='18' y='0' z='0'/><edge2 x='0' y='0' z='18'/><material>mirror</material></rectangle>"
                       "</rectangles></objects>");
}

/// A box of glass on a floor, with a ball in it, and a lamp above.
std::string ball_in_glass(const std::string& path, int samples, const std::string& ball_material,
                          const std::string& lights = "") {
  const std::string lamp =
      lights.empty() ? "<sphere><center x='1' y='4' z='-1'/><radius>0.8</radius><material>lamp</material></sphere>"
                     : "";
  return with_path(
      path, 20, 16, samples,
      "<camera><eye x='0' y='3' z='4'/><lookat x='0' y='0.3' z='0'/><fov>30</fov></camera><lights>" + lights +
          "</lights><materials>" + floor_matte +
          "<phongs><phong><name>varnish</name><ka>0</ka><kd>0.5</kd><ks>0.3</ks><exp>8</exp>"
          "<cd red='0.7' green='0.7' blue='0.7'/><cs red='1' green='1' blue='1'/></phong></phongs>"
          "<emissives><emissive><name>lamp</name><ce red='1' green='1' blue='1'/><scaleradiance>10</scaleradiance>"
          "</emissive></emissives><mattes><matte><name>veil</name><ka>0</ka><kd>1</kd><opacity>0.4</opacity>"
          "<cd red='0.8' green='0.8' "
          "blue='0.8'/></matte></mattes><dielectrics><dielectric><name>glass</name></dielectric></"
          "dielectrics><openpbrs>"
          "<openpbr><name>wax</name><base_color red='0.8' green='0.8' blue='0.8'/><subsurface_weight>1"
          "</subsurface_weight><subsurface_color red='0.8' green='0.8' blue='0.8'/><subsurface_radius>0.05"
          "</subsurface_radius></openpbr><openpbr><name>lacquer</name><base_color red='0.6' green='0.6' blue='0.6'/>"
          "<specular_roughness>0.4</specular_roughness><coat_weight>0.5</coat_weight></openpbr><openpbr><name>gloss</"
          "name>"
          "<base_color red='0.6' green='0.6' blue='0.6'/><specular_roughness>0.1</specular_roughness><coat_weight>0.5"
          "</coat_weight><coat_roughness>0.2</coat_roughness></openpbr></openpbrs></materials>"
          "<objects><boxes><box><min x='-1' y='-0.1' z='-1'/><max x='1' y='1' z='1'/><material>glass</material></box>"
          "</boxes><rectangles><rectangle><corner x='-6' y='0' z='6'/><edge1 x='12' y='0' z='0'/><edge2 x='0' y='0' "
          "z='-12'/><material>floor</material></rectangle></rectangles><spheres><sphere><center x='0.1' y='0.45' "
          "z='0'/>"
          "<radius>0.4</radius><material>" +
          ball_material + "</material></sphere>" + lamp + "</spheres></objects>");
}

const std::string lamp_without_size =
    "<pointlights><pointlight><location x='0' y='2' z='0'/><color red='1' green='1' blue='1'/>"
    "<falloff>inversesquare</falloff></pointlight></pointlights>";

}  // namespace

TEST_CASE("a mirror shows the light that it sends to the floor") {
  // The lamp is 2 above the floor, its image 4; the camera's image is 5 above it.
  constexpr double pi = std::numbers::pi;
  const std::string path = "<maxdepth>3</maxdepth>";
  const double pixel = std::tan(15 * pi / 180) / 8;
  double straight = 0, mirrored = 0;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 24; ++x) {
      const double r = 5 * pixel * std::hypot(x + 0.5 - 12, y + 0.5 - 8);
      const auto irradiance = [&](double height) { return height / std::pow(height * height + r * r, 1.5); };
      straight += 0.8 * 0.5 / pi * irradiance(2) / (24 * 16);
      mirrored += 0.8 * 0.5 / pi * 0.8 * irradiance(4) / (24 * 16);
    }
  for (const std::string& isa : usable_isas()) {
    INFO(isa);
    const auto mean = [&](const std::string& caustics) {
      return mean_green(rendered(
          parsed_scene(floor_in_mirror(path + "<caustics>" + caustics + "</caustics>", lamp_without_size)), 2, isa));
    };
    CHECK(std::abs(mean("light") / straight - 1) < 0.005);
    CHECK(std::abs(mean("photons") / (straight + mirrored) - 1) < 0.01);
  }
}

TEST_CASE("photons bring what paths from the camera leave out") {
  for (const std::string ball : {"floor", "varnish", "lacquer", "gloss", "wax", "veil"}) {
    const auto mean = [&](const std::string& path, int samples) {
      double sum = 0;
      constexpr int renders = 4;
      for (std::uint64_t seed = 0; seed < renders; ++seed)
        sum += mean_green(rendered(parsed_scene(ball_in_glass(path, samples, ball)), 2, {}, seed));
      return sum / renders;
    };
    const double by_chance = mean("<maxdepth>8</maxdepth>", is_sanitized ? 128 : 1024);
    const double by_photons = mean(
        "<maxdepth>8</maxdepth><caustics>photons</caustics><photonradius>0.03</photonradius>", is_sanitized ? 32 : 256);
    INFO(ball << ": " << by_photons << " for " << by_chance);
    CHECK(std::abs(by_photons / by_chance - 1) < (is_sanitized ? 0.08 : 0.015));
  }
}

TEST_CASE("what they bring is a good part of the light, and grows with the depth") {
  const auto mean = [](const std::string& path) {
    return mean_green(rendered(parsed_scene(ball_in_glass(path, 64, "floor", lamp_without_size)), 2));
  };
  const std::string photons = "<caustics>photons</caustics>", light = "<caustics>light</caustics>";
  CHECK(mean(photons + "<maxdepth>8</maxdepth>") > 1.3 * mean(light + "<maxdepth>8</maxdepth>"));
  // With four points the first light comes by: in, the floor, out; a light path of one point less does not get in.
  const double three = mean(photons + "<maxdepth>3</maxdepth>"), eight = mean(photons + "<maxdepth>8</maxdepth>");
  CHECK(three < 0.9 * eight);
  CHECK(mean(photons + "<maxdepth>2</maxdepth>") == mean(light + "<maxdepth>2</maxdepth>"));
}

TEST_CASE("photons have the same bits however a picture is cut") {
  check_same_bits(parsed_scene(ball_in_glass("<caustics>photons</caustics>", 20, "varnish", lamp_without_size)));
  check_same_bits(parsed_scene(ball_in_glass("<caustics>photons</caustics>", 17, "wax")));
  check_same_bits(parsed_scene(ball_in_glass("<caustics>photons</caustics>", 17, "gloss")));
}

TEST_CASE("a film keeps the photons of its last pass, and a stopped one goes on with the same bits") {
  const SceneDescription description = parsed_scene(ball_in_glass("<caustics>photons</caustics>", 20, "floor"));
  const auto scene = build_scene(description, {2, {}});
  REQUIRE(scene->has_photons());
  Film film(film_settings(*scene, description, {2, 0, whole(description)})), stopped(film.settings());
  CHECK(film.photons() == nullptr);
  const std::atomic<bool> stop = true;
  render(*scene, stopped, 20, 2, {}, &stop);
  CHECK(stopped.fewest_samples() == 0);
  render(*scene, stopped, 13, 2);
  render(*scene, film, 3, 2);
  REQUIRE(film.photons() != nullptr);
  CHECK(film.photons()->pass == 0);
  const Photons* const first = film.photons();
  render(*scene, film, 8, 2);
  CHECK(film.photons() == first);
  render(*scene, film, 20, 1);
  render(*scene, stopped, 20, 1);
  CHECK(film.photons()->pass == 2);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 20; ++x) {
      REQUIRE(film.sum(x, y) == stopped.sum(x, y));
      REQUIRE(film.pixel(x, y).red == stopped.pixel(x, y).red);
    }
}

TEST_CASE("a scene without what focuses light has no photons") {
  const SceneDescription description = parsed_scene(with_path("<caustics>photons</caustics>", 8, 8, 4,
                                                              "<camera><eye x='0' y='0' z='5'/><lookat x='0' "
                                                              "y='0' z='0'/><fov>40</fov></camera>"));
  CHECK_FALSE(build_scene(description, {1, {}})->has_photons());
}

TEST_CASE("the error of a render in passes is that of all its samples") {
  const SceneDescription description = parsed_scene(ball_in_glass("<caustics>photons</caustics>", 64, "floor"));
  const auto scene = build_scene(description, {2, {}});
  const auto error_of = [&](std::uint32_t samples) {
    Film film(film_settings(*scene, description, {2, 0, whole(description)}));
    return render(*scene, film, samples, 2).error.relative_variance();
  };
  const double few = error_of(8), many = error_of(64);
  INFO(few << ", " << many);
  CHECK(many < few / 3);
  CHECK(many > few / 40);
}

}  // namespace raytrace::test
