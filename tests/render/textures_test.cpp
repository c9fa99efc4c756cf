// Textured scenes: the same bits however a picture is cut, no aliasing, and what AOVs and the film's unit know of them.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/sanitized.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

constexpr const char* textures =
    "<textures><checkers><checker><name>squares</name></checker><checker><name>cubes</name><scale>0.4</scale>"
    "<color1 red='0.9' green='0.2' blue='0.1'/></checker></checkers><noises><noise><name>clouds</name></noise></noises>"
    "<images><image><name>picture</name><file>made</file></image></images></textures>";

constexpr const char* ambient_only = "<lights><ambientlight><scaleradiance>1</scaleradiance></ambientlight></lights>";

/// Gives the scene's image its texels.
SceneDescription with_image(SceneDescription scene) {
  Picture picture{16, 16, 4, TexelFormat::bytes, LargeArray<std::byte>::zeros(16 * 16 * 4)};
  for (std::size_t i = 0; i < 16 * 16 * 4; ++i) picture.pixels[i] = static_cast<std::byte>(i * 37 % 251);
  const auto texels = std::make_shared<const TexelImage>(picture, true, 1);
  std::get<TextureItems<Image>>(scene.textures).at(0).image = {"made", texels, texels};
  return scene;
}

/// Each texture on something, with materials without any among them.
SceneDescription textured_scene(int width, int height, int samples) {
  std::string spheres;
  const char* const materials[] = {"squares", "plain", "clouds", "picture", "cubes", "all"};
  for (int i = 0; i < 40; ++i)
    spheres += "<sphere>" + vector_text("center", i % 8 * 0.9 - 3.2, i / 8 * 0.9 - 1.5, (i * 7 % 5) * 0.5) +
               "<radius>0.43</radius><material>" + materials[i % 6] + "</material></sphere>";
  const auto matte = [](const std::string& name) {
    return "<matte><name>" + name + "</name><ka>0.2</ka><kd>0.8</kd><cd texture='" + name + "'/></matte>";
  };
  const std::string parts =
      std::string(textures) +
      "<lights><ambientlight/><pointlights><pointlight><location x='5' y='8' z='9'/><scaleradiance>3</scaleradiance>"
      "</pointlight></pointlights></lights><materials><mattes>" +
      matte("squares") + matte("clouds") + matte("picture") + matte("cubes") +
      "<matte><name>plain</name><ka>0.2</ka><kd>0.7</kd><cd red='1' green='0.5' blue='0.2'/></matte></mattes>"
      "<phongs><phong><name>all</name><ka texture='clouds'>0.5</ka><kd texture='picture' channel='green'/>"
      "<ks texture='cubes'>0.5</ks><cd texture='picture'/><cs texture='clouds'/><exp texture='picture' "
      "channel='alpha'>90</exp></phong></phongs></materials><objects><spheres>" +
      spheres +
      "</spheres><planes><plane><point x='0' y='-2' z='0'/><normal x='0' y='1' z='0'/><material>squares</material>"
      "</plane></planes></objects>";
  return with_image(parsed_scene(scene_text(width, height, samples, parts)));
}

/// A plane of squares up to the horizon under ambient light.
std::string checkered_plane(int samples) {
  return scene_text(
      96, 64, samples,
      std::string(ambient_only) +
          "<textures><checkers><checker><name>squares</name><scale>1</scale></checker></checkers></textures>"
          "<materials><mattes><matte><name>m</name><ka>1</ka><kd>0</kd><cd texture='squares'/></matte></mattes>"
          "</materials><objects><planes><plane><point x='0.25' y='0.5' z='0.25'/><normal x='0' y='1' z='0'/>"
          "<material>m</material></plane></planes></objects>",
      "<eye x='0' y='2' z='0'/><lookat x='-3' y='1.4' z='-8'/>");
}

}  // namespace

TEST_CASE("a textured picture has the same bits from any number of threads and in any crop") {
  for (const int samples : {1, 3, 16}) {  // packets of several shapes
    const SceneDescription description = textured_scene(70, 50, samples);
    for (const std::string& isa : usable_isas()) {
      const FloatPicture wanted = rendered(description, 1, isa);
      INFO(isa << ", " << samples << " samples");
      CHECK(identical(rendered(description, 3, isa), wanted));
      const auto scene = build_scene(description, {1, isa});
      RayCounts rays;
      for (const Region& crop : {Region{3, 5, 4, 6}, Region{17, 11, 61, 40}, Region{0, 33, 70, 34}}) {
        const FloatPicture part = render(*scene, description, {1, 0, crop}, rays);
        int wrong = 0;
        for (int y = crop.y0; y < crop.y1; ++y)
          for (int x = crop.x0; x < crop.x1; ++x) wrong += !identical(part.at(x, y), wanted.at(x, y));
        CHECK(wrong == 0);
      }
    }
  }
}

TEST_CASE("a textured picture's samples have the same bits in any range of them") {
  const SceneDescription description = textured_scene(40, 30, 12);
  const auto scene = build_scene(description, {1, {}});
  RayCounts rays;
  const Film all = render(*scene, description, {1, 0, whole(description)}, rays);
  RenderSettings settings{1, 0, whole(description), SampleRange{0, 12, false}};
  Film pieces(film_settings(*scene, description, settings));
  for (const std::uint32_t samples : {1U, 6U, 7U, 12U}) render(*scene, pieces, samples, 1);
  CHECK(identical(FloatPicture(pieces), FloatPicture(all)));
}

