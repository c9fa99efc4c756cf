// A wall of small tiles, a pixel each, of random shapes and materials: every packet has many of both.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

constexpr int edge = 32;

struct Tile {
  bool phong;
  double ka, kd, ks, exponent, color;
};

}  // namespace

TEST_CASE("each pixel of a packet is shaded by its own object's material") {
  std::mt19937 bits(17);
  const auto unit = [&] { return static_cast<double>(bits()) / 4294967296.0; };
  std::vector<Tile> tiles;
  std::string mattes, phongs, triangles, disks;
  for (int i = 0; i < edge * edge; ++i) {
    const Tile tile{unit() < 0.5, unit(), unit(), unit(), 1 + 50 * unit(), unit()};
    tiles.push_back(tile);
    const std::string name = std::to_string(i) + "m";
    const std::string color = " red='" + std::to_string(tile.color) + "' green='0.5' blue='1'/>";
    const std::string common = "<name>" + name + "</name><ka>" + std::to_string(tile.ka) + "</ka><kd>" +
                               std::to_string(tile.kd) + "</kd><cd" + color;
    if (tile.phong) {
      phongs += "<phong>" + common + "<ks>" + std::to_string(tile.ks) + "</ks><cs" + color + "<exp>" +
                std::to_string(tile.exponent) + "</exp></phong>";
    } else {
      mattes += "<matte>" + common + "</matte>";
    }
    const double x = i % edge - edge / 2 + 0.5, y = edge / 2 - 0.5 - i / edge;
    const std::string material = "<material>" + name + "</material>";
    if (unit() < 0.5) {
      disks += "<disk>" + vector_text("center", x, y, 0) + "<normal x='0' y='0' z='1'/><radius>0.3</radius>" +
               material + "</disk>";
    } else {
      triangles += "<triangle>" + vector_text("vertexposition1", x - 0.4, y - 0.4, 0) +
                   vector_text("vertexposition2", x + 0.4, y - 0.4, 0) + vector_text("vertexposition3", x, y + 0.4, 0) +
                   material + "</triangle>";
    }
  }
  // Seen straight from the front, lit straight from the front: the mirror direction is the normal.
  const std::string text =
      "<raytracer><viewplane><hres>32</hres><vres>32</vres></viewplane><camera><eye x='0' y='0' z='20'/><lookat x='0' "
      "y='0' z='0'/>"
      "<viewdistance>20</viewdistance></camera><lights><ambientlight/><directionallights><directionallight><direction "
      "x='0' y='0' z='1'/>"
      "<scaleradiance>2</scaleradiance></directionallight></directionallights></lights><materials><mattes>" +
      mattes + "</mattes><phongs>" + phongs + "</phongs></materials><objects><triangles>" + triangles +
      "</triangles><disks>" + disks + "</disks></objects></raytracer>";
  const SceneDescription description = parsed_scene(text);
  for (const std::string& isa : usable_isas()) {
    const FloatPicture film = rendered(description, 1, isa);
    double worst = 0;
    for (int i = 0; i < edge * edge; ++i) {
      const Tile& tile = tiles[static_cast<std::size_t>(i)];
      const double x = i % edge - edge / 2 + 0.5, y = edge / 2 - 0.5 - i / edge;
      const double cosine = 20 / std::sqrt(x * x + y * y + 400);
      const double lobe = tile.phong ? tile.ks * std::pow(cosine, tile.exponent) : 0;
      const double factor = tile.ka + 2 * (tile.kd / std::numbers::pi + lobe);
      const Pixel& pixel = film.at(i % edge, i / edge);
      worst = std::max({worst, std::abs(double{pixel.red} - factor * tile.color),
                        std::abs(double{pixel.green} - factor * 0.5), std::abs(double{pixel.blue} - factor)});
    }
    INFO(isa);
    CHECK(worst < 5e-5);
  }
}

}  // namespace raytrace::test
