// Pieces of a small picture, as the program writes them, but of sums that are made up: no scene need be rendered.
#pragma once

#include <optional>
#include <string>

#include "raytrace/batch/provenance.h"

namespace raytrace::test {

inline constexpr int sample_width = 24, sample_height = 18;

struct SamplePiece {
  Region whole{0, 0, sample_width, sample_height};
  std::optional<Tile> tile = std::nullopt;
  SampleRange samples{0, 5};
  bool aovs = false;
  bool sums = false;
  bool compressed = true;
  bool partial = false;
  bool large = false;        ///< its sums need two limbs
  bool light_paths = false;  ///< that reach all of `whole`
};

PieceIdentity identity_of(const SamplePiece& piece);

/// With sums that its samples can have.
Film film_of(const SamplePiece& piece);

void write_piece(const std::string& file, const SamplePiece& piece);

}  // namespace raytrace::test
