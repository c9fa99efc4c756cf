// A packet of rays in a DirectionBuffer.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

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

/// The candidates that a packet was tested with. A number is looked up where the one that came there last is
/// remembered, and mostly needs no search. Nothing is set before it is wanted: most packets have one cell, with few
/// candidates.
class TestedCandidates {
 public:
  void add(std::uint32_t number) {
    last_[number % places] = number;
    used_ |= std::uint64_t{1} << number % places;
  }

  /// All of a cell's that contains() is to know, in ascending order. Each was added.
  void end_cell(std::span<const std::uint32_t> numbers) {
    cells_[count_++] = {numbers.data(), numbers.data() + numbers.size()};
  }

  bool contains(std::uint32_t number) const {
    if ((used_ >> number % places & 1) == 0) return false;
    if (last_[number % places] == number) return true;
    return std::any_of(cells_.begin(), cells_.begin() + count_,
                       [number](const Cell& cell) { return std::binary_search(cell.begin, cell.end, number); });
  }

 private:
  static constexpr std::uint32_t places = 64;
  struct Cell {
    const std::uint32_t *begin, *end;
  };
  std::array<std::uint32_t, places> last_;
  std::uint64_t used_ = 0;  ///< a bit for each place
  std::array<Cell, packet_lanes> cells_;
  std::size_t count_ = 0;
};

}  // namespace detail

/// Calls test(object) once for each object that directions from the buffer's point, of any length but 0, may meet in
/// the lanes of `active`; the test is of all lanes at once, since that costs no more than one. Of each cell's, the
/// nearest comes first, and what is behind one for which reaches(lanes, object) is false, of the cell's lanes, is left
/// out. The result: lanes that must be traced by other means.
template <class Reaches, class Test>
RAYTRACE_INLINE MaskN for_each_candidate(const DirectionBuffer& buffer, const Vec3<FloatN>& direction,
                                         const MaskN& active, const Reaches& reaches, const Test& test) {
  detail::TestedCandidates tested;
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
      if (tested.contains(candidates[next])) continue;
      tested.add(candidates[next]);
      test(object);
    }
    tested.end_cell(candidates.first(next));
  });
  return left;
}

}  // namespace raytrace
