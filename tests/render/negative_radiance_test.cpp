// Light that is taken away: sums have a sign, and the bounds that they rest on are magnitudes.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "raytrace/aovs/aov_selection.h"
#include "raytrace/film/aov_film.h"
#include "raytrace/math/limbs.h"
#include "render/scenes.h"
#include "support/catch.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

constexpr int tiny_width = 12, tiny_height = 7, tiny_samples = 16;

std::string matte(const std::string& name, const std::string& cd) {
  return "<mattes><matte><name>" + name + "</name><ka>1</ka><kd>1</kd>" + cd + "</matte></mattes>";
}

std::string color(const std::string& element, double red, double green, double blue) {
  return "<" + element + " red='" + std::to_string(red) + "' green='" + std::to_string(green) + "' blue='" +
         std::to_string(blue) + "'/>";
}

std::string light(double radiance, double x, double z, const std::string& more = "") {
  return "<directionallights><directionallight>" + vector_text("direction", x, 0, z) + "<scaleradiance>" +
         std::to_string(radiance) + "</scaleradiance>" + more + "</directionallight></directionallights>";
}

/// A plane that fills the view, of the material `m`.
std::string wall(const std::string& lights, const std::string& materials, const std::string& objects = "") {
  return scene_text(tiny_width, tiny_height, tiny_samples,
                    "<lights>" + lights + "</lights><materials>" + materials +
                        "</materials><objects><planes><plane><point x='0' y='0' z='0'/><normal x='0' y='0' z='1'/>"
                        "<material>m</material></plane></planes>" +
                        objects + "</objects>");
}

struct Rendered {
  Film sums, means;
  std::uint64_t invalid;
};

Rendered rendered_both_ways(const SceneDescription& description, const std::string& isa) {
  const auto scene = build_scene(description, {1, isa});
  const FilmSettings settings = film_settings(*scene, description, {1, 0, whole(description)});
  Rendered all{Film(settings), Film(settings, FilmContent::means), 0};
  all.invalid = render(*scene, all.sums, tiny_samples, 1).invalid_samples.count;
  all.invalid += render(*scene, all.means, tiny_samples, 1).invalid_samples.count;
  return all;
}

/// The pixels of which a sum is not that of tiny_samples times the radiance, or a mean not the radiance.
int wrong_pixels(const Rendered& got, const Rgb<float>& radiance) {
  int wrong = 0;
  const double inverse_unit = 1 / got.sums.unit();
  const auto sum = [&](float channel) { return tiny_samples * whole_units(channel, inverse_unit); };
  for (int y = 0; y < tiny_height; ++y)
    for (int x = 0; x < tiny_width; ++x) {
      const PixelSum& low = got.sums.sum(x, y);
      const PixelSumHigh high = got.sums.high(x, y);
      wrong += from_limbs({low.red, high.red}) != sum(radiance.red) ||
               from_limbs({low.green, high.green}) != sum(radiance.green) ||
               from_limbs({low.blue, high.blue}) != sum(radiance.blue);
      for (const Pixel& pixel : {got.sums.pixel(x, y), got.means.pixel(x, y)})
        wrong += pixel.red != radiance.red || pixel.green != radiance.green || pixel.blue != radiance.blue ||
                 pixel.alpha != 1;
    }
  return wrong;
}

}  // namespace

TEST_CASE("ambient light below 0 gives its exact sums, whatever its size") {
  for (const std::string& isa : usable_isas())
    for (const double scale : {-1000.0, -0.001, -1e13, -1e17, 1e17}) {
      const std::string lights = "<ambientlight><scaleradiance>" + std::to_string(scale) + "</scaleradiance>" +
                                 color("color", 1, -0.5, 0.25) + "</ambientlight>";
      const Rendered got = rendered_both_ways(parsed_scene(wall(lights, matte("m", color("cd", 1, 1, -1)))), isa);
      const Rgb<float> radiance(Rgb<double>(1, -0.5, -0.25) * scale);
      INFO(isa << ", " << scale);
      CHECK(got.invalid == 0);
      CHECK(wrong_pixels(got, radiance) == 0);
    }
}

