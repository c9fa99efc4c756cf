// Light paths: what they bring against closed forms, and against paths from the camera that chance to meet the lamps.
//
// Not with the thread sanitizer: statistics of code that cuts_test runs in threads.
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "raytrace/batch/checkpoint.h"
#include "raytrace/film/splat_layer.h"
#include "render/scenes.h"
#include "support/catch.h"
#include "support/sanitized.h"
#include "support/temporary_folder.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

std::string sized(int samples, const std::string& caustics, int maxdepth, const std::string& rest,
                  const std::string& viewplane = "") {
  return "<raytracer><integrator><path><caustics>" + caustics + "</caustics><maxdepth>" + std::to_string(maxdepth) +
         "</maxdepth></path></integrator><viewplane><hres>24</hres><vres>16</vres><samples>" + std::to_string(samples) +
         "</samples>" + viewplane + "</viewplane>" + rest + "</raytracer>";
}

/// What a case of the comparison has in place of the usual.
struct Stage {
  std::string name;
  std::string camera = "<camera><eye x='0' y='5' z='5'/><lookat x='0' y='0' z='0.5'/><fov>45</fov></camera>";
  std::string focusing = ball("glass");
  std::string lamp =
      "<spheres><sphere><center x='2' y='4' z='-2'/><radius>1.2</radius><material>lamp</material>"
      "</sphere></spheres>";
  std::string lights = "";
  std::string viewplane = "";
  std::string floor = "floor";

  static std::string ball(const std::string& material) {
    return "<spheres><sphere><center x='0' y='0.9' z='0'/><radius>0.8</radius><material>" + material +
           "</material></sphere></spheres>";
  }
};

std::string scene_of(const Stage& stage, const std::string& caustics, int samples) {
  return sized(
      samples, caustics, 6,
      stage.camera + "<lights>" + stage.lights + "</lights><materials><mattes><matte><name>floor</name><ka>0</ka>" +
          "<kd>0.7</kd><cd red='0.9' green='0.8' blue='0.7'/></matte><matte><name>tilted</name><ka>0</ka><kd>0.7</kd>" +
          "<cd red='0.9' green='0.8' blue='0.7'/><normalmap "
          "texture='tilt'/></matte></mattes><phongs><phong><name>varnish</name>" +
          "<ka>0</ka><kd>0.5</kd><ks>0.3</ks><exp>8</exp><cd red='0.7' green='0.7' blue='0.7'/>" +
          "<cs red='1' green='1' blue='1'/></phong></phongs><emissives><emissive><name>lamp</name>" +
          "<ce red='1' green='1' blue='1'/><scaleradiance>10</scaleradiance></emissive><emissive><name>panel</name>" +
          "<ce texture='stripes'/><scaleradiance>20</scaleradiance></emissive></emissives>" +
          "<dielectrics><dielectric><name>glass</name></dielectric><dielectric><name>amber</name><attenuationcolor " +
          "red='0.9' green='0.6' blue='0.2'/><attenuationdistance>1</attenuationdistance></dielectric>" +
          "<dielectric><name>bubble</name><thinwalled>true</thinwalled></dielectric></dielectrics>" +
          "<conductors><conductor><name>brushed</name><metal>gold</metal><roughness>0.3</roughness></conductor>" +
          "</conductors><mirrors><mirror><name>mirror</name><cr red='0.9' green='0.9' blue='0.9'/></mirror></mirrors>" +
          "<openpbrs><openpbr><name>copper</name><base_metalness>1</base_metalness><specular_roughness>0.4" +
          "</specular_roughness><coat_weight>0.5</coat_weight></openpbr><openpbr><name>lacquer</name><base_color " +
          "red='0.6' green='0.4' blue='0.2'/><specular_roughness>0.1</specular_roughness><coat_weight>0.5" +
          "</coat_weight><coat_roughness>0.2</coat_roughness></openpbr><openpbr><name>cut glass</name>" +
          "<transmission_weight>1</transmission_weight><specular_roughness>0</specular_roughness><normalmap " +
          "texture='lean'/></openpbr></openpbrs></materials><textures><checkers>" +
          "<checker><name>stripes</name><color1 red='1' green='1' blue='1'/><color2 red='0.1' green='0' blue='0'/>" +
          "<uvscale x='4' y='4'/></checker><checker><name>lean</name><color1 red='0.65' green='0.5' blue='0.98'/>" +
          "<color2 red='0.65' green='0.5' blue='0.98'/></checker><checker><name>tilt</name><color1 red='0.9' "
          "green='0.5' blue='0.8'/>" +
          "<color2 red='0.9' green='0.5' "
          "blue='0.8'/></checker></checkers></textures><groups><group><name>lens</name><objects>" +
          Stage::ball("glass") + "</objects></group></groups><objects>" + stage.focusing + stage.lamp +
          "<rectangles><rectangle><corner x='-5' y='0' z='5'/><edge1 x='10' y='0' z='0'/><edge2 x='0' y='0' z='-10'/>" +
          "<material>" + stage.floor + "</material></rectangle></rectangles></objects>",
      stage.viewplane);
}

