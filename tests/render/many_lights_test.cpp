// Light adds up, however many lights there are.
//
// Not with the thread sanitizer: statistics of code that cuts_test runs in threads.
#include <cmath>
#include <vector>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

constexpr int width = 40, height = 30;

/// Light i of a ring about the scene, some of them below the floor, without shadows, or directional; colours differ.
std::string light(int i) {
  const double x = 9 * std::cos(i * 1.1), z = 9 * std::sin(i * 1.1);
  const std::string rest = "<scaleradiance>" + std::to_string(0.1 + 0.02 * i) + "</scaleradiance><color red='" +
                           std::to_string(0.2 + 0.02 * i) + "' green='0.5' blue='" + std::to_string(1 - 0.015 * i) +
                           "'/><shadows>" + (i % 5 == 3 ? "false" : "true") + "</shadows>";
  if (i % 3 == 2)
    return "<directionallights><directionallight>" + vector_text("direction", x, 4, z) + rest +
           "</directionallight></directionallights>";
  return "<pointlights><pointlight>" + vector_text("location", x, i % 7 == 6 ? -8 : 3 + 0.1 * i, z) + rest +
         "</pointlight></pointlights>";
}

SceneDescription lit_by(const std::string& lights) {
  return parsed_scene(scene_text(
      width, height, 2,
      "<lights><ambientlight><scaleradiance>0.25</scaleradiance></ambientlight>" + lights +
          "</lights><materials><mattes><matte><name>floor</name><ka>0.5</ka><kd>0.7</kd><cd red='0.7' green='0.8' "
          "blue='0.6'/></matte></mattes>"
          "<phongs><phong><name>ball</name><ka>0.4</ka><kd>0.5</kd><ks>0.5</ks><cd red='0.2' green='0.3' blue='1'/>"
          "<cs red='1' green='1' blue='0.9'/><exp>30</exp></phong></phongs></materials>"
          "<objects><planes><plane><point x='0' y='-1' z='0'/><normal x='0' y='1' "
          "z='0'/><material>floor</material></plane></planes>"
          "<spheres><sphere><center x='0' y='0.5' z='0'/><radius>1.5</radius><material>ball</material></sphere>"
          "<sphere><center x='3' y='0' "
          "z='2'/><radius>1</radius><material>floor</material></sphere></spheres></objects>"));
}

struct Sum {
  double red = 0, green = 0, blue = 0;
};

}  // namespace

TEST_CASE("many lights are the sum of the pictures that each makes alone") {
  for (const std::string& isa : usable_isas()) {
    const FloatPicture ambient = rendered(lit_by(""), 1, isa);
    std::vector<Sum> sums;
    for (const Pixel& pixel : ambient.pixels())
      sums.push_back({double{pixel.red}, double{pixel.green}, double{pixel.blue}});
    std::string lights;
    for (int count = 1; count <= 40; ++count) {
      lights += light(count);
      const FloatPicture alone = rendered(lit_by(light(count)), 1, isa);
      for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i].red += double{alone.pixels()[i].red} - double{ambient.pixels()[i].red};
        sums[i].green += double{alone.pixels()[i].green} - double{ambient.pixels()[i].green};
        sums[i].blue += double{alone.pixels()[i].blue} - double{ambient.pixels()[i].blue};
      }
      // Around the lengths at which an implementation may gather lights in runs.
      if (count != 2 && (count < 15 || count > 17) && (count < 31 || count > 33) && count != 40) continue;
      const FloatPicture together = rendered(lit_by(lights), 1, isa);
      double worst = 0;
      for (std::size_t i = 0; i < sums.size(); ++i) {
        const Pixel& pixel = together.pixels()[i];
        worst = std::max({worst, std::abs(double{pixel.red} - sums[i].red),
                          std::abs(double{pixel.green} - sums[i].green), std::abs(double{pixel.blue} - sums[i].blue)});
      }
      INFO(isa << ", " << count << " lights");
      CHECK(worst < 2e-5);
    }
  }
}

