// Light that clear media split by its wavelength, against Snell's law in double precision, integrated over what red,
// green and blue weigh of the wavelengths.
//
// Not with the thread sanitizer: statistics of code that cuts_test runs in threads.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/sanitized.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

using SpectrumMeans = std::array<double, 3>;

/// What red, green and blue weigh of the wavelengths: first, top and last, in micrometres.
constexpr std::array<std::array<double, 3>, 3> hats{{{0.552, 0.605, 0.68}, {0.47, 0.542, 0.607}, {0.4, 0.447, 0.512}}};

double index_at(double wavelength, double ior, double abbe) {
  const auto inverse_square = [](double w) { return 1 / (w * w); };
  const double b = (ior - 1) / abbe / (inverse_square(0.4861) - inverse_square(0.6563));
  return ior + b * (inverse_square(wavelength) - inverse_square(0.5876));
}

/// The mean of of(wavelength) for each channel.
template <class Of>
SpectrumMeans mean_of_spectrum(const Of& of) {
  SpectrumMeans result{};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    constexpr int steps = 4000;
    const auto& [first, top, last] = hats[channel];
    for (int i = 0; i < steps; ++i) {
      const double wavelength = first + (last - first) * (i + 0.5) / steps;
      const double height = std::min((wavelength - first) / (top - first), (last - wavelength) / (last - top));
      result[channel] += of(wavelength) * 2 * height / steps;
    }
  }
  return result;
}

SpectrumMeans channel_means(const FloatPicture& picture) {
  SpectrumMeans sum{};
  for (const Pixel& pixel : picture.pixels()) {
    const std::array<float, 3> channels{pixel.red, pixel.green, pixel.blue};
    for (std::size_t i = 0; i < 3; ++i) sum[i] += double{channels[i]} / static_cast<double>(picture.pixels().size());
  }
  return sum;
}

std::string channels_text(const SpectrumMeans& c) {
  return std::to_string(c[0]) + " " + std::to_string(c[1]) + " " + std::to_string(c[2]);
}

void check_channels(const SpectrumMeans& got, const SpectrumMeans& wanted, double tolerance) {
  INFO(channels_text(got) << " for " << channels_text(wanted));
  for (std::size_t i = 0; i < 3; ++i) CHECK(std::abs(got[i] - wanted[i]) < tolerance);
}

std::string decimal(double value) { return std::to_string(value); }

/// A prism of three equal sides of length 2 about z. Its base is on y = 0.
constexpr double flint_ior = 1.7, flint_abbe = 20;
const double prism_height = std::sqrt(3.0);

std::string prism(double half_length) {
  const std::string z = decimal(half_length);
  const auto corner = [&](double x, double y, const std::string& end) {
    return decimal(x) + " " + decimal(y) + " " + end;
  };
  return "<meshes><mesh><positions>" + corner(-1, 0, z) + ", " + corner(1, 0, z) + ", " + corner(0, prism_height, z) +
         ", " + corner(-1, 0, "-" + z) + ", " + corner(1, 0, "-" + z) + ", " + corner(0, prism_height, "-" + z) +
         "</positions><faces>0 1 2, 5 4 3, 0 3 4 1, 1 4 5 2, 2 5 3 0</faces><material>flint</material></mesh></meshes>";
}

const std::string flint =
    "<dielectrics><dielectric><name>flint</name><ior>1.7</ior><abbe>20</abbe></dielectric>"
    "</dielectrics>";
const std::string flint_of_openpbr =
    "<openpbrs><openpbr><name>flint</name><transmission_weight>1</transmission_weight><specular_ior>1.7</specular_ior>"
    "<specular_roughness>0</specular_roughness><transmission_dispersion_scale>0.5</transmission_dispersion_scale>"
    "<transmission_dispersion_abbe_number>10</transmission_dispersion_abbe_number></openpbr></openpbrs>";
const std::string shining_wall =
    "<emissives><emissive><name>lamp</name><ce red='1' green='1' blue='1'/><twosided>true</twosided></emissive>"
    "</emissives>";

struct PlaneVector {
  double x, y;
};
double plane_dot(const PlaneVector& a, const PlaneVector& b) { return a.x * b.x + a.y * b.y; }