struct Estimate {
  double mean = 0, error = 0;
};

/// The mean radiance over renders of the picture with different random numbers.
Estimate estimate(const std::string& text) {
  constexpr int renders = 10;
  double sum = 0, squares = 0;
  for (int seed = 0; seed < renders; ++seed) {
    const double mean = mean_green(rendered(parsed_scene(text), 2, {}, static_cast<std::uint64_t>(seed)));
    sum += mean;
    squares += mean * mean;
  }
  const double mean = sum / renders, variance = std::max(0.0, squares / renders - mean * mean) / (renders - 1);
  return {mean, std::sqrt(variance)};
}

/// A matte square of edge 1.
std::string board(double x, double y, double z) {
  return "<rectangles><rectangle>" + vector_text("corner", x, y, z) +
         "<edge1 x='0' y='0' z='-1'/><edge2 x='1' y='0' z='0'/><material>floor</material></rectangle></rectangles>";
}

/// The objects, the camera not seeing them.
std::string hidden(std::string objects) {
  const std::string end = "</material>";
  for (std::size_t at = 0; (at = objects.find(end, at)) != std::string::npos; at += end.size())
    objects.insert(at + end.size(), "<visible>false</visible>");
  return objects;
}

std::vector<Stage> stages() {
  const std::string eye = "<eye x='0' y='5' z='5'/><lookat x='0' y='0' z='0.5'/>";
  const std::string none = "<spheres></spheres>";
  const std::string lamp = Stage().lamp;
  const std::string sky =
      "<environmentlights><environmentlight><color red='1' green='0.9' blue='0.8'/>"
      "<scaleradiance>2</scaleradiance></environmentlight></environmentlights>";
  return {
      {"a glass ball"},
      {.name = "coloured glass", .focusing = Stage::ball("amber")},
      {.name = "a thin wall", .focusing = Stage::ball("bubble")},
      {.name = "a rough metal", .focusing = Stage::ball("brushed")},
      {.name = "an OpenPBR metal under a coat", .focusing = Stage::ball("copper")},
      {.name = "a mirror onto a glossy floor", .focusing = Stage::ball("mirror"), .floor = "varnish"},
      {.name = "a floor with relief", .floor = "tilted"},
      {.name = "a sheet of glass with relief",
       .focusing = "<boxes><box><min x='-1' y='0.5' z='-1'/><max x='1' y='0.8' z='1'/><material>cut glass</material>"
                   "</box></boxes>"},
      {.name = "a lacquered floor", .floor = "lacquer"},
      {.name = "a rough metal on a lacquered floor under a sky",
       .focusing = Stage::ball("brushed"),
       .lamp = none,
       .lights = sky,
       .floor = "lacquer"},
      {.name = "an instance",
       .focusing = "<instances><instance><group>lens</group><transform><scale x='1.3' y='0.8' "
                   "z='1'/></transform></instance></instances>"},
      {.name = "several shapes",
       .focusing = "<toruses><torus><center x='0' y='0.5' z='0'/><sweptradius>0.9</sweptradius><tuberadius>0.3"
                   "</tuberadius><material>glass</material></torus></toruses><boxes><box><min x='1.5' y='0.1' z='0'/>"
                   "<max x='2.2' y='0.9' z='0.8'/><material>mirror</material></box></boxes>"},
      {.name = "a smooth mesh",
       .focusing = "<meshes><mesh><positions>-1 0.3 -1  1 0.3 -1  1 0.3 1  -1 0.3 1  0 1.2 0</positions>"
                   "<faces>3 2 1 0  4 0 1  4 1 2  4 2 3  4 3 0</faces><normals>smooth</normals><material>mirror"
                   "</material></mesh></meshes>"},
      {.name = "a textured panel",
       .lamp = "<boxes><box><min x='1' y='3' z='-2.5'/><max x='3' y='3.5' z='-1'/><material>panel</material></box>"
               "</boxes>"},
      {.name = "a lamp's ring beside the ball",
       .lamp = "<toruses><torus><center x='0' y='0.9' z='0'/><sweptradius>1.6</sweptradius><tuberadius>0.4"
               "</tuberadius><material>lamp</material></torus></toruses>"},
      {.name = "a sky", .lamp = none, .lights = sky},
      {.name = "a gaussian filter", .viewplane = "<filter>gaussian</filter><filterwidth>3</filterwidth>"},
      {.name = "a thin lens",
       .camera = "<thinlenscamera>" + eye +
                 "<fov>45</fov><lensradius>0.3</lensradius><focaldistance>6</focaldistance>"
                 "</thinlenscamera>"},
      {.name = "a shifted camera",
       .camera = "<camera><eye x='0' y='4' z='6'/><lookat x='0' y='4' z='0.5'/><fov>45</fov><shift x='0.1' y='-0.4'/>"
                 "</camera>"},
      {.name = "a shifted thin lens",
       .camera = "<thinlenscamera><eye x='0' y='4' z='6'/><lookat x='0' y='4' z='0.5'/><fov>45</fov><shift x='0.1' "
                 "y='-0.4'/><lensradius>0.3</lensradius><focaldistance>6</focaldistance></thinlenscamera>"},
      {.name = "an orthographic camera",
       .camera = "<orthographiccamera>" + eye + "</orthographiccamera>",
       .viewplane = "<pixelsize>0.2</pixelsize>"},
      // The camera sees the floor through the ball, and past a board and from below another, that hide light alone.
      {.name = "a ball, boards and a lamp that the camera does not see",
       .focusing = hidden(Stage::ball("glass") + board(0, 3, 3) + board(-2.5, 0.1, 1.5) + board(-1, 0.05, 1.2)),
       .lamp = hidden(lamp)},
      {.name = "a ball in amber that the camera does not see",
       .focusing = Stage::ball("copper") +
                   hidden("<boxes><box><min x='-1.5' y='-0.1' z='-1.5'/><max x='1.5' y='2' z='1.5'/><material>amber"
                          "</material></box></boxes>")},
      {.name = "a board and half a ball that are nearer than the camera sees",
       .camera = "<camera>" + eye + "<fov>45</fov><nearclip>6.6</nearclip></camera>",
       .focusing = Stage::ball("glass") + board(-1, 2.5, 3)},
      {.name = "the same with a lens",
       .camera = "<thinlenscamera>" + eye +
                 "<fov>45</fov><lensradius>0.3</lensradius><focaldistance>6</focaldistance><nearclip>5.8</nearclip>"
                 "</thinlenscamera>",
       .focusing = Stage::ball("glass") + board(-1, 2.5, 3)},
      {.name = "a fisheye", .camera = "<fisheyecamera>" + eye + "<angle>120</angle></fisheyecamera>"},
      {.name = "a camera that looks all around", .camera = "<sphericalcamera>" + eye + "</sphericalcamera>"},
  };
}

