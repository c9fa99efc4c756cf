#include "raytrace/import/density_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

namespace {

/// The cells of one layer, z being the same.
struct CellLayer {
  std::vector<float> largest, least, numbers;
  std::vector<std::int32_t> bricks;  ///< among the layer's
};

/// By so much linear means may be beyond what they are between, as floats round.
constexpr float rounding = 0x1p-20F;

void refuse_number(float number) {
  if (!std::isfinite(number)) throw GridError("it has a number that is not finite");
  if (number > 1e17F) throw GridError("it has a number above 1e17");
}

}  // namespace

void DensityGrid::check(const Lattice& lattice) {
  std::int64_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t points = lattice.points[axis];
    if (points < 2) throw GridError("it has no points");
    const std::int64_t cells = (points - 2) / cell_edge + 1;
    if (cells > most_cells || (count *= cells) > most_cells)
      throw GridError("it is too large: " + std::to_string(lattice.points[0]) + " x " +
                      std::to_string(lattice.points[1]) + " x " + std::to_string(lattice.points[2]) +
                      " points, where the most are some 2000 x 2000 x 2000");
    cells_[axis] = static_cast<int>(cells);
  }
  const double volume = lattice.world_from_lattice.determinant();
  if (!std::isfinite(volume) || std::abs(volume) < 1e-45) throw GridError("its points do not fill any space");
}

DensityGrid::DensityGrid(const Lattice& lattice, int threads, const Fill& fill) : lattice_(lattice) {
  check(lattice);
  std::vector<CellLayer> layers(static_cast<std::size_t>(cells_[2]));
  for_each_index(cells_[2], threads, [&](int z) {
    CellLayer& layer = layers[static_cast<std::size_t>(z)];
    std::array<float, brick_numbers> numbers;
    for (int y = 0; y < cells_[1]; ++y)
      for (int x = 0; x < cells_[0]; ++x) {
        fill({x * cell_edge, y * cell_edge, z * cell_edge}, numbers.data());
        for (float& number : numbers) {
          refuse_number(number);
          number = std::max(number, 0.0F);
        }
        const auto [least, largest] = std::minmax_element(numbers.begin(), numbers.end());
        if (*least == *largest) {
          layer.least.push_back(*least);
          layer.largest.push_back(*least);
          layer.bricks.push_back(-1);
          continue;
        }
        layer.least.push_back(*least * (1 - rounding));
        layer.largest.push_back(*largest * (1 + rounding));
        layer.bricks.push_back(static_cast<std::int32_t>(layer.numbers.size()));
        layer.numbers.insert(layer.numbers.end(), numbers.begin(), numbers.end());
      }
  });
  std::size_t numbers = 0;
  for (const CellLayer& layer : layers) numbers += layer.numbers.size();
  if (numbers > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw GridError("it has too many numbers: what is not the same everywhere has 2^31 at most");
  numbers_.reserve(numbers);
  for (CellLayer& layer : layers) {
    const auto first = static_cast<std::int32_t>(numbers_.size());
    for (const std::int32_t brick : layer.bricks) bricks_.push_back(brick < 0 ? brick : first + brick);
    cells_largest_.insert(cells_largest_.end(), layer.largest.begin(), layer.largest.end());
    cells_least_.insert(cells_least_.end(), layer.least.begin(), layer.least.end());
    numbers_.insert(numbers_.end(), layer.numbers.begin(), layer.numbers.end());
    layer = {};
  }
  largest_ = *std::max_element(cells_largest_.begin(), cells_largest_.end());
}

std::size_t DensityGrid::bytes() const {
  return 4 * (numbers_.size() + cells_largest_.size() + cells_least_.size() + bricks_.size());
}

double DensityGrid::at(const Vec3d& p) const {
  std::array<int, 3> cell{};
  std::array<double, 3> in_cell{};
  const std::array<double, 3> place{p.x, p.y, p.z};
  const std::array<double, 3> lower{lattice_.lower.x, lattice_.lower.y, lattice_.lower.z};
  const std::array<double, 3> upper{lattice_.upper.x, lattice_.upper.y, lattice_.upper.z};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!(place[axis] >= lower[axis] && place[axis] <= upper[axis])) return 0;
    cell[axis] = std::clamp(static_cast<int>(place[axis]) / cell_edge, 0, cells_[axis] - 1);
    in_cell[axis] = std::clamp(place[axis] - cell[axis] * cell_edge, 0.0, double{cell_edge});
  }
  const auto number = static_cast<std::size_t>((cell[2] * cells_[1] + cell[1]) * cells_[0] + cell[0]);
  if (bricks_[number] < 0) return double{cells_largest_[number]};
  std::array<int, 3> first{};
  for (std::size_t axis = 0; axis < 3; ++axis) first[axis] = std::min(static_cast<int>(in_cell[axis]), cell_edge - 1);
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    int place_in_brick = 0;
    for (int axis = 2; axis >= 0; --axis) {
      const auto a = static_cast<std::size_t>(axis);
      const int upper_one = corner >> axis & 1;
      const double share = in_cell[a] - first[a];
      weight *= upper_one != 0 ? share : 1 - share;
      place_in_brick = place_in_brick * cell_points + first[a] + upper_one;
    }
    sum += weight * double{numbers_[static_cast<std::size_t>(bricks_[number] + place_in_brick)]};
  }
  return sum;
}

}  // namespace raytrace
