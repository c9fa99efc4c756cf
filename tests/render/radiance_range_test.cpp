// The film's unit: by the materials and lights that are used, and fine enough for the dimmest of them.
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

std::string matte(const std::string& name, double ka, double kd, const std::string& cd = "1") {
  return "<matte><name>" + name + "</name><ka>" + std::to_string(ka) + "</ka><kd>" + std::to_string(kd) +
         "</kd><cd red='" + cd + "' green='1' blue='1'/></matte>";
}

std::string ambient(double scale) {
  return "<ambientlight><scaleradiance>" + std::to_string(scale) + "</scaleradiance></ambientlight>";
}

std::string point_light(double scale, double distance, const std::string& more = "") {
  return "<pointlights><pointlight>" + vector_text("location", 0, 0, distance) + "<scaleradiance>" +
         std::to_string(scale) + "</scaleradiance><shadows>false</shadows>" + more + "</pointlight></pointlights>";
}

/// A wall at z = 0, of the material m.
std::string scene_of(const std::string& lights, const std::string& mattes) {
  return scene_text(16, 10, 4,
                    "<lights>" + lights + "</lights><materials><mattes>" + mattes +
                        "</mattes></materials><objects><planes><plane><point x='0' y='0' z='0'/>"
                        "<normal x='0' y='0' z='1'/><material>m</material></plane></planes></objects>");
}

RadianceRange range_of(const std::string& text) { return build_scene(parsed_scene(text), {1, {}})->radiance_range(); }

Pixel center_of(const std::string& text, const std::string& isa) {
  return rendered(parsed_scene(text), 1, isa).at(8, 5);
}

}  // namespace

TEST_CASE("a material that no object has changes no bit") {
  const std::string lights = ambient(1) + point_light(3, 9), used = matte("m", 0.25, 0.5);
  for (const std::string& isa : usable_isas()) {
    const FloatPicture wanted = rendered(parsed_scene(scene_of(lights, used)), 1, isa);
    for (const double unused : {0.9, 1e15, 1e17}) {
      INFO(isa << ", kd " << unused);
      const std::string more = matte("a", unused, 0) + used + matte("z", 0, unused, "1e17");
      CHECK(identical(rendered(parsed_scene(scene_of(lights, more)), 1, isa), wanted));
    }
  }
  const std::string text = scene_of("", used + matte("a", 1, 1e15));
  CHECK(build_scene(parsed_scene(text), {1, {}})->largest_albedo() == 0.5F);
}

TEST_CASE("lights of a scene without objects, or without any reflection, do not count") {
  const RadianceRange empty = range_of(scene_text(8, 8, 1, "<lights>" + ambient(1e13) + "</lights>"));
  CHECK(empty.usual == 0.4F);
  CHECK(empty.dimmest == 0.1F);
  const RadianceRange black = range_of(scene_of(point_light(1e13, 9), matte("m", 1, 0)));
  CHECK(black.usual == 0.4F);
}

TEST_CASE("scenes within six powers of ten have the unit of their brightest light") {
  for (const double scale : {1e-9, 1.0, 1e9}) {
    const RadianceRange range{static_cast<float>(scale), 0, static_cast<float>(scale * 2e-6)};
    CHECK(unit_exponent(range, 16) == unit_exponent(range.usual, 16));
  }
}

TEST_CASE("a light of any strength leaves the others their bits") {
  for (const std::string& isa : usable_isas())
    for (const double strength : {1e3, 1e6, 1e9, 1e13, 1e15}) {
      INFO(isa << ", " << strength);
      // Behind the wall it lights nothing of what is in view.
      const Pixel pixel = center_of(scene_of(ambient(0.3) + point_light(strength, -5), matte("m", 1, 1)), isa);
      CHECK(std::abs(pixel.red - 0.3F) <= 0x1p-25F);
      const Pixel lit = center_of(scene_of(ambient(0.3) + point_light(strength, 9), matte("m", 1, 1)), isa);
      CHECK(std::abs(lit.red / (0.3 + strength / std::numbers::pi) - 1) < 4e-3);  // the cosine of a pixel
    }
}

TEST_CASE("a channel of a bright material may be dim") {
  for (const std::string& isa : usable_isas()) {
    const Pixel pixel = center_of(scene_of(ambient(1e13), matte("m", 1, 0, "3e-14")), isa);
    INFO(isa);
    CHECK(pixel.green == 1e13F);
    CHECK(std::abs(pixel.red - 0.3F) <= 0x1p-24F);
  }
}

TEST_CASE("a lamp that falls off is as bright as at the camera, far away as it is") {
  for (const std::string& isa : usable_isas())
    for (const double distance : {1e3, 1e6, 1e8}) {
      const std::string lamp = point_light(distance * distance, distance, "<falloff>inversesquare</falloff>");
      const Pixel pixel = center_of(scene_of(lamp, matte("m", 0, 1)), isa);
      INFO(isa << ", " << distance);
      CHECK(std::abs(pixel.red - std::numbers::inv_pi_v<float>) < 1e-6F);
    }
}