/// The direction of the least deviation for yellow light, which goes through the prism along x.
PlaneVector direction_in() {
  const double turn = std::asin(flint_ior / 2) - std::numbers::pi / 6;
  return {std::cos(turn), std::sin(turn)};
}

/// A direction that was refracted, and the share that came through.
struct Refracted {
  PlaneVector direction;
  double share;
};

/// normal: towards where light comes from. ratio: the index behind the surface over that before it.
std::optional<Refracted> refracted(const PlaneVector& direction, const PlaneVector& normal, double ratio) {
  const double cosine = -plane_dot(direction, normal), sine2 = (1 - cosine * cosine) / (ratio * ratio);
  if (sine2 >= 1) return std::nullopt;
  const double below = std::sqrt(1 - sine2), across = (cosine - ratio * below) / (cosine + ratio * below),
               along = (ratio * cosine - below) / (ratio * cosine + below);
  const double left = cosine / ratio - below;
  return Refracted{{direction.x / ratio + normal.x * left, direction.y / ratio + normal.y * left},
                   1 - (across * across + along * along) / 2};
}

struct Landing {
  double y;      ///< on a screen of that x
  double share;  ///< of the light
};

/// Of light that meets the left side at `at`, a share of the way up, and leaves by the right one.
std::optional<Landing> landing(double at, double wavelength, double screen) {
  const double n = index_at(wavelength, flint_ior, flint_abbe), half = prism_height / 2;
  const auto inside = refracted(direction_in(), {-half, 0.5}, n);
  if (!inside) return std::nullopt;
  // To the right side, where half (x - 1) + y / 2 = 0.
  const PlaneVector from{at - 1, at * prism_height}, &way = inside->direction;
  const double t = -(half * (from.x - 1) + from.y / 2) / (half * way.x + way.y / 2);
  const PlaneVector to{from.x + way.x * t, from.y + way.y * t};
  if (to.y < 0 || to.y > prism_height) return std::nullopt;
  const auto outside = refracted(way, {-half, -0.5}, 1 / n);
  if (!outside) return std::nullopt;
  return Landing{to.y + (screen - to.x) * outside->direction.y / outside->direction.x, inside->share * outside->share};
}

}  // namespace

TEST_CASE("a ray through a prism lands where Snell's law has each wavelength") {
  constexpr double screen = 4;
  const PlaneVector in = direction_in();
  // The screen shines up to the height where one wavelength lands.
  for (const double edge : {0.43, 0.48, 0.52, 0.56, 0.6, 0.65}) {
    const double top = landing(0.5, edge, screen)->y;
    const std::string camera = "<camera><eye x='" + decimal(-0.5 - 4 * in.x) + "' y='" +
                               decimal(prism_height / 2 - 4 * in.y) + "' z='0'/><lookat x='-0.5' y='" +
                               decimal(prism_height / 2) + "' z='0'/><fov>0.005</fov></camera>";
    const SpectrumMeans wanted = mean_of_spectrum([&](double wavelength) {
      const Landing there = *landing(0.5, wavelength, screen);
      return there.y < top ? there.share : 0;
    });
    for (const std::string& material : {flint, flint_of_openpbr})
      for (const std::string& isa : usable_isas()) {
        const FloatPicture picture = rendered(
            parsed_scene("<raytracer><viewplane><hres>16</hres><vres>16</vres><samples>256</samples>"
                         "</viewplane>" +
                         camera + "<integrator><path><maxdepth>2</maxdepth></path></integrator><materials>" + material +
                         shining_wall + "</materials><objects>" + prism(3) + "<rectangles><rectangle><corner x='" +
                         decimal(screen) + "' y='-9' z='-9'/>" + vector_text("edge1", 0, top + 9, 0) +
                         "<edge2 x='0' y='0' z='18'/><material>lamp</material></rectangle></rectangles>"
                         "</objects></raytracer>"),
            2, isa);
        INFO(edge << ", " << isa);
        check_channels(channel_means(picture), wanted, 0.01);
      }
  }
}

