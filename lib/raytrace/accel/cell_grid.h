// The grid of cells on a face of a direction buffer.
#pragma once

#include <algorithm>
#include <cmath>

#include "raytrace/accel/cube_projection.h"
#include "raytrace/accel/direction_buffer.h"

namespace raytrace {

/// Cells along an edge at most.
constexpr int most_cells_an_edge = 2048;

/// What objects cover of a face.
struct Coverage {
  Interval across{2, -2}, up{2, -2};
  double objects = 0, area = 0;

  void add(const Coverage& more) {
    across = {std::min(across.low, more.across.low), std::max(across.high, more.across.high)};
    up = {std::min(up.low, more.up.low), std::max(up.high, more.up.high)};
    objects += more.objects;
    area += more.area;
  }
  void add(const FaceRectangle& r) {
    add(Coverage{r.across, r.up, 1, (r.across.high - r.across.low) * (r.up.high - r.up.low)});
  }
};

/// On what is covered, with cells that are about square: so many that objects share few of them.
DirectionBuffer::Grid grid_on(const Coverage& covered);

/// Which of `count` cells in a row, the first of which begins at `start`, an interval reaches.
struct CellRange {
  int low, high;
  CellRange(const Interval& i, float start, float per_unit, int count)
      : low(place(i.low, start, per_unit, count, -rounding)), high(place(i.high, start, per_unit, count, rounding)) {}
  int count() const { return high - low + 1; }

 private:
  static constexpr double rounding = 1e-3;  ///< of a cell's number in float, for up to most_cells_an_edge; and more
  static int place(double value, float start, float per_unit, int count, double more) {
    return static_cast<int>(std::clamp(std::floor((value - start) * per_unit + more), 0.0, count - 1.0));
  }
};

}  // namespace raytrace
