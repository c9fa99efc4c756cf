// Grids of OpenVDB files, of which OpenImageIO makes pictures with a depth: each grid is one, in tiles of 8 x 8 x 8.
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "raytrace/memory/out_of_memory.h"
#include "raytrace/output/openimageio_module.h"

namespace raytrace {
namespace {

constexpr const char* to_world = "openvdb:indextoworld";

/// The grids of the file that have one number at each point, and what to say where the one that is wanted is not there.
struct VdbGrids {
  std::vector<std::pair<std::string, int>> named;  ///< with their numbers among the file's

  explicit VdbGrids(OIIO::ImageInput& input) {
    constexpr int most = 1000;
    for (int i = 0; i < most; ++i) {
      const OIIO::ImageSpec spec = input.spec(i);
      if (spec.undefined()) break;
      if (spec.nchannels == 1) named.emplace_back(spec.get_string_attribute("oiio:subimagename"), i);
    }
  }
  /// name: empty for "density", or else the first. Throws GridError.
  int find(const std::string& name) const {
    for (const auto& [its_name, number] : named)
      if (its_name == (name.empty() ? "density" : name)) return number;
    if (named.empty()) throw GridError("it has no grid of floats");
    if (name.empty()) return named.front().second;
    std::string names;
    for (const auto& [its_name, number] : named) names += (names.empty() ? "" : ", ") + its_name;
    throw GridError("it has no grid of floats named " + name + "; it has " + names);
  }
};

void read_tiles(OIIO::ImageInput& input, int number, GridTiles& grid) {
  const OIIO::ImageSpec spec = input.spec(number);
  if (spec.get_string_attribute("openvdb:class") == "level set")
    throw GridError("the grid is a level set, of distances to a surface; a density is a fog volume");
  const OIIO::ParamValue* const map =
      spec.find_attribute(to_world, OIIO::TypeDesc(OIIO::TypeDesc::DOUBLE, OIIO::TypeDesc::MATRIX44));
  if (map == nullptr || spec.format != OIIO::TypeFloat)
    throw GridError("OpenImageIO does not say where its points are");
  // Points are rows there.
  const auto* const rows = static_cast<const double*>(map->data());
  const auto row = [&](int i) { return Vec3d(rows[4 * i], rows[4 * i + 1], rows[4 * i + 2]); };
  grid.world_from_index = {row(0), row(1), row(2), row(3)};
  grid.first = {spec.full_x, spec.full_y, spec.full_z};
  grid.last = {grid.first[0] + spec.full_width - 1, grid.first[1] + spec.full_height - 1,
               grid.first[2] + spec.full_depth - 1};
  grid.set_tiles();
  std::array<float, GridTiles::tile_numbers> tile;
  for (std::int64_t z = 0; z < grid.tiles[2]; ++z)
    for (std::int64_t y = 0; y < grid.tiles[1]; ++y)
      for (std::int64_t x = 0; x < grid.tiles[0]; ++x) {
        const auto first = [&](std::size_t axis, std::int64_t i) {
          return static_cast<int>((grid.first_tile[axis] + i) * GridTiles::tile_edge);
        };
        if (!input.read_native_tile(number, 0, first(0, x), first(1, y), first(2, z), tile.data()))
          throw GridError("a part of its numbers cannot be read");
        grid.add_tile(tile);
      }
}

}  // namespace

void raytrace_read_grid(const std::string& file, const std::string& name, GridTiles& grid) try {
  if (("," + std::string(OIIO::get_string_attribute("format_list")) + ",").find(",openvdb,") == std::string::npos)
    throw GridError("the OpenImageIO of this machine has no reader for OpenVDB");
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(file);
  if (!input || std::string(input->format_name()) != "openvdb") {
    std::string reason = OIIO::geterror();
    if (says_out_of_memory(reason)) throw std::bad_alloc();
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    throw GridError(reason.empty() ? "it is no file of OpenVDB" : reason);
  }
  read_tiles(*input, VdbGrids(*input).find(name), grid);
} catch (const GridError&) {
  throw;
} catch (const std::bad_alloc&) {
  throw;
} catch (const std::exception& error) {  // OpenVDB's own
  throw GridError(error.what());
}

}  // namespace raytrace