namespace {

enum class Around { air, fog, balls };

/// So many points and spots that fall off, in groups of so many.
SceneDescription lamps_in_groups(int count, int size, int samples, Around around) {
  std::string points, spots, balls;
  for (int i = 0; i < count; ++i) {
    const double x = 4 * std::cos(i * 1.3), z = 4 * std::sin(i * 1.7), y = 0.5 + 0.1 * i;
    const std::string rest = "<scaleradiance>" + std::to_string(0.5 + i % 4) +
                             "</scaleradiance><color red='1' green='" + std::to_string(0.3 + 0.02 * i) +
                             "' blue='0.4'/><falloff>inversesquare</falloff><group>g" + std::to_string(i / size) +
                             "</group><shadows>" + (i % 6 == 5 ? "false" : "true") + "</shadows>";
    if (i % 2 == 0)
      points += "<pointlight>" + vector_text("location", x, y, z) + rest + "</pointlight>";
    else
      spots += "<spotlight>" + vector_text("location", x, y, z) + vector_text("lookat", 0.3 * x, -1, 0.3 * z) +
               "<coneangle>70</coneangle><penumbraangle>10</penumbraangle>" + rest + "</spotlight>";
  }
  for (int i = 0; around == Around::balls && i < 150; ++i)
    balls += "<sphere>" + vector_text("center", i % 15 - 7, -0.8, i / 15 - 5) +
             "<radius>0.3</radius><material>m</material></sphere>";
  return parsed_scene(scene_text(
      width, height, samples,
      "<integrator><path><maxdepth>3</maxdepth></path></integrator><lights><pointlights>" + points +
          "</pointlights><spotlights>" + spots +
          "</spotlights></lights><materials><mattes><matte><name>m</name><ka>0</ka><kd>0.7</kd><cd red='0.9' "
          "green='0.8' blue='0.7'/></matte></mattes><fogs><fog><name>fog</name><meanfreepath>8</meanfreepath>"
          "<anisotropy>0.6</anisotropy></fog></fogs></materials><objects><planes><plane><point x='0' y='-1' z='0'/>"
          "<normal x='0' y='1' z='0'/><material>m</material></plane></planes><spheres><sphere><center x='0' y='0.5' "
          "z='0'/><radius>1.5</radius><material>m</material></sphere>" +
          std::string(around == Around::fog
                          ? "<sphere><center x='0' y='0' z='0'/><radius>9</radius><material>fog</material></sphere>"
                          : "") +
          balls + "</spheres></objects>"));
}

}  // namespace

TEST_CASE("many lamps, of which some are drawn, make the picture that they make when each is asked") {
  struct Case {
    const char* name;
    int lamps;  ///< up to 16 are asked at the first point
    Around around;
    double most_on_the_mean, most_apart;
  };
  for (const auto& [name, lamps, around, most_on_the_mean, most_of_a_part] :
       {Case{"in clear air", 30, Around::air, 0.004, 0.02},
        {"in fog", 30, Around::fog, 0.01, 0.06},
        {"among many balls", 12, Around::balls, 0.004, 0.02}}) {
    INFO(name);
    // Light groups are asked, or drawn from, each for itself: those of 6 lamps are asked.
    const FloatPicture asked = rendered(lamps_in_groups(lamps, 6, 64, around)),
                       drawn = rendered(lamps_in_groups(lamps, lamps, 256, around));
    double sum = 0, difference = 0, most_apart = 0;
    int count = 0;
    for (int i = 0; i + 8 <= width; i += 8)
      for (int j = 0; j + 6 <= height; j += 6) {
        double a = 0, b = 0;
        for (int x = i; x < i + 8; ++x)
          for (int y = j; y < j + 6; ++y) {
            const auto at = static_cast<std::size_t>(y * width + x);
            a += double{asked.pixels()[at].green};
            b += double{drawn.pixels()[at].green};
          }
        sum += a;
        difference += b - a;
        most_apart = std::max(most_apart, std::abs(b - a) / a);
        ++count;
      }
    REQUIRE(count == 25);
    INFO(difference / sum << " on the mean, at most " << most_apart);
    CHECK(std::abs(difference) < most_on_the_mean * sum);
    CHECK(most_apart < most_of_a_part);
  }
}

TEST_CASE("many lamps that are all dark light nothing") {
  for (const Around around : {Around::air, Around::fog}) {
    SceneDescription dark = lamps_in_groups(30, 30, 1, around), unlit = dark;
    auto& points = std::get<LightItems<PointLight>>(dark.lights);
    auto& spots = std::get<LightItems<SpotLight>>(dark.lights);
    for (auto& light : points) light.parameters.scaleradiance = 0;
    for (auto& light : spots) light.parameters.scaleradiance = 0;
    std::get<LightItems<PointLight>>(unlit.lights).clear();
    std::get<LightItems<SpotLight>>(unlit.lights).clear();
    const FloatPicture picture = rendered(dark), wanted = rendered(unlit);
    double worst = 0;
    for (std::size_t i = 0; i < picture.pixels().size(); ++i)
      worst = std::max(worst, difference(picture.pixels()[i], wanted.pixels()[i]));
    CHECK(worst < 1e-6);
  }
}

TEST_CASE("many lamps, of which some are drawn, have the same bits however the picture is cut") {
  for (const Around around : {Around::air, Around::fog}) check_same_bits(lamps_in_groups(30, 30, 8, around));
}

}  // namespace raytrace::test