/// A floor of a matte of radiance 1 / pi for an irradiance of 1, seen from above.
std::string floor_under(const std::string& lights, const std::string& mirror) {
  return sized(
      64, "light", 2,
      "<camera><eye x='0' y='1' z='0'/><lookat x='0' y='0' z='0'/><up x='0' y='0' z='-1'/><fov>40</fov></camera>"
      "<lights>" +
          lights +
          "</lights><materials><mattes><matte><name>floor</name><ka>0</ka><kd>1</kd>"
          "<cd red='1' green='1' blue='1'/></matte></mattes><mirrors><mirror><name>mirror</name>"
          "<cr red='0.8' green='0.8' blue='0.8'/></mirror></mirrors></materials><objects><planes><plane>"
          "<point x='0' y='0' z='0'/><normal x='0' y='1' z='0'/><material>floor</material></plane></planes>" +
          mirror + "</objects>");
}

std::string ceiling(double height) {
  const std::string y = std::to_string(height);
  return "<rectangles><rectangle><corner x='-0.6' y='" + y +
         "' z='-0.6'/><edge1 x='1.2' y='0' z='0'/>"
         "<edge2 x='0' y='0' z='1.2'/><material>mirror</material></rectangle></rectangles>";
}

Film film_of(const Scene& scene, const SceneDescription& description, const Region& region, const Region& all) {
  return Film(film_settings(scene, description, {1, 3, region, {}, {}, false, all}));
}

}  // namespace