TEST_CASE("a checkered plane to the horizon has no aliasing at 4 samples") {
  const FloatPicture wanted = rendered(parsed_scene(checkered_plane(is_sanitized ? 512 : 4096)));
  const FloatPicture few = rendered(parsed_scene(checkered_plane(4)));
  double sum = 0, worst_far = 0;
  int count = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 96; ++x) {
      const double difference = std::abs(static_cast<double>(few.at(x, y).green - wanted.at(x, y).green));
      sum += difference;
      ++count;
      // Where a pixel covers whole squares, they are grey.
      const bool far = y < 26 && wanted.at(x, y).blue == wanted.at(x, y).green;
      if (far) worst_far = std::max(worst_far, difference);
    }
  CHECK(sum / count < 0.02);
  CHECK(worst_far < 0.15);
}

TEST_CASE("an image lies upright on a rectangle, and its upper half is that of a sphere") {
  const auto picture_of = [](const std::string& object) {
    const std::string parts =
        std::string(ambient_only) +
        "<textures><images><image><name>i</name><file>made</file><colorspace>linear</colorspace><filter>nearest</"
        "filter>"
        "</image></images></textures><materials><mattes><matte><name>m</name><ka>1</ka><kd>0</kd><cd texture='i'/>"
        "</matte></mattes></materials><objects>" +
        object + "</objects>";
    SceneDescription scene =
        parsed_scene(scene_text(32, 32, 1, parts, "<eye x='0' y='0' z='20'/><lookat x='0' y='0' z='0'/>"));
    Picture picture{2, 2, 4, TexelFormat::bytes, LargeArray<std::byte>::zeros(16)};
    const std::array<unsigned char, 16> texels{255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255};
    for (std::size_t i = 0; i < texels.size(); ++i) picture.pixels[i] = static_cast<std::byte>(texels[i]);
    const auto made = std::make_shared<const TexelImage>(picture, false, 1);
    std::get<TextureItems<Image>>(scene.textures).at(0).image = {"made", made, made};
    return rendered(scene);
  };
  const FloatPicture rectangle = picture_of(
      "<rectangles><rectangle><corner x='-8' y='-8' z='0'/><edge1 x='16' y='0' z='0'/><edge2 x='0' y='16' z='0'/>"
      "<material>m</material></rectangle></rectangles>");
  const auto color = [](const Pixel& p) { return std::array{p.red, p.green, p.blue}; };
  CHECK(color(rectangle.at(11, 11)) == std::array{1.0F, 0.0F, 0.0F});
  CHECK(color(rectangle.at(20, 11)) == std::array{0.0F, 1.0F, 0.0F});
  CHECK(color(rectangle.at(11, 20)) == std::array{0.0F, 0.0F, 1.0F});
  CHECK(color(rectangle.at(20, 20)) == std::array{1.0F, 1.0F, 1.0F});
  const FloatPicture sphere = picture_of(
      "<spheres><sphere><center x='0' y='0' z='0'/><radius>8</radius><material>m</material></sphere></spheres>");
  CHECK(sphere.at(11, 10).blue == 0);
  CHECK(sphere.at(20, 10).blue == 0);
  CHECK(sphere.at(11, 21).blue == 1);
  CHECK(sphere.at(20, 21).blue == 1);
}

TEST_CASE("the albedo of a textured surface is the texture's, times its own") {
  const std::string parts =
      std::string(ambient_only) + textures +
      "<materials><mattes><matte><name>m</name><ka>0</ka><kd>0.5</kd><cd red='1' green='0.5' blue='1' "
      "texture='cubes'/></matte></mattes></materials><objects><spheres><sphere><center x='0' y='0' z='0'/>"
      "<radius>3</radius><material>m</material></sphere></spheres></objects>";
  const SceneDescription description = with_image(parsed_scene(scene_text(32, 24, 1, parts)));
  CHECK(build_scene(description, {1, {}})->largest_albedo() == Approx(0.45));  // 0.5 times the largest channel, 0.9
  const ImageBand band = picture_aovs(description, {"albedo"});
  int red = 0, black = 0;
  for (std::size_t i = 0; i < 32 * 24; ++i) {
    const auto value = [&](std::size_t plane) {
      return std::visit([&](const auto& values) { return static_cast<double>(values[i]); }, band.planes[plane]);
    };
    red += std::abs(value(0) - 0.45) < 1e-3 && std::abs(value(1) - 0.05) < 1e-3 && std::abs(value(2) - 0.05) < 1e-3;
    black += value(0) == 0 && value(1) == 0;
  }
  CHECK(red > 10);
  CHECK(black > 10);
}

TEST_CASE("the film's unit leaves room for what textures multiply") {
  const auto range_with = [](const std::string& color) {
    const std::string parts =
        std::string(ambient_only) + "<textures><checkers><checker><name>squares</name><color1 red='" + color +
        "' green='0' blue='0'/></checker></checkers></textures><materials><mattes><matte><name>m</name><ka>1</ka>"
        "<kd>0</kd><cd texture='squares'/></matte></mattes></materials><objects><spheres><sphere><center x='0' y='0' "
        "z='0'/><radius>3</radius><material>m</material></sphere></spheres></objects>";
    return build_scene(parsed_scene(scene_text(8, 6, 1, parts)), {1, {}})->radiance_range().largest;
  };
  CHECK(range_with("1000") == Approx(1000 * range_with("1")));
}

}  // namespace raytrace::test