TEST_CASE("a background below 0 gives its exact sums, whatever its size and the integrator") {
  for (const std::string& isa : usable_isas())
    for (const double scale : {-1000.0, -1e-6, -1e13, -1e17}) {
      SceneDescription description = parsed_scene(scene_text(tiny_width, tiny_height, tiny_samples, ""));
      description.viewplane.background = Rgb<double>(1, -0.5, 0.25) * scale;
      for (const IntegratorParameters& integrator :
           {IntegratorParameters(Raycast::Parameters{}), IntegratorParameters(Normals::Parameters{})}) {
        description.integrator = integrator;
        const Rendered got = rendered_both_ways(description, isa);
        INFO(isa << ", " << scale << ", integrator " << integrator.index());
        CHECK(got.invalid == 0);
        CHECK(wrong_pixels(got, Rgb<float>(description.viewplane.background)) == 0);
      }
    }
}

TEST_CASE("a light below 0 takes from what others give, however large both are") {
  for (const std::string& isa : usable_isas())
    for (const double scale : {1.0, 1000.0, 1e13, 1e17}) {
      // Straight on, and at 60 degrees.
      const Rendered got = rendered_both_ways(
          parsed_scene(wall(light(scale, 0, 1) + light(-scale, std::sqrt(3.0), 1), matte("m", color("cd", 1, 1, -2)))),
          isa);
      INFO(isa << ", " << scale);
      CHECK(got.invalid == 0);
      int wrong = 0;
      const double wanted = 0.5 * scale / std::numbers::pi;
      for (const Pixel& pixel : got.means.pixels())
        wrong += !(std::abs(pixel.red - wanted) < 1e-6 * wanted && std::abs(pixel.blue + 2 * wanted) < 2e-6 * wanted);
      CHECK(wrong == 0);
      const std::vector<Pixel> sums = got.sums.pixels(), means = got.means.pixels();
      CHECK(std::equal(sums.begin(), sums.end(), means.begin(),
                       [](const Pixel& a, const Pixel& b) { return identical(a, b); }));
    }
}

TEST_CASE("where the light above 0 is in shadow, the one below 0 is left") {
  for (const std::string& isa : usable_isas()) {
    // A disk beside the view keeps the light from the left off all of the wall.
    const std::string disk =
        "<disks><disk><center x='-60' y='0' z='40'/><normal x='1' y='0' z='0'/><radius>1000</radius>"
        "<material>m</material></disk></disks>";
    const Rendered got =
        rendered_both_ways(parsed_scene(wall(light(1e13, -1, 1) + light(-1e13, 0, 1, "<shadows>false</shadows>"),
                                             matte("m", color("cd", 1, 1, 1)), disk)),
                           isa);
    INFO(isa);
    CHECK(got.invalid == 0);
    int wrong = 0;
    const double wanted = -1e13 / std::numbers::pi;
    for (const Pixel& pixel : got.sums.pixels()) wrong += !(std::abs(pixel.green - wanted) < -1e-6 * wanted);
    CHECK(wrong == 0);
  }
}

TEST_CASE("lobes that cancel each other in one direction do not bound the others") {
  // kd / pi and -ks are one, but for the highlight's direction.
  const std::string phong = "<phongs><phong><name>m</name><ka>0</ka><kd>3.14159274101</kd><ks>1</ks>" +
                            color("cd", 1, 1, 1) + color("cs", -1, -1, -1) + "<exp>1000</exp></phong></phongs>";
  for (const std::string& isa : usable_isas()) {
    const Rendered got = rendered_both_ways(parsed_scene(wall(light(1e13, 1, 1), phong)), isa);
    INFO(isa);
    CHECK(got.invalid == 0);
    int wrong = 0;
    for (const Pixel& pixel : got.sums.pixels()) wrong += !(std::abs(pixel.red / (1e13 * std::sqrt(0.5)) - 1) < 1e-5);
    CHECK(wrong == 0);
  }
}

TEST_CASE("an albedo below 0 has its exact mean") {
  for (const std::string& isa : usable_isas()) {
    const SceneDescription description = parsed_scene(wall("", matte("m", color("cd", -1e4, 0.5, -2))));
    const auto scene = build_scene(description, {1, isa});
    RenderSettings settings{1, 0, whole(description)};
    settings.aovs = aov_set({"albedo"});
    Film film(film_settings(*scene, description, settings));
    render(*scene, film, tiny_samples, 1);
    const double unit = std::ldexp(1.0, film.settings().aovs.mean_units.front());
    INFO(isa);
    CHECK(static_cast<double>(film.aovs()->sum(3, 2, 0)) * unit == -1e4 * tiny_samples);
    CHECK(static_cast<double>(film.aovs()->sum(3, 2, 1)) * unit == 0.5 * tiny_samples);
    CHECK(static_cast<double>(film.aovs()->sum(3, 2, 2)) * unit == -2.0 * tiny_samples);
  }
}

}  // namespace raytrace::test
