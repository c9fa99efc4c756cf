// Light that is scattered below surfaces, and inside of clear things, against closed forms and walks of the test's own.
//
// Not with the thread sanitizer: statistics of code that cuts_test runs in threads.
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/sanitized.h"

namespace raytrace::test {

namespace {

constexpr int sss_size = 16, sss_samples = is_sanitized ? 64 : 1024;

struct Estimate {
  Rgb<double> mean{0, 0, 0}, error{0, 0, 0};  ///< error: of the mean, one standard deviation
};

/// Of all pixels, which have one expectation.
Estimate estimate_of(const FloatPicture& picture) {
  Estimate result;
  const auto count = static_cast<double>(picture.pixels().size());
  for (const auto channel : {&Rgb<double>::red, &Rgb<double>::green, &Rgb<double>::blue}) {
    double sum = 0, squares = 0;
    for (const Pixel& pixel : picture.pixels()) {
      const double value = channel == &Rgb<double>::red     ? pixel.red
                           : channel == &Rgb<double>::green ? pixel.green
                                                            : pixel.blue;
      sum += value;
      squares += value * value;
    }
    result.mean.*channel = sum / count;
    result.error.*channel = std::sqrt(std::max(squares / count - sum * sum / (count * count), 0.0) / count);
  }
  return result;
}

std::string wax(const std::string& more) {
  return "<openpbr><name>wax</name><specular_weight>0</specular_weight><subsurface_weight>1</subsurface_weight>" +
         more + "</openpbr>";
}
const std::string wax_ball =
    "<spheres><sphere><center x='0' y='0' z='0'/><radius>1</radius><material>wax</material></sphere></spheres>";

/// What fills the picture, under a white sky.
Estimate under_white_sky(const std::string& material, const std::string& objects,
                         const std::string& more_materials = "") {
  return estimate_of(rendered(
      "<raytracer><integrator><path><maxdepth>50</maxdepth></path></integrator><viewplane><hres>" +
      std::to_string(sss_size) + "</hres><vres>" + std::to_string(sss_size) + "</vres><samples>" +
      std::to_string(sss_samples) +
      "</samples><background red='1' green='1' blue='1'/></viewplane><camera><eye x='0' y='0.2' z='3'/><lookat x='0' "
      "y='0' z='0'/><fov>16</fov></camera><materials>" +
      more_materials + "<openpbrs>" + material + "</openpbrs></materials><objects>" + objects +
      "</objects></raytracer>"));
}

void check_mean(const Estimate& estimate, const Rgb<double>& expected, double also = 0) {
  for (const auto channel : {&Rgb<double>::red, &Rgb<double>::green, &Rgb<double>::blue}) {
    INFO(estimate.mean.*channel << " +- " << estimate.error.*channel << ", expected " << expected.*channel);
    CHECK(std::abs(estimate.mean.*channel - expected.*channel) < 4 * estimate.error.*channel + also);
  }
}

/// OpenPBR 1.1.1's albedo of one scattering.
double single_albedo(double color, double g) {
  const double s = 4.09712 + 4.20863 * color - std::sqrt(9.59217 + 41.6808 * color + 17.7126 * color * color);
  return (1 - s * s) / (1 - g * s * s);
}

/// What a half-space that scatters evenly sends back of evenly spread light: 1 - 2 sqrt(1 - albedo) times the first
/// moment of Chandrasekhar's H function ("Radiative Transfer", 1960, chapter V), which is found by iteration.
double half_space_albedo(double albedo) {
  constexpr int steps = 500;
  std::vector<double> h(steps, 1.0);
  const auto at = [](int i) { return (i + 0.5) / steps; };
  for (int round = 0; round < 200; ++round) {
    std::vector<double> next(steps);
    for (int i = 0; i < steps; ++i) {
      double integral = 0;
      for (int j = 0; j < steps; ++j) integral += h[static_cast<std::size_t>(j)] * at(j) / (at(i) + at(j)) / steps;
      next[static_cast<std::size_t>(i)] = 1 / (std::sqrt(1 - albedo) + albedo / 2 * integral);
    }
    double change = 0;
    for (std::size_t i = 0; i < next.size(); ++i) change = std::max(change, std::abs(next[i] - h[i]));
    h = next;
    if (change < 1e-7) break;
  }
  double moment = 0;
  for (int i = 0; i < steps; ++i) moment += h[static_cast<std::size_t>(i)] * at(i) / steps;
  return 1 - 2 * std::sqrt(1 - albedo) * moment;
}

/// Walks in a ball of radius 1, in double.
struct Walked {
  double free_path, g;
  double start = 1;       ///< on the z axis; they go downwards,
  bool is_spread = true;  ///< or spread evenly below its surface