TEST_CASE("what a prism makes of a beam of the sun on a wall") {
  // The sun comes through a hole in a wall of x = -2 and onto a wall of x = 12, which is looked at along x.
  constexpr double wall = 12, half_hole = 0.15, hole_z = 0.4, pixel = 0.05;
  const PlaneVector in = direction_in();
  const double hole_y = prism_height / 2 - 1.5 * in.y / in.x, middle = landing(0.5, 0.55, wall)->y;
  const auto rectangle = [&](double x, double y0, double y1, double z0, double z1, const std::string& material) {
    return "<rectangle>" + vector_text("corner", x, y0, z0) + vector_text("edge1", 0, y1 - y0, 0) +
           vector_text("edge2", 0, 0, z1 - z0) + "<material>" + material + "</material></rectangle>";
  };
  const std::string rectangles = rectangle(wall, middle - 5, middle + 5, -5, 5, "white") +
                                 rectangle(-2, -30, hole_y - half_hole, -30, 30, "black") +
                                 rectangle(-2, hole_y + half_hole, 30, -30, 30, "black") +
                                 rectangle(-2, hole_y - half_hole, hole_y + half_hole, -30, -hole_z, "black") +
                                 rectangle(-2, hole_y - half_hole, hole_y + half_hole, hole_z, 30, "black");
  const FloatPicture picture = rendered(
      parsed_scene("<raytracer><viewplane><hres>32</hres><vres>80</vres><samples>" +
                   std::string(is_sanitized ? "32" : "256") + "</samples><pixelsize>" + decimal(pixel) +
                   "</pixelsize></viewplane><orthographiccamera>" + vector_text("eye", 4, middle, 0) +
                   vector_text("lookat", wall, middle, 0) +
                   "</orthographiccamera><integrator><path><maxdepth>3</maxdepth><caustics>light</caustics></path>"
                   "</integrator><lights><directionallights><directionallight>" +
                   vector_text("direction", -in.x, -in.y, 0) +
                   "<color red='1' green='1' blue='1'/></directionallight></directionallights></lights><materials>"
                   "<mattes><matte><name>white</name><ka>0</ka><kd>1</kd><cd red='1' green='1' blue='1'/></matte>"
                   "<matte><name>black</name><ka>0</ka><kd>0</kd><cd red='0' green='0' blue='0'/></matte></mattes>" +
                   flint + "</materials><objects>" + prism(0.5) + "<rectangles>" + rectangles +
                   "</rectangles></objects></raytracer>"),
      2);
  SpectrumMeans light{}, moment{};
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 32; ++x) {
      const Pixel& there = picture.at(x, y);
      const std::array<float, 3> channels{there.red, there.green, there.blue};
      for (std::size_t i = 0; i < 3; ++i) {
        light[i] += double{channels[i]} * pixel * pixel;
        moment[i] += double{channels[i]} * pixel * pixel * (39.5 - y) * pixel;
      }
    }
  // Over the hole; up the side by the share that rays through it meet.
  const auto over_hole = [&](const auto& of) {
    return mean_of_spectrum([&](double wavelength) {
      constexpr int steps = 100;
      double sum = 0;
      for (int i = 0; i < steps; ++i) {
        const double from_y = hole_y + half_hole * ((i + 0.5) * 2 / steps - 1);
        // (-2, from_y) + t in is (at - 1, at prism_height).
        const double slope = in.y / in.x, at = (from_y + slope) / (prism_height - slope);
        if (const auto there = landing(at, wavelength, wall)) sum += of(*there) / steps;
      }
      return sum;
    });
  };
  const double arriving = 2 * half_hole * in.x * 2 * hole_z / std::numbers::pi;
  const SpectrumMeans share = over_hole([](const Landing& there) { return there.share; });
  const SpectrumMeans place = over_hole([&](const Landing& there) { return there.share * (there.y - middle); });
  for (std::size_t i = 0; i < 3; ++i) {
    INFO(i << ": " << light[i] << " for " << arriving * share[i] << ", at " << moment[i] / light[i] << " for "
           << place[i] / share[i]);
    CHECK(std::abs(light[i] / (arriving * share[i]) - 1) < (is_sanitized ? 0.1 : 0.03));
    CHECK(std::abs(moment[i] / light[i] - place[i] / share[i]) < (is_sanitized ? 0.05 : 0.015));
  }
  // Blue is bent the most, downwards.
  CHECK(place[2] / share[2] < place[0] / share[0] - 0.5);
}

