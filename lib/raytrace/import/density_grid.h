// Numbers at the points of a lattice in space, and what is between them: the density of smoke or of a cloud.
//
// Between the eight points around it a place has the mean that is linear in each coordinate. The lattice is cut into
// cells of 8 x 8 x 8 edges, each with the largest and the least of its numbers, so that free flights know what is ahead
// of them; cells in which all are the same keep no others.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "raytrace/math/affine.h"

namespace raytrace {

/// Why a grid cannot be used, for a message that has its name.
class GridError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Immutable.
class DensityGrid {
 public:
  static constexpr int cell_edge = 8, cell_points = cell_edge + 1;
  static constexpr int brick_numbers = cell_points * cell_points * cell_points;
  /// So many cells at most, whose tables take 192 MiB.
  static constexpr std::int64_t most_cells = std::int64_t{1} << 24U;

  struct Lattice {
    std::array<std::int64_t, 3> points{};  ///< along each axis, at least 2; the first is (0, 0, 0)
    Vec3d lower, upper;                    ///< where there is any density, in the lattice
    Affine world_from_lattice{};           ///< of a determinant that is not 0
    std::int64_t added = 0;                ///< of the points along each axis, those that the file does not have
  };
  /// How many cells such a lattice has along each axis. Throws GridError if these are too many.
  static std::array<int, 3> cells_of(const Lattice& lattice);
  /// Throws GridError if so many bytes are more than half of the memory that is free.
  static void check_memory(std::uint64_t bytes);
  /// Sets the numbers of 9 x 9 x 9 points from `first` on, x fastest; those beyond the lattice to anything that is no
  /// larger than its largest and no smaller than its least.
  using Fill = std::function<void(const std::array<int, 3>& first, float* numbers)>;

  /// Numbers below 0 are 0. fill is called on several threads at once, `threads` at most. Throws GridError for numbers
  /// that are none or infinite, for lattices that are too large, and where bricks, two copies of which there are for a
  /// while, would take more than most_bytes, or by default half of the memory that is free; std::bad_alloc; and what
  /// fill throws.
  DensityGrid(const Lattice& lattice, int threads, const Fill& fill, std::optional<std::uint64_t> most_bytes = {});

  const Lattice& lattice() const { return lattice_; }
  const std::array<int, 3>& cells() const { return cells_; }  ///< along each axis
  float largest() const { return largest_; }

  // Of each cell, x fastest: no density in it is larger or less, and where its numbers are; below 0: all are `largest`.

  const float* cells_largest() const { return cells_largest_.data(); }
  const float* cells_least() const { return cells_least_.data(); }
  const std::int32_t* bricks() const { return bricks_.data(); }
  const float* numbers() const { return numbers_.data(); }
  /// Of all tables.
  std::size_t bytes() const;

  /// In the lattice; 0 outside of what has any.
  double at(const Vec3d& p) const;

 private:
  Lattice lattice_;
  std::array<int, 3> cells_{};
  float largest_ = 0;
  std::vector<float> cells_largest_, cells_least_, numbers_;
  std::vector<std::int32_t> bricks_;
};

/// The grid that a fog's file has.
struct LoadedGrid {
  std::string hash;  ///< of the file's bytes; empty: it has not been loaded
  std::shared_ptr<const DensityGrid> grid{};
};

/// Of a file in the format of Mitsuba: "VOL", 3, then in little-endian numbers of 32 bits 1 (floats), the points along
/// x, y and z, the channels (1, or 3, of which the mean counts), the lower and the upper corner of the box that they
/// fill, and the floats, x fastest. Each is in the middle of its share of the box; at the box' sides is what is
/// nearest. Throws GridError or std::bad_alloc.
std::shared_ptr<const DensityGrid> read_vol_grid(const std::string& file, int threads);

}  // namespace raytrace
