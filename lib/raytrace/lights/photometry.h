// How much a lamp sends into each direction, from an IES file.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace raytrace {

/// A text that is no IES file, or one that cannot be used. What it says follows the file's name and a colon.
class PhotometryError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Shares of the largest intensity, in steps of half a degree. Row by row: from 0, along the lamp's axis, to 180
/// degrees. A row has one share, or those of the angles about the axis, from 0 to 360 degrees, both included.
struct Photometry {
  static constexpr int rows = 361, most_columns = 721;
  int columns = 1;
  std::vector<float> shares;
};

/// text: of a file as the IES's standard LM-63 describes it (1986 to 2019), with photometry of type C. Light is
/// bilinear in the angles between the file's, and 0 beyond them. Lamps that are symmetric to one plane or two may leave
/// out angles. Throws PhotometryError, with the line and column.
Photometry read_photometry(std::string_view text);

/// What the `iesfile` of a light has.
struct LoadedPhotometry {
  std::string hash;  ///< of its bytes; empty: it has not been loaded
  std::shared_ptr<const Photometry> shares;
};

}  // namespace raytrace
