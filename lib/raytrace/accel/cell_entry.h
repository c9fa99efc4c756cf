// While a direction buffer is made: which cells of a face's grid an object may be met through.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "raytrace/accel/cell_grid.h"
#include "raytrace/accel/cube_projection.h"
#include "raytrace/accel/direction_buffer.h"
#include "raytrace/math/doubles.h"
#include "raytrace/math/simd.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

/// The cells of a rectangle, in some rows, that reach into the cone around an object and, of a triangle, its
/// edge_planes.
struct CellEntry {
  static constexpr int column_bits = 11, row_bits = 5;
  static_assert(most_cells_an_edge <= 1 << column_bits);
  static constexpr std::uint32_t last_column = (1U << column_bits) - 1, last_row = (1U << row_bits) - 1;

  DirectionBuffer::Object object;
  std::uint32_t left : column_bits, right : column_bits;  ///< columns of the grid, the last one included
  std::uint32_t bottom : row_bits, top : row_bits;  ///< rows, counted from the first of these, the last one included
  float across, up, normal;                         ///< components of the cone's axis, of unit length
  double least;  ///< cosine of the angle between it and directions through the cone, squared, its sign kept
  float inner;   ///< by what that is more in directions all around which the object is met; infinity: in none
  float behind;  ///< ProjectedBounds::behind
  bool has_edge_planes;
};

struct CellEntries {
  std::vector<CellEntry> all;
  std::vector<EdgePlanes> edge_planes;  ///< of those that have one, in the same order
};

/// Cells beside each other in a row that are tested at once: about as many as a small object reaches into.
using CellFloats = FloatLanes<8>;
using CellMask = Mask<CellFloats>;

/// Calls f(first, reached, covered) for all that the entry may reach into, so many at a time: `first` counts from the
/// first cell of `first_row`, the first of those rows in the grid; covered are those that the object covers wholly.
template <class Function>
void for_each_reached(const DirectionBuffer::Grid& grid, int first_row, const CellEntry& entry, const Function& f) {
  using Columns = Doubles<CellFloats>;
  alignas(64) static constexpr auto numbers = [] {
    std::array<double, Columns::size> lanes{};
    for (std::size_t i = 0; i < lanes.size(); ++i) lanes[i] = static_cast<double>(i) + 0.5;
    return lanes;
  }();
  const double width = 1.0 / grid.columns_per_unit, height = 1.0 / grid.rows_per_unit;
  for (int row = entry.bottom; row <= entry.top; ++row) {
    const double up = grid.bottom + (first_row + row + 0.5) * height;
    const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns);
    for (int column = entry.left; column <= entry.right; column += lane_count<CellFloats>) {
      const Columns number = Columns(column) + Columns::load_aligned(numbers.data());
      const Columns across = Columns(grid.left) + number * Columns(width);
      const Columns towards = Columns(entry.normal + up * entry.up) + across * Columns(entry.across);
      const Columns squared_length = Columns(1 + up * up) + across * across;
      const Columns signed_square = towards * abs(towards);
      const CellMask reached = Columns::float_mask(signed_square >= Columns(entry.least) * squared_length);
      const CellMask covered =
          Columns::float_mask(signed_square >= Columns(entry.least + entry.inner) * squared_length);
      const CellMask here = first_lanes<CellFloats>(entry.right + 1 - column);
      f(first + static_cast<std::size_t>(column), reached & here, covered & here);
    }
  }
}

/// The same of a triangle: those that reach into its edge_planes; that it covers one is not looked for.
template <class Function>
void for_each_reached(const DirectionBuffer::Grid& grid, int first_row, const CellEntry& entry, int face,
                      const EdgePlanes& edge_planes, const Function& f) {
  // Cells are wider than they are, for the rounding of directions on the face and of a cell's number.
  const double width = 1.0 / grid.columns_per_unit, height = 1.0 / grid.rows_per_unit;
  const double half_width = 0.501 * width + 1e-6, half_height = 0.501 * height + 1e-6;
  // Of the product of EdgePlanes::inward with the direction to a cell's center, for each edge: it grows from column to
  // column and from row to row, and is not negative where a part of the cell is inside.
  struct Edge {
    double at_first, a_column, a_row;
  };
  std::array<Edge, 3> edges;
  const int axis = face / 2;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d inward(edge_planes.inward[i]);
    const double across = component(inward, (axis + 1) % 3), up = component(inward, (axis + 2) % 3);
    const double normal = face % 2 != 0 ? -component(inward, axis) : component(inward, axis);
    // No direction on a face is longer than the root of 3.
    const double most = std::abs(across) * half_width + std::abs(up) * half_height + 1.7321 * edge_planes.slack;
    edges[i] = {normal + (grid.left + width / 2) * across + (grid.bottom + height / 2) * up + most, across * width,
                up * height};
  }
  for (int row = entry.bottom; row <= entry.top; ++row) {
    double left = entry.left, right = entry.right;
    for (const Edge& edge : edges) {
      const double start = edge.at_first + (first_row + row) * edge.a_row;
      if (edge.a_column > 0)
        left = std::max(left, -start / edge.a_column);
      else if (edge.a_column < 0)
        right = std::min(right, -start / edge.a_column);
      else if (start < 0)
        right = -1;
    }
    if (left > right) left = 1, right = 0;  // by however much: not all of it is a float's
    const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns);
    for (int column = entry.left; column <= entry.right; column += lane_count<CellFloats>) {
      const CellFloats number = lane_numbers<CellFloats>() + CellFloats(static_cast<float>(column));
      const CellMask reached =
          (number >= CellFloats(static_cast<float>(left))) & (number <= CellFloats(static_cast<float>(right)));
      f(first + static_cast<std::size_t>(column), reached, CellMask(false));
    }
  }
}

}  // namespace raytrace
