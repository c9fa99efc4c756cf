// Where on flat patches points are drawn, by how much of a texture's light each part sends out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "raytrace/math/simd.h"
#include "raytrace/math/vec2.h"

namespace raytrace {

/// For each patch a grid of the unit square that sample_patch() draws its points from, evenly within each cell. First
/// the column is drawn by u1, then the cell in it by u2: what was stratified stays so.
class PatchShares {
 public:
  /// cells: of all patches, each way; a power of 2.
  explicit PatchShares(int cells = 1) : cells_(cells) {}

  /// Of the next patch. radiances: positive, of the cells of each column, one column after another; none: it is drawn
  /// evenly.
  void add(std::span<const float> radiances);

  bool empty() const { return shares_.empty(); }
  /// Whether those patches have such a grid: for others the two below say nothing.
  MaskN uneven(const IntN& patch) const;
  struct Draw {
    Vec2<FloatN> square;
    FloatN density;  ///< on the mean 1
  };
  Draw draw(const IntN& patch, FloatN u1, FloatN u2) const;
  FloatN density(const IntN& patch, const Vec2<FloatN>& square) const;

 private:
  /// Where a patch's shares begin: those of its columns, added up from 0 to 1, then those of the cells in each.
  IntN first(const IntN& patch) const;
  /// The cell that u falls into, of the shares from there on. u becomes where in it; share: the cell's.
  IntN pick(const IntN& first, FloatN& u, FloatN& share) const;
  FloatN share_of(const IntN& first, const IntN& cell) const;
  IntN cell_of(const FloatN& u) const;

  std::int32_t cells_;
  std::vector<std::int32_t> firsts_;  ///< of each patch; -1: it is drawn evenly
  std::vector<float> shares_;
};

}  // namespace raytrace