TEST_CASE("a scene of any size has the light of lamps that fall off") {
  const auto sized = [](double size, const std::string& lamp) {
    const auto at = [&](const std::string& name, double x, double y, double z) {
      std::ostringstream text;
      text << "<" << name << " x='" << x * size << "' y='" << y * size << "' z='" << z * size << "'/>";
      return text.str();
    };
    std::ostringstream strength;
    strength << "<scaleradiance>" << 9 * size * size << "</scaleradiance>";
    const bool spot = lamp == "spotlight";
    return "<raytracer><viewplane><hres>8</hres><vres>6</vres><samples>4</samples></viewplane><camera>" +
           at("eye", 0, 1, 6) + at("lookat", 0, 0, 0) + "<fov>30</fov></camera><lights><" + lamp + "s><" + lamp + ">" +
           at("location", 0, 3, 1) + (spot ? at("lookat", 0, 0, 0) + "<coneangle>150</coneangle>" : "") +
           "<falloff>inversesquare</falloff>" + strength.str() + "</" + lamp + "></" + lamp +
           "s></lights><materials><mattes>" + matte("m", 1, 0.8) +
           "</mattes></materials><objects><planes><plane><point x='0' y='0' z='0'/><normal x='0' y='1' z='0'/>"
           "<material>m</material></plane></planes></objects></raytracer>";
  };
  for (const std::string lamp : {"pointlight", "spotlight"}) {
    const Pixel wanted = rendered(parsed_scene(sized(1, lamp)), 1).at(4, 4);
    REQUIRE(wanted.red > 0.1F);
    for (const double size : {1e-3, 1e-5, 1e-8, 1e-9, 1e-12}) {
      INFO(lamp << " " << size);
      CHECK(std::abs(rendered(parsed_scene(sized(size, lamp)), 1).at(4, 4).red / wanted.red - 1) < 1e-4F);
    }
  }
  // Also where the lamp is at the eye, and where what the camera looks at is but a direction.
  const auto unit_of = [](const std::string& eye, const std::string& sphere, const std::string& lookat = "-1") {
    return range_of("<raytracer><viewplane><hres>8</hres><vres>6</vres></viewplane><camera><eye x='0' y='0' z='" + eye +
                    "'/><lookat x='0' y='0' z='" + lookat +
                    "'/><fov>30</fov></camera><lights><pointlights><pointlight><location x='0' "
                    "y='0' z='" +
                    eye + "'/><falloff>inversesquare</falloff></pointlight></pointlights></lights><materials><mattes>" +
                    matte("m", 0, 1) +
                    "</mattes></materials><objects><spheres><sphere><center x='0' y='0' z='0'/><radius>" + sphere +
                    "</radius><material>m</material></sphere></spheres></objects></raytracer>")
        .usual;
  };
  CHECK(unit_of("3", "1") < 0.5F);
  CHECK(unit_of("3", "1", "2.9999999") == unit_of("3", "1"));
  // As far as the corners of the sphere's box.
  const double size = 3e-9 + std::sqrt(3.0) * 1e-9;
  CHECK(std::abs(unit_of("3e-9", "1e-9") * std::numbers::pi * size * size - 1) < 1e-3);
}

TEST_CASE("the unit gives the dimmest source a float's bits, or the largest radiance room") {
  constexpr float infinite = std::numeric_limits<float>::infinity();
  for (const float usual : {1e-20F, 1.0F, 1e6F, 1e13F, 1e17F, 1e30F, infinite})
    for (const float dimmest : {1e-30F, 1e-7F, 0.02F, 1.0F, infinite})
      for (const float room : {1.0F, 0x1p20F})
        for (const std::uint64_t count : {1ULL, 64ULL, 1ULL << 31U}) {
          const RadianceRange range{usual, usual * room, std::min(usual, dimmest)};
          const int exponent = unit_exponent(range, count);
          INFO(usual << ", " << range.dimmest << ", " << room << ", " << count << " samples: 2^" << exponent);
          CHECK(is_unit_exponent(exponent));
          CHECK(exponent <= std::max(unit_exponent(range.usual, count), unit_exponent(range.largest, 1) - 38));
          const double largest = std::min(double{range.largest}, double{std::numeric_limits<float>::max()});
          CHECK(std::ldexp(largest, -exponent) <= 0x1p83 * (1 - 0x1p-23));
          const double units = std::ldexp(double{std::max(range.dimmest, 0x1p-25F)}, -exponent);
          const bool fine = units >= 0x1p24;
          CHECK((fine || std::ldexp(largest, -exponent) >= 0x1p81));
          CHECK(is_fine_for_dimmest(range, exponent) == fine);
        }
}

}  // namespace raytrace::test