namespace {

/// A ball under a white sky, which cannot be seen where it loses nothing.
FloatPicture under_white(const std::string& material, int samples) {
  return rendered(
      parsed_scene("<raytracer><integrator><path><maxdepth>100</maxdepth></path></integrator><viewplane><hres>24"
                   "</hres><vres>24</vres><samples>" +
                   std::to_string(samples) +
                   "</samples><background red='1' green='1' blue='1'/></viewplane><camera><eye x='0' y='0.2' "
                   "z='3'/><lookat x='0' y='0' z='0'/><fov>36</fov>"
                   "</camera><materials>" +
                   material +
                   "</materials><objects><spheres><sphere><center x='0' y='0' z='0'/><radius>1</radius>"
                   "<material>flint</material></sphere></spheres></objects></raytracer>"),
      2);
}

std::string flint_of_index(const std::string& index, const std::string& more) {
  return "<dielectrics><dielectric><name>flint</name><ior>" + index + "</ior>" + more + "</dielectric></dielectrics>";
}

}  // namespace

TEST_CASE("what disperses light loses none of it and colours none") {
  const int samples = is_sanitized ? 32 : 256;
  for (const std::string& material :
       {flint, flint_of_openpbr, flint_of_index("1.7", "<abbe>20</abbe><roughness>0.2</roughness>"),
        flint_of_index("1.5", "<abbe>5</abbe><roughness>0.5</roughness>"), flint_of_index("0.8", "<abbe>30</abbe>")}) {
    INFO(material);
    check_channels(channel_means(under_white(material, samples)), {1, 1, 1}, is_sanitized ? 0.02 : 0.006);
  }
}

TEST_CASE("an Abbe number beyond all is none") {
  // Above a floor of stripes that would be shifted.
  const auto scene = [](const std::string& more) {
    return scene_text(
        24, 24, is_sanitized ? 64 : 1024,
        "<integrator><path/></integrator><textures><checkers><checker><name>checks</name><color1 red='1' green='1' "
        "blue='1'/><color2 red='0' green='0' blue='0'/><scale>0.2</scale></checker></checkers></textures><materials>"
        "<mattes><matte><name>floor</name><ka>0</ka><kd>1</kd><cd texture='checks'/></matte></mattes>" +
            flint_of_index("1.7", more) +
            "</materials><objects><spheres><sphere><center x='0' y='0' z='0'/><radius>2</radius><material>flint"
            "</material></sphere></spheres><planes><plane><point x='0' y='-2' z='0'/><normal x='0' y='1' z='0'/>"
            "<material>floor</material></plane></planes></objects>",
        "<eye x='0' y='2' z='9'/><lookat x='0' y='0' z='0'/>");
  };
  const FloatPicture plain = rendered(scene("")), dispersed = rendered(scene("<abbe>1e9</abbe>"));
  check_channels(channel_means(dispersed), channel_means(plain), is_sanitized ? 0.01 : 0.003);
  double differences = 0;
  for (int y = 0; y < 24; ++y)
    for (int x = 0; x < 24; ++x) {
      const double one = difference(dispersed.at(x, y), plain.at(x, y));
      differences += one * one / (24 * 24);
    }
  INFO(std::sqrt(differences));
  CHECK(differences > 0);
  CHECK(std::sqrt(differences) < (is_sanitized ? 0.1 : 0.03));
}

