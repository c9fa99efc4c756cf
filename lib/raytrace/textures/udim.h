// UDIM: a texture of several files, each of which covers a unit of u and v. Mari's numbers: 1001 + u + 10 v.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace raytrace {

struct UdimTile {
  int column, row;  ///< of its lower left corner: u and v, from 0; 10 columns
  std::string file;

  int number() const { return 1001 + column + 10 * row; }
};

/// Whether a file's name stands for those of tiles: it has <UDIM> or %(UDIM)d in place of their number.
bool is_udim(std::string_view file);

/// The files that there are of such a name, by their numbers, from 1001 to 9999.
std::vector<UdimTile> find_udim_tiles(const std::string& file);

}  // namespace raytrace
