// Pictures of scenes in an environment.
//
// Not with the thread sanitizer: statistics of code that cuts_test runs in threads.
#include <array>
#include <cmath>
#include <cstring>
#include <string>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

/// `light` stands in its element.
std::string in_environment(std::string text, const std::string& light = "") {
  const std::string root = "<raytracer>";
  return text.insert(text.find(root) + root.size(), "<lights><environmentlights><environmentlight>" + light +
                                                        "</environmentlight></environmentlights></lights>");
}

/// Gives the scene's environment a picture of floats. at(column, row): its grey, rows from the top.
template <class At>
void set_picture(SceneDescription& scene, int width, int height, const At& at) {
  Picture picture{width, height, 1, TexelFormat::floats, {}};
  const std::size_t texels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  picture.pixels = LargeArray<std::byte>::zeros(texels * sizeof(float));
  for (std::size_t i = 0; i < texels; ++i) {
    const auto grey = static_cast<float>(at(static_cast<int>(i) % width, static_cast<int>(i) / width));
    std::memcpy(picture.pixels.data() + i * sizeof grey, &grey, sizeof grey);
  }
  LightItem<EnvironmentLight>& light = std::get<LightItems<EnvironmentLight>>(scene.lights).at(0);
  light.parameters.file.path = "made";
  light.image = {"made", std::make_shared<const TexelImage>(picture, false, 1), nullptr};
}

const std::string white_sphere =
    "<materials><mattes><matte><name>m</name><ka>0</ka><kd>1</kd><cd red='1' green='1' blue='1'/></matte></mattes>"
    "</materials><objects><spheres><sphere><center x='0' y='0' z='0'/><radius>1</radius><material>m</material>"
    "</sphere></spheres></objects>";
const std::string white_floor =
    "<materials><mattes><matte><name>m</name><ka>0</ka><kd>1</kd><cd red='1' green='1' blue='1'/></matte></mattes>"
    "</materials><objects><planes><plane><point x='0' y='0' z='0'/><normal x='0' y='1' z='0'/><material>m</material>"
    "</plane></planes></objects>";
const std::string from_above = "<eye x='0' y='3' z='0.1'/><lookat x='0' y='0' z='0'/>";

bool is_gray(const Pixel& pixel, double grey, double most) {
  return std::abs(pixel.red - grey) < most && std::abs(pixel.green - grey) < most && std::abs(pixel.blue - grey) < most;
}

}  // namespace

TEST_CASE("a white matte sphere in an even environment cannot be seen") {
  for (const std::string& isa : usable_isas()) {
    const FloatPicture picture = rendered(
        parsed_scene(in_environment(scene_text(12, 9, 256, white_sphere), "<scaleradiance>0.5</scaleradiance>")), 1,
        isa);
    // Light is drawn, so samples differ.
    int wrong = 0;
    double mean = 0;
    for (const Pixel& pixel : picture.pixels()) {
      wrong += !is_gray(pixel, 0.5, 0.05);
      mean += double{pixel.red} / static_cast<double>(picture.pixels().size());
    }
    CHECK(wrong == 0);
    CHECK(std::abs(mean - 0.5) < 0.002);
  }
}

TEST_CASE("of an environment that is bright on one side, a floor gets half") {
  SceneDescription scene = parsed_scene(in_environment(scene_text(8, 8, 256, white_floor, from_above)));
  set_picture(scene, 16, 8, [](int x, int) { return x < 8 ? 1 : 0; });
  CHECK(std::abs(mean_green(rendered(scene)) - 0.5) < 0.005);
}

