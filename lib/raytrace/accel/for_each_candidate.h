// A packet of rays in a DirectionBuffer.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "raytrace/accel/direction_buffer.h"
#include "raytrace/math/lanes.h"
#include "raytrace/math/simd.h"

namespace raytrace {

/// How rays lead past the point of a buffer, whose cells are seen from there.
enum class Way { from_point, to_point };

namespace detail {

/// Calls f(cell, lanes) for each cell that the rays in the lanes of `active` lead through; those that lead through none
/// meet nothing.
template <Way way, class Function>
RAYTRACE_INLINE void for_each_cell(const DirectionBuffer& buffer, const Vec3<FloatN>& direction, const MaskN& active,
                                   const Function& f) {
  // Neighbours mostly lead through one face, and one cell of it: those of the first, then those of the first of the
  // others, and so on.
  MaskN left = active;
  while (any(left)) {
    const std::size_t lane = first_lane(left);
    const Vec3f first = in_lane(direction, lane);
    const float x = std::abs(first.x), y = std::abs(first.y), z = std::abs(first.z);
    const int axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    const bool negative = component(first, axis) < 0;
    const FloatN size = negative ? -component(direction, axis) : component(direction, axis);
    const FloatN across = component(direction, (axis + 1) % 3), up = component(direction, (axis + 2) % 3);
    const MaskN here = left & (size >= abs(across)) & (size >= abs(up));
    if ((bits_of<FloatN>(here) >> lane & 1U) == 0) {  // what is no number meets nothing
      left = left & (abs(direction.x) + abs(direction.y) + abs(direction.z) >= FloatN(0));
      continue;
    }
    left = left & !here;
    const bool on_negative_side = negative == (way == Way::from_point);
    const DirectionBuffer::Grid& grid = buffer.grid(2 * axis + (on_negative_side ? 1 : 0));
    if (grid.columns == 0) continue;
    const FloatN inverse_size = FloatN(way == Way::from_point ? 1.0F : -1.0F) / size;
    const IntN column = to_int((across * inverse_size - FloatN(grid.left)) * FloatN(grid.columns_per_unit));
    const IntN row = to_int((up * inverse_size - FloatN(grid.bottom)) * FloatN(grid.rows_per_unit));
    // What is less than 0 is a large number here.
    const MaskN inside =
        here & float_mask<FloatN>(same_bits<UintN>(column) < UintN(static_cast<std::uint32_t>(grid.columns))) &
        float_mask<FloatN>(same_bits<UintN>(row) < UintN(static_cast<std::uint32_t>(grid.rows)));
    const IntN cell = row * IntN(grid.columns) + column;
    for_each_value(cell, inside, [&](std::int32_t number, const MaskN& same) RAYTRACE_INLINE_LAMBDA {
      f(grid.first_cell + static_cast<std::size_t>(number), same);
    });
  }
}

/// The candidates that a packet was tested with. One is looked up where the one that came there last is remembered, and
/// mostly needs no search. Nothing is set before it is wanted: most packets have one cell, with few candidates.
class TestedCandidates {
 public:
  using Object = DirectionBuffer::Object;

  void add(const Object& object) {
    last_[object.primitive % places] = object;
    used_ |= std::uint64_t{1} << object.primitive % places;
  }

  /// All of a cell's that contains() is to know, the nearest first. Each was added.
  void end_cell(std::span<const Object> tested) { cells_[count_++] = {tested.data(), tested.data() + tested.size()}; }

  bool contains(const Object& object) const {
    if ((used_ >> object.primitive % places & 1) == 0) return false;
    if (last_[object.primitive % places].is(object)) return true;
    return std::any_of(cells_.begin(), cells_.begin() + count_, [&object](const Cell& cell) {
      const Object* const nearer_end = std::partition_point(
          cell.begin, cell.end, [&object](const Object& other) { return other.nearest < object.nearest; });
      return std::any_of(nearer_end, cell.end, [&object](const Object& other) { return other.is(object); });
    });
  }

 private:
  static constexpr std::uint32_t places = 64;
  struct Cell {
    const Object *begin, *end;
  };
  std::array<Object, places> last_;
  std::uint64_t used_ = 0;  ///< a bit for each place
  std::array<Cell, packet_lanes> cells_;
  std::size_t count_ = 0;
};

}  // namespace detail

/// Calls test(object) once for each object that rays from or to the buffer's point, in directions of any length but 0,
/// may meet in the lanes of `active`; the test is of all lanes at once, since that costs no more than one. Of each
/// cell's, the nearest comes first, and what is behind one for which reaches(lanes, object) is false, of the cell's
/// lanes, is left out. The result: lanes that must be traced by other means.
///
/// With many objects, most of the time would be spent waiting for memory: for a cell, then for its candidates, then for
/// what test(object) reads. So each is asked for while those before it are tested, the last by fetch(object).
template <Way way, class Reaches, class Fetch, class Test>
RAYTRACE_INLINE MaskN for_each_candidate(const DirectionBuffer& buffer, const Vec3<FloatN>& direction,
                                         const MaskN& active, const Reaches& reaches, const Fetch& fetch,
                                         const Test& test) {
  using Object = DirectionBuffer::Object;
  struct CellOfLanes {
    std::size_t cell;
    MaskN lanes;
  };
  std::array<CellOfLanes, packet_lanes> cells;
  std::size_t count = 0;
  detail::for_each_cell<way>(buffer, direction, active, [&](std::size_t cell, const MaskN& lanes) {
    buffer.fetch_cell(cell);
    cells[count++] = {cell, lanes};
  });
  if (count > 1) buffer.fetch_candidates(cells[1].cell);

  detail::TestedCandidates tested;
  MaskN left(false);
  for (std::size_t i = 0; i < count; ++i) {
    if (i + 2 < count) buffer.fetch_candidates(cells[i + 2].cell);
    if (i + 1 < count) {
      const std::span<const Object> of_next_cell = buffer.candidates(cells[i + 1].cell);
      if (!of_next_cell.empty()) fetch(of_next_cell.front());
    }
    const auto& [cell, lanes] = cells[i];
    if (buffer.is_crowded(cell)) {
      left = left | lanes;
      continue;
    }
    const std::span<const Object> candidates = buffer.candidates(cell);
    std::size_t next = 0;
    for (; next < candidates.size(); ++next) {
      const Object& object = candidates[next];
      if (!reaches(lanes, object)) break;
      if (tested.contains(object)) continue;
      tested.add(object);
      if (next + 1 < candidates.size()) fetch(candidates[next + 1]);
      test(object);
    }
    tested.end_cell(candidates.first(next));
  }
  return left;
}

}  // namespace raytrace