TEST_CASE("between two media that disperse light, the ratio of their indices counts") {
  // A slab of glass in water that goes all around the camera, before a wall that shines.
  const auto slab = [](double from, double to, const std::string& material) {
    return "<box><min x='-9' y='-9' z='" + decimal(from) + "'/><max x='9' y='9' z='" + decimal(to) + "'/><material>" +
           material + "</material></box>";
  };
  const FloatPicture picture = rendered(parsed_scene(
      "<raytracer><viewplane><hres>16</hres><vres>16</vres><samples>256</samples></viewplane><camera>"
      "<eye x='0' y='0' z='0.5'/><lookat x='0' y='0' z='2'/><fov>0.1</fov></camera><integrator><path>"
      "<maxdepth>64</maxdepth></path></integrator><materials><dielectrics><dielectric><name>glass</name><ior>3</ior>"
      "<abbe>4</abbe></dielectric><dielectric><name>water</name><ior>1.5</ior><abbe>3</abbe></dielectric>"
      "</dielectrics>" +
      shining_wall +
      "</materials><objects><rectangles><rectangle><corner x='-9' y='-9' z='0.25'/><edge1 x='18' y='0' z='0'/>"
      "<edge2 x='0' y='18' z='0'/><material>lamp</material></rectangle></rectangles><boxes>" +
      slab(-8, 8, "water") + slab(1, 2, "glass") + "</boxes></objects></raytracer>"));
  const auto fresnel = [](double ratio) { return std::pow((ratio - 1) / (ratio + 1), 2); };
  const auto both = [](double first, double second) {
    return first + (1 - first) * (1 - first) * second / (1 - first * second);
  };
  const SpectrumMeans wanted = mean_of_spectrum([&](double wavelength) {
    const double glass = index_at(wavelength, 3, 4), water = index_at(wavelength, 1.5, 3), r = fresnel(glass / water);
    return both(both(r, r), fresnel(water));
  });
  CHECK(std::abs(wanted[2] - wanted[0]) > 0.03);
  check_channels(channel_means(picture), wanted, 0.01);
}

namespace {

/// A lamp above a ball of flint glass, in water that disperses light as well, and a floor below them.
SceneDescription balls_in_water(const std::string& caustics, int samples, const std::string& roughness) {
  return parsed_scene(
      "<raytracer><viewplane><hres>16</hres><vres>16</vres><samples>" + std::to_string(samples) +
      "</samples></viewplane><camera><eye x='0' y='5' z='5'/><lookat x='0' y='0' z='0.5'/><fov>35</fov></camera>"
      "<integrator><path><maxdepth>10</maxdepth><caustics>" +
      caustics +
      "</caustics></path></integrator><materials><dielectrics><dielectric><name>glass</name><ior>1.8</ior>"
      "<abbe>8</abbe><roughness>" +
      roughness +
      "</roughness><priority>1</priority></dielectric><dielectric><name>water</name><ior>1.33</ior><abbe>10</abbe>"
      "</dielectric></dielectrics><mattes><matte><name>grey</name><ka>0</ka><kd>1</kd>"
      "<cd red='0.6' green='0.6' blue='0.6'/></matte></mattes><emissives><emissive><name>lamp</name>"
      "<ce red='9' green='9' blue='9'/></emissive></emissives></materials><objects><planes><plane>"
      "<point x='0' y='-0.2' z='0'/><normal x='0' y='1' z='0'/><material>grey</material></plane></planes><boxes><box>"
      "<min x='-1.4' y='0.1' z='-1.4'/><max x='1.4' y='0.9' z='1.4'/><material>water</material></box></boxes><spheres>"
      "<sphere><center x='-0.3' y='0.9' z='0'/><radius>0.6</radius><material>glass</material></sphere><sphere>"
      "<center x='0.7' y='2.4' z='0.3'/><radius>0.4</radius><material>lamp</material></sphere></spheres></objects>"
      "</raytracer>");
}

}  // namespace

TEST_CASE("light paths disperse light as paths from the camera do") {
  for (const std::string roughness : {"0", "0.15"}) {
    const SpectrumMeans by_chance =
        channel_means(rendered(balls_in_water("none", is_sanitized ? 128 : 2048, roughness), 2));
    const SpectrumMeans by_light =
        channel_means(rendered(balls_in_water("light", is_sanitized ? 64 : 512, roughness), 2));
    INFO(roughness << ": " << channels_text(by_light) << " for " << channels_text(by_chance));
    for (std::size_t i = 0; i < 3; ++i) CHECK(std::abs(by_light[i] / by_chance[i] - 1) < (is_sanitized ? 0.1 : 0.03));
  }
}

TEST_CASE("paths with wavelengths have the same bits however they are cut") {
  check_same_bits(balls_in_water("light", 16, "0.15"));
  check_same_bits(balls_in_water("none", 16, "0"));
}

}  // namespace raytrace::test