TEST_CASE("an environment with a ground is even with height") {
  const double ground = GENERATE(0.2, 0.0, 3.0);
  const std::string light = "<ground>" + std::to_string(ground) + "</ground>";
  const auto mean = [&](const std::string& objects, const std::string& camera, int samples) {
    std::string text = in_environment(scene_text(8, 8, samples, objects, camera), light);
    const std::string wide = "<viewdistance>8";
    text.replace(text.find(wide), wide.size(), "<viewdistance>10000");
    const FloatPicture picture = rendered(parsed_scene(text));
    double sum = 0;
    for (const Pixel& pixel : picture.pixels()) sum += double{pixel.red} / static_cast<double>(picture.pixels().size());
    return sum;
  };
  INFO(ground);
  // What the camera sees, looking up, down and to the horizon.
  const std::string eye = "<eye x='0' y='3' z='0'/>";
  CHECK(std::abs(mean("", eye + "<lookat x='0' y='9' z='0.01'/>", 1) - 1) < 1e-3);
  CHECK(std::abs(mean("", eye + "<lookat x='0' y='-9' z='0.01'/>", 1) - ground) < 1e-3);
  CHECK(std::abs(mean("", eye + "<lookat x='0' y='3' z='1'/>", 1) - (1 + ground) / 2) < 1e-3);
  // On a white floor, the sum of (ground + (1 - ground) (1 + y) / 2) y over the upper half, over pi.
  CHECK(std::abs(mean(white_floor, from_above, 256) / (ground + (1 - ground) * 5 / 6) - 1) < 0.005);
  const std::string from_below = "<eye x='0' y='-3' z='0.1'/><lookat x='0' y='0' z='0'/>";
  CHECK(std::abs(mean(white_floor, from_below, 256) - (ground + (1 - ground) / 6)) < 0.005);
}

TEST_CASE("a spherical camera that looks at +z sees an environment's picture") {
  std::string text = in_environment(scene_text(24, 12, 1, white_sphere));
  const std::size_t begin = text.find("<camera>"), end = text.find("</camera>") + 9;
  text.replace(begin, end - begin,
               "<sphericalcamera><eye x='0' y='99' z='0'/><lookat x='0' y='99' z='1'/></sphericalcamera>");
  SceneDescription scene = parsed_scene(text);
  const auto grey = [](int x, int y) { return 1 + (x * 7 + y * 5) % 13; };
  set_picture(scene, 24, 12, grey);
  const FloatPicture picture = rendered(scene);
  double worst = 0;
  for (int y = 0; y < 11; ++y)  // the sphere is straight below
    for (int x = 0; x < 24; ++x) worst = std::max(worst, std::abs(double{picture.at(x, y).red} - grey(x, y)));
  CHECK(worst < 1e-3);
}

TEST_CASE("the camera sees the background where an environment is not visible, and the environment else") {
  const std::string integrator = GENERATE("path", "raycast");
  const auto corner = [&](const std::string& visible) {
    std::string text = in_environment(scene_text(12, 9, 256, white_sphere), visible);
    text.insert(text.find("<viewplane>"), "<integrator><" + integrator + "/></integrator>");
    return rendered(text);
  };
  CHECK(is_gray(corner("").at(0, 0), 1, 1e-6));
  CHECK(is_gray(corner("<visible>true</visible>").at(0, 0), 1, 1e-6));
  const FloatPicture hidden = corner("<visible>false</visible>");
  CHECK(hidden.at(0, 0).red == 0.1F);
  CHECK(hidden.at(0, 0).blue == 0.4F);
  CHECK(is_gray(hidden.at(6, 4), integrator == "path" ? 1 : 0, 0.1));
}

TEST_CASE("a scene with an environment is rendered by paths, unless it says otherwise") {
  const std::string text = in_environment(scene_text(12, 9, 4, white_sphere));
  const auto by = [&](const std::string& integrator) {
    std::string changed = text;
    return rendered(changed.insert(changed.find("<viewplane>"), "<integrator><" + integrator + "/></integrator>"));
  };
  CHECK(identical(rendered(text), by("path")));
  CHECK_FALSE(identical(rendered(text), by("raycast")));
}

TEST_CASE("a transparent picture has no environment, but its light") {
  const SceneDescription description = parsed_scene(in_environment(scene_text(12, 9, 256, white_sphere)));
  const auto scene = build_scene(description, {1, {}});
  FilmSettings settings = film_settings(*scene, description, {1, 0, whole(description)});
  settings.transparent = true;
  Film film(settings, FilmContent::sums);
  render(*scene, film, 256, 1);
  CHECK(is_gray(film.pixel(0, 0), 0, 1e-9));
  CHECK(film.pixel(0, 0).alpha == 0);
  const Pixel of_sphere = film.pixel(6, 4);
  CHECK(of_sphere.alpha > 0.9F);
  CHECK(is_gray(of_sphere, of_sphere.alpha, 0.1));
}

TEST_CASE("a picture in an environment does not depend on threads, samples at once, or how it is cut") {
  SceneDescription description = parsed_scene(in_environment(busy_scene(41, 37, 16)));
  set_picture(description, 31, 15, [](int x, int y) { return x == 9 && y == 3 ? 300 : 0.1 * (x % 5); });
  check_same_bits(description);
}

}  // namespace raytrace::test
