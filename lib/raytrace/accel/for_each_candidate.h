// A packet of rays in a DirectionBuffer.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

#include "raytrace/accel/direction_buffer.h"
#include "raytrace/math/simd.h"

namespace raytrace {

namespace detail {

/// Calls f(cell, lanes) for each cell that the directions in the lanes of `active` lead through; those that lead
/// through none meet nothing.
template <class Function>
RAYTRACE_INLINE void for_each_cell(const DirectionBuffer& buffer, const Vec3<FloatN>& direction, const MaskN& active,
                                   const Function& f) {
  const Vec3<FloatN> sizes{abs(direction.x), abs(direction.y), abs(direction.z)};
  const MaskN along_x = (sizes.x >= sizes.y) & (sizes.x >= sizes.z), along_x_or_y = along_x | (sizes.y >= sizes.z);
  MaskN left = active;
  // Neighbours mostly lead through one face, and one cell of it.
  while (any(left)) {
    const std::uint32_t first = std::uint32_t{1} << std::countr_zero(bits_of<FloatN>(left));
    const int axis = (bits_of<FloatN>(along_x) & first) != 0 ? 0 : (bits_of<FloatN>(along_x_or_y) & first) != 0 ? 1 : 2;
    const FloatN& normal = component(direction, axis);
    const MaskN negative = normal < FloatN(0);
    const bool first_is_negative = (bits_of<FloatN>(negative) & first) != 0;
    const MaskN along = axis == 0 ? along_x : axis == 1 ? !along_x & along_x_or_y : !along_x_or_y;
    const MaskN here = left & along & (first_is_negative ? negative : !negative);
    left = left & !here;
    const DirectionBuffer::Grid& grid = buffer.grid(2 * axis + (first_is_negative ? 1 : 0));
    if (grid.columns == 0) continue;
    const FloatN inverse_size = FloatN(1) / component(sizes, axis);
    const FloatN across = component(direction, (axis + 1) % 3), up = component(direction, (axis + 2) % 3);
    const FloatN column = (across * inverse_size - FloatN(grid.left)) * FloatN(grid.columns_per_unit);
    const FloatN row = (up * inverse_size - FloatN(grid.bottom)) * FloatN(grid.rows_per_unit);
    MaskN inside = here & (column >= FloatN(0)) & (column < FloatN(static_cast<float>(grid.columns))) &
                   (row >= FloatN(0)) & (row < FloatN(static_cast<float>(grid.rows)));
    const IntN cell = to_int(row) * IntN(grid.columns) + to_int(column);
    while (any(inside)) {
      const std::int32_t number = cell.get(static_cast<std::size_t>(std::countr_zero(bits_of<FloatN>(inside))));
      const MaskN same = inside & float_mask<FloatN>(cell == IntN(number));
      inside = inside & !same;
      f(grid.first_cell + static_cast<std::size_t>(number), same);
    }
  }
}

}  // namespace detail

/// Calls test(object) once for each object that directions from the buffer's point, of any length but 0, may meet in
/// the lanes of `active`; the test is of all lanes at once, since that costs no more than one. Of each cell's, the
/// nearest comes first, and what is behind one for which reaches(lanes, object) is false, of the cell's lanes, is left
/// out. The result: lanes that must be traced by other means.
template <class Reaches, class Test>
RAYTRACE_INLINE MaskN for_each_candidate(const DirectionBuffer& buffer, const Vec3<FloatN>& direction,
                                         const MaskN& active, const Reaches& reaches, const Test& test) {
  // Of each cell, the candidates that were tested. Not set before: most packets have one cell.
  struct Tested {
    const std::uint32_t *begin, *end;
  };
  std::array<Tested, packet_lanes> done;
  std::size_t cells = 0;
  MaskN left(false);
  detail::for_each_cell(buffer, direction, active, [&](std::size_t cell, const MaskN& lanes) {
    if (buffer.is_crowded(cell)) {
      left = left | lanes;
      return;
    }
    const std::span<const std::uint32_t> candidates = buffer.candidates(cell);
    std::size_t next = 0;
    for (; next < candidates.size(); ++next) {
      const DirectionBuffer::Object& object = buffer.object(candidates[next]);
      if (!reaches(lanes, object)) break;
      const bool is_done = std::any_of(done.begin(), done.begin() + cells, [&](const Tested& tested) {
        return std::binary_search(tested.begin, tested.end, candidates[next]);
      });
      if (!is_done) test(object);
    }
    done[cells++] = {candidates.data(), candidates.data() + next};
  });
  return left;
}

}  // namespace raytrace
