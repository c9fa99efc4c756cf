// UDIM: a texture of several files, each of which covers a unit of u and v. Mari's numbers: 1001 + u + 10 v.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace raytrace {

inline constexpr int udim_columns = 10;

/// column, row: u and v of the tile's lower left corner, from 0.
constexpr int udim_number(int column, int row) { return 1001 + column + udim_columns * row; }

struct UdimTile {
  int column, row;
  std::string file;

  int number() const { return udim_number(column, row); }
};

/// Whether a file's name stands for those of tiles: it has <UDIM> or %(UDIM)d in place of their number.
bool is_udim(std::string_view file);

/// The files that there are of such a name, by their numbers, from 1001 to 9999.
std::vector<UdimTile> find_udim_tiles(const std::string& file);

}  // namespace raytrace