TEST_CASE("light paths bring what paths from the camera leave out") {
  const std::vector<Stage> all = stages();
  const int samples = is_sanitized ? 12 : 48;
  for (std::size_t i = 0; i < all.size(); i += is_sanitized ? 3 : 1) {  // there, each takes as long as all do elsewhere
    const Stage& stage = all[i];
    const Estimate with = estimate(scene_of(stage, "light", samples)),
                   without = estimate(scene_of(stage, "none", 2 * samples));
    const double error = std::hypot(with.error, without.error);
    INFO(stage.name << ": " << with.mean << " +- " << with.error << ", " << without.mean << " +- " << without.error);
    CHECK(error < (is_sanitized ? 0.05 : 0.02) * without.mean);
    CHECK(std::abs(with.mean - without.mean) < 4 * error);
  }
}

TEST_CASE("what gloss mirrors of a caustic is no noisier for light paths") {
  // What they brought to lobes so narrow, which mirror the ball, was a few dots.
  const std::string low = "<camera><eye x='0' y='0.7' z='6'/><lookat x='0' y='0' z='1'/><fov>20</fov></camera>";
  const auto variance = [&](const std::string& caustics) {
    const std::string scene = scene_of({.name = "", .camera = low, .floor = "lacquer"}, caustics, 64);
    const FloatPicture a = rendered(parsed_scene(scene), 2, {}, 1), b = rendered(parsed_scene(scene), 2, {}, 2);
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
      const double x = double{a.pixels()[i].green}, y = double{b.pixels()[i].green};
      sum += (x - y) * (x - y) / ((x + y) * (x + y) / 4 + 0.01);
    }
    return sum;
  };
  const double by_chance = variance("none"), by_light_paths = variance("light");
  INFO(by_light_paths << " for " << by_chance);
  CHECK(by_light_paths < by_chance);
}

TEST_CASE("they bring a good part of the light") {
  // So that the comparison above would notice if they brought none.
  const Film film = [] {
    const SceneDescription description = parsed_scene(scene_of({"a glass ball"}, "light", 64));
    const auto scene = build_scene(description, {2, {}});
    Film result = film_of(*scene, description, whole(description), whole(description));
    render(*scene, result, 64, 2);
    return result;
  }();
  double own = 0, brought = 0;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 24; ++x) {
      own += static_cast<double>(film.sum(x, y).green);
      brought += static_cast<double>(film.splats()->sum(x, y)[1]);
    }
  CHECK(brought > 0.05 * own);
}

