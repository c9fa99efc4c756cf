// What cameras and pixel filters make of whole pictures.
#include <algorithm>
#include <cmath>
#include <string>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

/// A plane of radiance 0.25, 0.5, 0.75 in the lower half of space, under a background.
SceneDescription half_space(int width, int height, int samples, const std::string& camera,
                            const std::string& filter = {}) {
  return parsed_scene(
      "<raytracer><viewplane><hres>" + std::to_string(width) + "</hres><vres>" + std::to_string(height) +
      "</vres><samples>" + std::to_string(samples) + "</samples><background red='2' green='2' blue='2'/>" + filter +
      "</viewplane>" + camera +
      "<lights><ambientlight/></lights><materials><mattes><matte><name>m</name><ka>1</ka><kd>0</kd>"
      "<cd red='0.25' green='0.5' blue='0.75'/></matte></mattes></materials><objects><planes><plane>"
      "<point x='0' y='0' z='0'/><normal x='0' y='1' z='0'/><material>m</material></plane></planes></objects>"
      "</raytracer>");
}

const std::string level = "<eye x='0' y='3' z='0'/><lookat x='0' y='3' z='-1'/>";

}  // namespace

TEST_CASE("outside of a fisheye's circle the picture is black and nothing is hit") {
  const SceneDescription description =
      half_space(48, 32, GENERATE(1, 16), "<fisheyecamera>" + level + "</fisheyecamera>");
  for (const std::string& isa : usable_isas()) {
    const auto scene = build_scene(description, {1, isa});
    for (const bool transparent : {false, true}) {
      RenderSettings settings{1, 0, whole(description)};
      settings.transparent = transparent;
      RayCounts rays;
      const Film film = render(*scene, description, settings, rays);
      const auto samples = static_cast<std::uint64_t>(description.viewplane.samples);
      int wrong = 0;
      std::uint64_t outside = 0;
      for (int y = 0; y < 32; ++y)
        for (int x = 0; x < 48; ++x) {
          const Pixel pixel = film.pixel(x, y);
          const double radius = std::hypot(x + 0.5 - 24, y + 0.5 - 16);
          const float alpha = !transparent ? 1 : radius < 15 && y >= 16 ? 1 : 0;
          if (radius > 17) {
            ++outside;
            wrong += pixel.red != 0 || pixel.green != 0 || pixel.blue != 0 || pixel.alpha != alpha;
          } else if (radius < 15) {
            const float background = transparent ? 0 : 2;
            wrong += pixel.red != (y < 16 ? background : 0.25f) || pixel.alpha != alpha;
          }
        }
      INFO(isa);
      CHECK(wrong == 0);
      CHECK(outside > 500);
      CHECK(rays.camera <= (48 * 32 - outside) * samples);
    }
  }
}

TEST_CASE("a spherical camera shows what is above and below, all around") {
  const SceneDescription description = half_space(36, 18, 4, "<sphericalcamera>" + level + "</sphericalcamera>");
  for (const std::string& isa : usable_isas()) {
    const FloatPicture picture = rendered(description, 1, isa);
    for (int y = 0; y < 18; ++y)
      for (int x = 0; x < 36; ++x) CHECK(picture.at(x, y).green == (y < 9 ? 2.0f : 0.5f));
  }
}

TEST_CASE("what is evenly bright stays as bright through every filter and lens") {
  const std::string filter = GENERATE("box", "triangle", "gaussian", "blackmanharris");
  const std::string down = "<eye x='0' y='3' z='0'/><lookat x='0' y='0' z='0'/><fov>60</fov>";
  const std::string camera =
      GENERATE_COPY("<camera>" + down + "</camera>", "<thinlenscamera>" + down +
                                                         "<lensradius>0.4</lensradius><focaldistance>2</focaldistance>"
                                                         "</thinlenscamera>");
  const SceneDescription description =
      half_space(16, 12, GENERATE(1, 7, 16), camera, "<filter>" + filter + "</filter>");
  for (const std::string& isa : usable_isas()) {
    const FloatPicture picture = rendered(description, 1, isa);
    CHECK(std::all_of(picture.pixels().begin(), picture.pixels().end(), [](const Pixel& pixel) {
      return pixel.red == 0.25f && pixel.green == 0.5f && pixel.blue == 0.75f;
    }));
  }
}

