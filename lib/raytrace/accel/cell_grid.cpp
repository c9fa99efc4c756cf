#include "raytrace/accel/cell_grid.h"

namespace raytrace {

namespace {

/// Cells, on the average, that a grid has for each object on it.
constexpr double cells_an_object = 16;

/// Of a cell's edge to that of the objects' average rectangle: where objects overlap, smaller ones list the same
/// objects, many times.
constexpr double least_edge = 0.25;

}  // namespace

DirectionBuffer::Grid grid_on(const Coverage& covered) {
  const double width = covered.across.high - covered.across.low, height = covered.up.high - covered.up.low;
  const double edge = std::sqrt(std::max(width * height / (cells_an_object * covered.objects),
                                         least_edge * least_edge * covered.area / covered.objects));
  const auto cells = [edge](double size) {
    return static_cast<int>(std::clamp(std::ceil(size / edge), 1.0, 1.0 * most_cells_an_edge));
  };
  DirectionBuffer::Grid grid;
  grid.columns = cells(width);
  grid.rows = cells(height);
  grid.left = static_cast<float>(covered.across.low);
  grid.bottom = static_cast<float>(covered.up.low);
  grid.columns_per_unit = static_cast<float>(grid.columns / width);
  grid.rows_per_unit = static_cast<float>(grid.rows / height);
  return grid;
}

}  // namespace raytrace
