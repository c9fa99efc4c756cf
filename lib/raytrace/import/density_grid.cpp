#include "raytrace/import/density_grid.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>

#include "raytrace/import/grid_limits.h"
#include "raytrace/memory/process_status.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

namespace {

using CellBrick = std::array<float, DensityGrid::brick_numbers>;

/// Those of one layer of cells, z being the same: of each that has one, behind each other.
using LayerBricks = std::vector<std::unique_ptr<CellBrick>>;

/// By so much linear means may be beyond what they are between, as floats round.
constexpr float rounding = 0x1p-20F;

void refuse_number(float number) {
  if (!std::isfinite(number)) throw GridError("it has a number that is not finite");
  if (number > 1e17F) throw GridError("it has a number above 1e17");
}

std::string too_many_bricks(std::uint64_t most) {
  return "its density changes in more than " + std::to_string(most) +
         " cells of 8 x 8 x 8 points; more do not fit into half of the memory that is free, or are too many to count";
}

}  // namespace

void DensityGrid::check_memory(std::uint64_t bytes) {
  const std::uint64_t available = available_memory();
  if (bytes > available / 2)
    throw GridError("it takes " + std::to_string(bytes >> 20U) + " MiB of memory; of " +
                    std::to_string(available >> 20U) + " MiB that are free, half may be used");
}

std::array<int, 3> DensityGrid::cells_of(const Lattice& lattice) {
  std::array<int, 3> all{};
  std::int64_t count = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t points = lattice.points[axis];
    if (points < 2) throw GridError("it has no points");
    const std::int64_t cells = (points - 2) / cell_edge + 1;
    if (cells <= most_cells) count *= cells;
    if (std::max<std::int64_t>(cells, count) > most_cells)
      throw GridError(too_many_points(
          {lattice.points[0] - lattice.added, lattice.points[1] - lattice.added, lattice.points[2] - lattice.added}));
    all[axis] = static_cast<int>(cells);
  }
  const double volume = lattice.world_from_lattice.determinant();
  if (!std::isfinite(volume) || std::abs(volume) < 1e-45) throw GridError("its points do not fill any space");
  return all;
}

DensityGrid::DensityGrid(const Lattice& lattice, int threads, const Fill& fill, std::optional<std::uint64_t> most_bytes)
    : lattice_(lattice), cells_(cells_of(lattice)) {
  if (!most_bytes) most_bytes = available_memory() / 2;
  const std::uint64_t most_bricks = std::min<std::uint64_t>(*most_bytes / 2 / sizeof(CellBrick),
                                                            std::numeric_limits<std::int32_t>::max() / brick_numbers);
  std::atomic<std::uint64_t> bricks = 0;
  std::vector<LayerBricks> layers(static_cast<std::size_t>(cells_[2]));
  const auto in_layer = static_cast<std::size_t>(cells_[0] * cells_[1]);
  cells_largest_.resize(layers.size() * in_layer);
  cells_least_.resize(cells_largest_.size());
  bricks_.resize(cells_largest_.size(), -1);
  for_each_index(cells_[2], threads, [&](int z) {
    LayerBricks& layer = layers[static_cast<std::size_t>(z)];
    CellBrick numbers;
    std::size_t cell = static_cast<std::size_t>(z) * in_layer;
    for (int y = 0; y < cells_[1]; ++y)
      for (int x = 0; x < cells_[0]; ++x, ++cell) {
        fill({x * cell_edge, y * cell_edge, z * cell_edge}, numbers.data());
        for (float& number : numbers) {
          refuse_number(number);
          number = std::max(number, 0.0F);
        }
        const auto [least, largest] = std::minmax_element(numbers.begin(), numbers.end());
        cells_least_[cell] = cells_largest_[cell] = *least;
        if (*least == *largest) continue;
        if (++bricks > most_bricks) throw GridError(too_many_bricks(most_bricks));
        cells_least_[cell] = *least * (1 - rounding);
        cells_largest_[cell] = *largest * (1 + rounding);
        bricks_[cell] = 0;
        layer.push_back(std::make_unique<CellBrick>(numbers));
      }
  });
  numbers_.reserve(static_cast<std::size_t>(bricks) * brick_numbers);
  auto brick = bricks_.begin();
  for (LayerBricks& layer : layers) {
    for (const auto& numbers : layer) {
      brick = std::find(brick, bricks_.end(), 0);
      *brick++ = static_cast<std::int32_t>(numbers_.size());
      numbers_.insert(numbers_.end(), numbers->begin(), numbers->end());
    }
    layer = LayerBricks();
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