TEST_CASE("a filter blurs an edge as far as it is wide") {
  // The horizon lies between rows 7 and 8.
  const auto rows_between = [](const std::string& filter, const std::string& width = {}) {
    const SceneDescription description =
        half_space(16, 16, 256, "<camera>" + level + "<viewdistance>16</viewdistance></camera>",
                   "<filter>" + filter + "</filter>" + width);
    const FloatPicture picture = rendered(description);
    int between = 0;
    double sum = 0;
    for (int y = 0; y < 16; ++y) {
      const auto green = double{picture.at(5, y).green};
      between += green > 0.5 && green < 2;
      sum += green;
    }
    CHECK(sum == Approx(8 * 2.5).epsilon(0.01));
    return between;
  };
  CHECK(rows_between("box") == 0);
  CHECK(rows_between("triangle") == 2);
  CHECK(rows_between("gaussian") == 2);
  CHECK(rows_between("box", "<filterwidth>4.5</filterwidth>") == 4);
}

TEST_CASE("a shifted picture is a part of a larger one") {
  // 40 x 30 of 80 x 60 pixels, 10 to the right of its middle and 8 below.
  SceneDescription larger = parsed_scene(busy_scene(80, 60, 1));
  SceneDescription shifted = larger;
  shifted.viewplane.hres = 40;
  shifted.viewplane.vres = 30;
  std::get<PinholeCamera::Parameters>(shifted.camera).shift = {10.0 / 40, -8.0 / 40};
  const FloatPicture all = rendered(larger), part = rendered(shifted);
  int other = 0;
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 40; ++x) other += difference(part.at(x, y), all.at(x + 20 + 10, y + 15 + 8)) > 1e-3;
  CHECK(other < 12);  // on edges, where rays are rounded otherwise
}

TEST_CASE("a shift that has keys blurs the picture while the shutter is open") {
  // The horizon moves from row 4 to row 12, evenly.
  const SceneDescription description =
      half_space(16, 16, 256,
                 "<camera>" + level +
                     "<viewdistance>16</viewdistance><shift><key frame='1' x='0' y='-0.25'/><key frame='2' "
                     "x='0' y='0.25'/></shift><shutteropen>0</shutteropen><shutterclose>1</shutterclose></camera>");
  const FloatPicture picture = rendered(description);
  for (int y = 0; y < 16; ++y) {
    const double below = std::clamp((y + 0.5 - 4) / 8, 0.0, 1.0);
    INFO("row " << y);
    CHECK(double{picture.at(5, y).green} == Approx(2 - 1.5 * below).margin(0.03));
  }
}

TEST_CASE("a filter leaves a single sample in the pixel's centre") {
  const SceneDescription plain = parsed_scene(busy_scene(40, 30, 1));
  SceneDescription filtered = plain;
  filtered.viewplane.filter = PixelFilter::gaussian;
  CHECK(identical(rendered(filtered), rendered(plain)));
}

TEST_CASE("samples of a lens are the seed's, even of one sample a pixel") {
  SceneDescription description = parsed_scene(busy_scene(40, 30, 1));
  const auto& pinhole = std::get<PinholeCamera::Parameters>(description.camera);
  ThinLensCamera::Parameters lens;
  lens.eye = pinhole.eye;
  lens.lookat = pinhole.lookat;
  lens.viewdistance = pinhole.viewdistance;
  lens.lensradius = 0.5;
  lens.focaldistance = 3;
  description.camera = lens;
  CHECK(identical(rendered(description, 1, {}, 1), rendered(description, 3, {}, 1)));
  CHECK_FALSE(identical(rendered(description, 1, {}, 1), rendered(description, 1, {}, 2)));
}

}  // namespace raytrace::test