TEST_CASE("a lamp below a mirror shines from its image, too") {
  constexpr double pi = std::numbers::pi;
  const std::string location = "<location x='0' y='2' z='0'/><color red='1' green='1' blue='1'/>";
  struct Lamp {
    std::string name, lights;
    std::function<double(double)> irradiance;  ///< so far from the middle, without the mirror
    std::function<double(double)> mirrored;
  };
  // The lamp is 2 above the floor, the mirror 3: the image is 4 above.
  const auto falling = [](double height) {
    return [height](double r) { return height / std::pow(height * height + r * r, 1.5); };
  };
  const std::vector<Lamp> lamps = {
      {"a point",
       "<pointlights><pointlight>" + location + "<falloff>inversesquare</falloff></pointlight></pointlights>",
       falling(2), falling(4)},
      {"a spotlight, upwards",
       "<spotlights><spotlight>" + location +
           "<lookat x='0' y='3' z='0'/><coneangle>120</coneangle>"
           "<falloff>inversesquare</falloff></spotlight></spotlights>",
       [](double) { return 0.0; }, falling(4)},
      // The mirror gets the same irradiance everywhere; beams of light from it grow wider.
      {"a point that does not fall off", "<pointlights><pointlight>" + location + "</pointlight></pointlights>",
       [](double r) { return 2 / std::hypot(2, r); },
       [](double r) {
         const double to_mirror = std::hypot(1, r / 4), all = std::hypot(4, r);
         return 4 / all * (to_mirror * to_mirror) / (all * all);
       }},
  };
  for (const Lamp& lamp : lamps) {
    for (const std::string& isa : usable_isas()) {
      const FloatPicture picture = rendered(parsed_scene(floor_under(lamp.lights, ceiling(3))), 2, isa);
      double got = 0, wanted = 0;
      const double pixel = std::tan(20 * pi / 180) / 8;
      for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 24; ++x) {
          const double r = pixel * std::hypot(x + 0.5 - 12, y + 0.5 - 8);
          got += double{picture.at(x, y).green};
          wanted += (lamp.irradiance(r) + 0.8 * lamp.mirrored(r)) / pi;
        }
      INFO(lamp.name << ", " << isa << ": " << got / wanted);
      CHECK(std::abs(got / wanted - 1) < 0.02);
    }
  }
}

TEST_CASE("a sun that a mirror sends to the floor") {
  // Along x, onto a mirror that leans over by 45 degrees and sends it down.
  const std::string sun =
      "<directionallights><directionallight><direction x='1' y='0' z='0'/>"
      "<color red='1' green='1' blue='1'/></directionallight></directionallights>";
  const std::string mirror =
      "<rectangles><rectangle><corner x='-1' y='0.5' z='-1'/><edge1 x='2' y='2' z='0'/><edge2 x='0' y='0' z='2'/>"
      "<material>mirror</material></rectangle></rectangles>";
  const double mean = mean_green(rendered(parsed_scene(floor_under(sun, mirror)), 2));
  // No light comes straight to a floor along which it goes.
  CHECK(std::abs(mean * std::numbers::pi / 0.8 - 1) < 0.02);
}

TEST_CASE("a render with light paths goes on from a checkpoint with the same bits") {
  const SceneDescription description = parsed_scene(scene_of({"a glass ball"}, "light", 21));
  const auto scene = build_scene(description, {2, {}});
  const Region all = whole(description), tile{5, 3, 20, 11};
  const TemporaryFolder folder;
  for (const Region& region : {all, tile}) {
    Film once = film_of(*scene, description, region, all), first(once.settings()), second(once.settings());
    render(*scene, once, 21, 2);
    render(*scene, first, 9, 1);
    PieceIdentity identity;
    identity.film = first.settings();
    identity.whole = all;
    if (region != all) identity.tile = Tile{0, 1};
    identity.provenance = provenance_of(*scene, description, 1);
    ImageMetadata metadata;
    metadata.software = identity.provenance.software;
    metadata.seed = 3;
    if (region == all) {  // a tile of these edges is none of the program's
      write_checkpoint(folder.file("c.exr"), first, identity, metadata);
      read_checkpoint(folder.file("c.exr"), identity, second);
    } else {
      render(*scene, second, 9, 2);
    }
    render(*scene, second, 21, 2);
    CHECK(once.fewest_samples() == 21);
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 24; ++x) {
        REQUIRE(once.sum(x, y) == second.sum(x, y));
        REQUIRE(once.splats()->sum(x, y) == second.splats()->sum(x, y));
      }
  }
}

TEST_CASE("while samples are missing, light paths count for as many as there are") {
  const SceneDescription description = parsed_scene(scene_of({"a glass ball"}, "light", 64));
  const auto scene = build_scene(description, {2, {}});
  Film film = film_of(*scene, description, whole(description), whole(description));
  render(*scene, film, 16, 2);
  const double early = mean_green(film);
  render(*scene, film, 64, 2);
  CHECK(std::abs(early / mean_green(film) - 1) < 0.1);
}

}  // namespace raytrace::test
