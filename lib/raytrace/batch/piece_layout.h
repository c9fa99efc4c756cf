// Whether pieces of a picture cover it exactly.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "raytrace/film/region.h"
#include "raytrace/film/tiles.h"

namespace raytrace {

/// A piece: these samples of these pixels.
struct PieceExtent {
  std::string file;
  Region region;
  std::uint64_t first_sample = 0, last_sample = 0;  ///< [first, last)
  std::optional<Tile> tile = std::nullopt;          ///< of the picture, that the region is
};

/// What pieces are to cover.
struct WantedExtent {
  Region region;
  std::uint64_t samples = 1;  ///< per pixel
  bool centered = false;      ///< SampleRange::centered
  std::string crop{};         ///< as --crop has it; empty: the whole picture
};

/// Of a piece's command line, what makes it this piece: "--tile 2/4 --sample-offset 8 ", or nothing.
std::string options_of(const PieceExtent& piece);

/// The problems, a line each, naming the files: pieces that overlap.
std::vector<std::string> overlaps(const std::vector<PieceExtent>& pieces);

/// What no piece holds, a line each: with the options that render it, where it is a tile, or samples, such as the
/// pieces are; else by its pixels. Empty if each pixel has each sample.
std::vector<std::string> missing_parts(const std::vector<PieceExtent>& pieces, const WantedExtent& picture);

}  // namespace raytrace