  /// What comes out of light of one.
  double share_out(double albedo) const {
    std::mt19937_64 bits(11);
    const auto unit = [&] { return std::uniform_real_distribution<double>()(bits); };
    constexpr int walks = 200000;
    double sum = 0;
    for (int i = 0; i < walks; ++i) {
      Vec3d p{0, 0, start}, d{0, 0, -1};
      if (is_spread) d = turned(d, std::sqrt(unit()), unit());
      for (double weight = 1; weight > 1e-6; weight *= albedo) {
        const double along = dot(p, d), step = -free_path * std::log(1 - unit());
        if (step >= -along + std::sqrt(std::max(along * along - dot(p, p) + 1, 0.0))) {
          sum += weight;
          break;
        }
        p = p + d * step;
        const double part = (1 - g * g) / (1 - g + 2 * g * unit());
        d = turned(d, g == 0 ? 2 * unit() - 1 : (1 + g * g - part * part) / (2 * g), unit());
      }
    }
    return sum / walks;
  }

 private:
  /// By an angle of that cosine, about d by so much of a turn.
  static Vec3d turned(const Vec3d& d, double cosine, double turn) {
    const Vec3d x = normalize(cross(d, std::abs(d.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0})), y = cross(d, x);
    const double sine = std::sqrt(std::max(1 - cosine * cosine, 0.0)), angle = 2 * std::numbers::pi * turn;
    return normalize(d * cosine + x * (sine * std::cos(angle)) + y * (sine * std::sin(angle)));
  }
};

}  // namespace

TEST_CASE("below a plane, light is scattered as Chandrasekhar has it, and looks as subsurface_color says") {
  const Rgb<double> color{0.9, 0.5, 0.2};
  const Estimate plane = under_white_sky(
      wax("<subsurface_color red='0.9' green='0.5' blue='0.2'/><subsurface_radius>0.05</subsurface_radius>"),
      "<planes><plane><point x='0' y='0' z='0'/><normal x='0' y='1' "
      "z='0.5'/><material>wax</material></plane></planes>");
  check_mean(plane, {half_space_albedo(single_albedo(color.red, 0)), half_space_albedo(single_albedo(color.green, 0)),
                     half_space_albedo(single_albedo(color.blue, 0))});
  check_mean(plane, color, 0.005);
  // Without a radius it is diffuse, within what rounding leaves of a flight.
  const Estimate dense = under_white_sky(
      wax("<subsurface_color red='0.9' green='0.5' blue='0.2'/><subsurface_radius>0</subsurface_radius>"), wax_ball);
  check_mean(dense, color, 0.01);
}

TEST_CASE("a ball that scatters light inside, whatever the phase function, is as independent walks find it") {
  for (const double g : {0.0, 0.7, -0.5}) {
    INFO("anisotropy " << g);
    const Estimate ball = under_white_sky(
        wax("<subsurface_color red='0.8' green='0.8' blue='0.3'/><subsurface_radius>0.5</subsurface_radius>"
            "<subsurface_radius_scale red='1' green='0.2' blue='0.6'/><subsurface_scatter_anisotropy>" +
            std::to_string(g) + "</subsurface_scatter_anisotropy>"),
        wax_ball);
    const double bright = single_albedo(0.8, g), dark = single_albedo(0.3, g);
    check_mean(ball,
               {Walked{0.5, g}.share_out(bright), Walked{0.1, g}.share_out(bright), Walked{0.3, g}.share_out(dark)},
               0.003);
  }
}

TEST_CASE("what scatters light inside and absorbs none cannot be seen under a white sky") {
  const std::string white = "<subsurface_color red='1' green='1' blue='1'/><subsurface_radius>0.3</subsurface_radius>";
  for (const std::string more :
       {"", "<specular_weight>1</specular_weight>", "<specular_weight>1</specular_weight><coat_weight>1</coat_weight>",
        "<specular_weight>1</specular_weight><thin_film_weight>1</thin_film_weight>", "<fuzz_weight>1</fuzz_weight>",
        "<geometry_thin_walled>true</geometry_thin_walled>"}) {
    INFO(more);
    std::string material = wax(white);
    if (more.find("<specular") == 0) material.erase(material.find("<specular_weight>0</specular_weight>"), 36);
    material.insert(material.find("</openpbr>"), more);
    check_mean(under_white_sky(material, wax_ball), {1, 1, 1}, 0.004);
  }
}

TEST_CASE("a part of an object inside of it, and other objects there, take nothing from light below its surface") {
  const std::string color = "<subsurface_color red='0.7' green='0.5' blue='0.3'/>",
                    matte =
                        "<mattes><matte><name>black</name><ka>0</ka><kd>0</kd><cd red='0' green='0' blue='0'/>"
                        "</matte></mattes>";
  const auto cube = [](double edge, int first) {
    std::string positions, faces;
    for (int i = 0; i < 8; ++i)
      for (const int bit : {1, 2, 4}) positions += std::to_string((i & bit) != 0 ? edge : -edge) + " ";
    for (const auto& [a, b, c, d] :
         {std::array{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}})
      for (const int vertex : {a, b, c, a, c, d}) faces += std::to_string(vertex + first) + " ";
    return std::pair(positions, faces);
  };
  const auto mesh = [](const std::string& positions, const std::string& faces) {
    return "<meshes><mesh><positions>" + positions + "</positions><faces>" + faces +
           "</faces><material>wax</material></mesh></meshes>";
  };
  const auto [outer, outer_faces] = cube(1, 0);
  const auto [inner, inner_faces] = cube(0.9, 8);
  const Estimate alone = under_white_sky(wax(color), mesh(outer, outer_faces), matte),
                 doubled = under_white_sky(wax(color), mesh(outer + inner, outer_faces + inner_faces), matte),
                 stuffed = under_white_sky(wax(color),
                                           "<spheres><sphere><center x='0' y='0' z='0'/><radius>0.9</radius><material>"
                                           "black</material></sphere></spheres>" +
                                               mesh(outer, outer_faces),
                                           matte);
  for (const Estimate& other : {doubled, stuffed})
    check_mean(other, alone.mean, 4 * std::max({alone.error.red, alone.error.green, alone.error.blue}));
}

TEST_CASE("a thin wall sends what it scatters back and on, by its anisotropy") {
  const auto wall = [](const std::string& materials, bool from_behind) {
    return estimate_of(rendered(
        "<raytracer><integrator><path/></integrator><viewplane><hres>4</hres><vres>4</vres><samples>256</samples>"
        "</viewplane><camera><eye x='0' y='0' z='3'/><lookat x='0' y='0' z='0'/><fov>5</fov></camera><lights>"
        "<directionallights><directionallight><direction x='0' y='1' z='" +
        std::string(from_behind ? "-1" : "1") + "'/></directionallight></directionallights></lights><materials>" +
        materials +
        "</materials><objects><rectangles><rectangle><corner x='-1' y='-1' z='0'/><edge1 x='2' y='0' "
        "z='0'/><edge2 x='0' y='2' z='0'/><material>wax</material></rectangle></rectangles></objects></raytracer>"));
  };
  const double white =
      wall("<mattes><matte><name>wax</name><ka>0</ka><kd>1</kd><cd red='1' green='1' blue='1'/></matte></mattes>",
           false)
          .mean.red;
  for (const double g : {0.0, 0.6, -1.0, 1.0})
    for (const bool from_behind : {false, true}) {
      INFO("anisotropy " << g << (from_behind ? ", light from behind" : ""));
      const std::string sheet =
          wax("<subsurface_color red='0.9' green='0.5' blue='0.2'/><geometry_thin_walled>true</geometry_thin_walled>"
              "<subsurface_scatter_anisotropy>" +
              std::to_string(g) + "</subsurface_scatter_anisotropy>");
      const double share = (from_behind ? 1 + g : 1 - g) / 2;
      check_mean(wall("<openpbrs>" + sheet + "</openpbrs>", from_behind), Rgb<double>{0.9, 0.5, 0.2} * (share * white),
                 1e-5);
    }
  // A texture multiplies it.
  const std::string halves =
      "</materials><textures><checkers><checker><name>half</name><color1 red='0.5' green='0.5' blue='0.5'/><color2 "
      "red='0.5' green='0.5' blue='0.5'/></checker></checkers></textures><materials>";
  for (const bool from_behind : {false, true})
    check_mean(wall("<openpbrs>" +
                        wax("<subsurface_color red='1' green='1' "
                            "blue='1'/><geometry_thin_walled>true</geometry_thin_walled>"
                            "<subsurface_scatter_anisotropy texture='half'>-0.8</subsurface_scatter_anisotropy>") +
                        "</openpbrs>" + halves,
                    from_behind),
               Rgb<double>{1, 1, 1} * ((from_behind ? 0.3 : 0.7) * white), 1e-5);
}

TEST_CASE("what scatters light inside of clear things is as independent walks find it, from outside and from within") {
  // Without a boundary: of index 1.
  const auto through = [](double eye, double g, const std::string& color, const std::string& ior) {
    return estimate_of(rendered(
        "<raytracer><integrator><path><maxdepth>100</maxdepth></path></integrator><viewplane><hres>16</hres><vres>16"
        "</vres><samples>" +
        std::to_string(sss_samples) +
        "</samples><background red='1' green='1' blue='1'/>"
        "</viewplane><camera><eye x='0' y='0' z='" +
        std::to_string(eye) +
        "'/><lookat x='0' y='0' z='-9'/><fov>0.2"
        "</fov></camera><materials><openpbrs><openpbr><name>wax</name><specular_roughness>0</specular_roughness>"
        "<specular_ior>" +
        ior +
        "</specular_ior><transmission_weight>1</transmission_weight><transmission_depth>0.5"
        "</transmission_depth>" +
        color +
        "<transmission_scatter red='1' green='0.5' blue='0.25'/>"
        "<transmission_scatter_anisotropy>" +
        std::to_string(g) +
        "</transmission_scatter_anisotropy></openpbr>"
        "</openpbrs></materials><objects>" +
        wax_ball + "</objects></raytracer>"));
  };
  const std::string dark = "<transmission_color red='0.2' green='0.2' blue='0.2'/>";
  const double extinction = -std::log(0.2) / 0.5;
  for (const double g : {0.0, 0.7})
    for (const double eye : {5.0, 0.1}) {
      INFO("anisotropy " << g << ", from " << eye);
      const Walked ball{1 / extinction, g, std::min(eye, 1.0), false};
      const auto expected = [&](double scatter) { return ball.share_out(scatter / 0.5 / extinction); };
      check_mean(through(eye, g, dark, "1"), {expected(1), expected(0.5), expected(0.25)}, 0.001);
    }
  // Where all of red is scattered and none absorbed, a ball of glass is not there for red; from within, radiance is
  // that of glass.
  CHECK(through(5, 0, "", "1.5").mean.red == Approx(1).epsilon(1e-4));
  CHECK(through(0.1, 0, "", "1.5").mean.red == Approx(1.5 * 1.5).epsilon(1e-4));
}

TEST_CASE("without paths, what would go below the surface is diffuse") {
  const auto ball_of = [&](const std::string& material) {
    return rendered(
        "<raytracer><integrator><raycast/></integrator><viewplane><hres>16</hres><vres>16</vres><samples>4</samples>"
        "</viewplane><camera><eye x='0' y='0' z='4'/><lookat x='0' y='0' z='0'/><fov>30</fov></camera><lights>"
        "<pointlights><pointlight><location x='3' y='4' z='5'/></pointlight></pointlights></lights><materials>"
        "<openpbrs>" +
        material + "</openpbrs></materials><objects>" + wax_ball + "</objects></raytracer>");
  };
  const FloatPicture inside = ball_of(
                         "<openpbr><name>wax</name><base_color red='1' green='0.5' "
                         "blue='0.5'/><subsurface_weight>0.5</subsurface_weight>"
                         "<subsurface_color red='0.5' green='0.5' blue='1'/></openpbr>"),
                     diffuse =
                         ball_of("<openpbr><name>wax</name><base_color red='0.75' green='0.5' blue='0.75'/></openpbr>");
  double worst = 0;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) worst = std::max(worst, difference(inside.at(x, y), diffuse.at(x, y)));
  CHECK(worst < 1e-6);
}

TEST_CASE("walks below surfaces do not depend on threads, samples at once, or cuts") {
  check_same_bits_of_balls(
      "<openpbrs><openpbr><name>wax</name><subsurface_weight texture='checks'/><subsurface_color texture='checks'/>"
      "<subsurface_radius>0.2</subsurface_radius><opacity>0.9</opacity></openpbr><openpbr><name>sheet</name>"
      "<subsurface_weight>0.8</subsurface_weight><geometry_thin_walled>true</geometry_thin_walled></openpbr>"
      "<openpbr><name>milk</name><transmission_weight>1</transmission_weight><transmission_depth>0.3</"
      "transmission_depth><transmission_scatter red='1' green='0.8' blue='0.5'/></openpbr></openpbrs>",
      {"sheet", "milk", "wax"});
}

}  // namespace raytrace::test
