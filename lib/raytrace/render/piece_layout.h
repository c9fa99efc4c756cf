// Whether pieces of a picture cover it exactly.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "raytrace/film/film.h"

namespace raytrace {

/// A piece: these samples of these pixels.
struct PieceExtent {
  std::string file;
  Region region;
  std::uint64_t first_sample = 0, last_sample = 0;  ///< [first, last)
};

/// The problems, a line each, naming the files: pieces that overlap, and parts of the picture that none covers. Empty
/// if each pixel of `whole` has each sample of [0, samples) once.
std::vector<std::string> overlaps(const std::vector<PieceExtent>& pieces);
std::vector<std::string> gaps(const std::vector<PieceExtent>& pieces, const Region& whole, std::uint64_t samples);

}  // namespace raytrace
