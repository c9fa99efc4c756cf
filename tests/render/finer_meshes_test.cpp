// Meshes that are subdivided and displaced, in pictures: there they are like meshes that were made so elsewhere.
#include <cmath>
#include <sstream>

#include "raytrace/aovs/aov_selection.h"
#include "render/scenes.h"
#include "support/catch.h"

namespace raytrace::test {
namespace {

const std::string textures_of_heights =
    "<textures><checkers><checker><name>squares</name><color1 red='1' green='1' blue='1'/>"
    "<color2 red='0' green='0' blue='0'/><uvscale x='2' y='2'/></checker></checkers>"
    "<noises><noise><name>clouds</name><scale>0.6</scale></noise></noises></textures>";

std::string with_textures(std::string text) { return text.replace(text.find("<materials>"), 0, textures_of_heights); }

std::string lit_scene(const std::string& objects, int samples = 4) {
  return with_textures(scene_text(
      64, 48, samples,
      "<lights><ambientlight><scaleradiance>0.2</scaleradiance></ambientlight><pointlights><pointlight>"
      "<location x='6' y='9' z='10'/><scaleradiance>2</scaleradiance></pointlight></pointlights></lights>"
      "<materials><mattes><matte><name>m</name><ka>0.3</ka><kd>0.7</kd><cd red='0.8' green='0.6' blue='0.5'/></matte>"
      "</mattes><emissives><emissive><name>lamp</name><ce red='1' green='1' blue='1'/></emissive></emissives>"
      "</materials><objects>" +
          objects + "</objects>"));
}

constexpr const char* cube_text =
    "<positions>-1 -1 -1, 1 -1 -1, 1 1 -1, -1 1 -1, -1 -1 1, 1 -1 1, 1 1 1, -1 1 1</positions>"
    "<faces>0 3 2 1, 4 5 6 7, 0 1 5 4, 1 2 6 5, 2 3 7 6, 3 0 4 7</faces>";

}  // namespace

TEST_CASE("a displaced square is as near as its texture says") {
  // 16 pixels wide; each of the two squares of the checker is 8. Between are those whose faces lead up or down.
  const std::string text = with_textures(
      row_of_pixels(16,
                    "<meshes><mesh><positions>0 -8 0, 16 -8 0, 16 8 0, 0 8 0</positions>"
                    "<uvs>0 -0.25, 1 -0.25, 1 0.75, 0 0.75</uvs><faces>0 1 2 3,</faces><subdivision>4</subdivision>"
                    "<subdivisionscheme>flat</subdivisionscheme><displacement texture='squares' height='2'/>"
                    "<midlevel>0.25</midlevel><material>m</material></mesh></meshes>"));
  const ImageBand band = picture_aovs(parsed_scene(text), {"depth"});
  const auto& depth = std::get<std::vector<float>>(band.planes.at(0));
  // Edges of faces and of the picture's ends are half way: to (1 + 0) / 2.
  const auto height = [](double value) { return 9 - 2 * (value - 0.25); };
  for (std::size_t x = 1; x < 15; ++x) {
    const double wanted = x == 7 ? height(0.75) : x == 8 ? height(0.25) : height(x < 7 ? 1 : 0);
    INFO(x);
    CHECK(double{depth[x]} == Approx(wanted).epsilon(1e-5));
  }
}

TEST_CASE("a subdivided and displaced square has the picture of the same faces, made one by one") {
  constexpr int edge = 16;
  std::ostringstream positions, faces;
  for (int y = 0; y <= edge; ++y)
    for (int x = 0; x <= edge; ++x) {
      // Stripes, so that all quads are flat: where they are not, it matters with which corner they begin.
      const bool between = x % 8 == 0, white = x < 8;
      positions << 6.0 * x / edge - 3 << ' ' << 6.0 * y / edge - 3 << ' ' << (between ? 0.25 : white ? 0.5 : 0) << ", ";
      if (x == edge || y == edge) continue;
      const int a = y * (edge + 1) + x;
      faces << a << ' ' << a + 1 << ' ' << a + edge + 2 << ' ' << a + edge + 1 << ", ";
    }
  const std::string turned =
      "<material>m</material><transform><rotate x='1' y='0.4' z='0.2' angle='50'/></transform></mesh></meshes>";
  const FloatPicture made = rendered(lit_scene("<meshes><mesh><positions>" + positions.str() + "</positions><faces>" +
                                               faces.str() + "</faces><normals>smooth</normals>" + turned));
  const FloatPicture finer = rendered(lit_scene(
      "<meshes><mesh><positions>-3 -3 0, 3 -3 0, 3 3 0, -3 3 0</positions><uvs>0 0.2, 1 0.2, 1 0.2, 0 0.2</uvs>"
      "<faces>0 1 2 3,</faces><subdivision>4</subdivision><subdivisionscheme>flat</subdivisionscheme>"
      "<displacement texture='squares' height='0.5'/>" +
      turned));
  // Along edges a sample may meet one face or the other.
  int differing = 0, lit = 0;
  for (std::size_t i = 0; i < made.pixels().size(); ++i) {
    differing += difference(made.pixels()[i], finer.pixels()[i]) > 1e-5 ? 1 : 0;
    lit += difference(made.pixels()[i], made.pixels()[0]) > 0.01 ? 1 : 0;
  }
  CHECK(lit > 200);
  CHECK(differing <= 4);
}

TEST_CASE("finer meshes have the same bits however a picture is cut: as lamps and in groups") {
  const std::string finer = std::string("<subdivision>3</subdivision><displacement texture='clouds' height='0.4'/>");
  const std::string objects =
      "<meshes><mesh>" + std::string(cube_text) + finer +
      "<material>m</material><transform><translate x='-1.5' y='0' z='0'/></transform></mesh><mesh>" + cube_text +
      finer +
      "<material>lamp</material><transform><scale x='0.5' y='0.5' z='0.5'/><translate x='1.5' y='1.5' z='1'/>"
      "</transform></mesh></meshes><instances><instance><group>g</group><transform><translate x='1.5' y='-1' z='0'/>"
      "</transform></instance></instances>";
  std::string text = lit_scene(objects, 8);
  const std::string group = "<groups><group><name>g</name><objects><meshes><mesh>" + std::string(cube_text) + finer +
                            "<material>m</material></mesh></meshes></objects></group></groups>";
  text.replace(text.rfind("</raytracer>"), 0, group);
  check_same_bits(parsed_scene(text));
}

}  // namespace raytrace::test
