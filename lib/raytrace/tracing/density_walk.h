// Rays' ways through fog that is not the same everywhere, cell by cell of its grid.
//
// Free flights are drawn for the densest place of each cell, and some of their ends are none, by chance (Woodcock et
// al. 1965, delta tracking); what is left of light is estimated at such ends, beyond what the thinnest place of each
// cell takes (Novák, Selle and Jarosz, "Residual Ratio Tracking for Estimating Attenuation in Participating Media",
// SIGGRAPH Asia 2014). Both have the right mean, whatever the density.
#pragma once

#include <array>

#include "raytrace/math/gather.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/rgba.h"
#include "raytrace/sampling/hash.h"
#include "raytrace/sampling/sampler.h"
#include "raytrace/scene/density_table.h"

namespace raytrace {

/// Distances are along the rays, extinctions for a unit of length.
class DensityWalk {
 public:
  /// The rays' parts from begin to end, in those lanes. unit: the length of the rays' directions.
  DensityWalk(const Density& density, const Ray<FloatN>& rays, const FloatN& unit, const MaskN& lanes,
              const FloatN& begin, const FloatN& end)
      : density_(density), grid_(*density.grid), base_(begin) {
    const DensityGrid::Lattice& lattice = grid_.lattice();
    origin_ = apply_point(density.lattice_from_world, rays.at(begin));
    direction_ = apply_vector(density.lattice_from_world, rays.direction);
    begin_ = FloatN(0);
    last_ = min(end, FloatN(1e17F)) - begin;
    for (int axis = 0; axis < 3; ++axis) {
      const FloatN along = component(direction_, axis);
      // So small a component goes nowhere, and a quotient by 0 might be no number.
      component(inverse_, axis) = FloatN(1) / select(abs(along) < FloatN(1e-30F), FloatN(1e-30F), along);
      const auto to = [&](double side) {
        return (FloatN(static_cast<float>(side)) - component(origin_, axis)) * component(inverse_, axis);
      };
      const FloatN a = to(component(lattice.lower, axis)), b = to(component(lattice.upper, axis));
      begin_ = max(begin_, min(a, b));
      last_ = min(last_, max(a, b));
    }
    lanes_ = lanes & (begin_ < last_);
    begin_ = select(lanes_, begin_, FloatN(0));
    last_ = select(lanes_, last_, FloatN(0));
    // Where a ray's part is shorter than the lattice's edges, as much more counts.
    const FloatN way = max((last_ - begin_) * unit, FloatN(1e-30F));
    most_counted_ = max(FloatN(density.most_extinction), FloatN(Density::most_depth) / way);
    for (int axis = 0; axis < 3; ++axis) {
      const FloatN place = component(origin_, axis) + component(direction_, axis) * begin_;
      const auto last_cell = static_cast<float>(grid_.cells()[static_cast<std::size_t>(axis)] - 1);
      const FloatN cell = min(max(floor(place * FloatN(1.0F / DensityGrid::cell_edge)), FloatN(0)), FloatN(last_cell));
      component(cell_, axis) = select(lanes_, cell, FloatN(0));
    }
    set_cell();
  }

  /// The lanes that are in a cell, and of that: where their parts of it begin and end, and the most and the least that
  /// is there.
  const MaskN& lanes() const { return lanes_; }
  FloatN begin() const { return base_ + begin_; }
  FloatN way() const { return end_ - begin_; }  ///< what is left of its part
  const FloatN& most() const { return most_; }
  const FloatN& least() const { return least_; }

  /// Those go on by that much, within their cells.
  void go_on(const MaskN& lanes, const FloatN& way) { begin_ = select(lanes, min(begin_ + way, end_), begin_); }

  /// Those come to the next cell, or are in none any longer.
  void next(const MaskN& lanes) {
    const MaskN by_x = lanes & (sides_.x <= sides_.y) & (sides_.x <= sides_.z);
    const MaskN by_y = lanes & !by_x & (sides_.y <= sides_.z), by_z = lanes & !by_x & !by_y;
    const auto step = [&](const FloatN& along) { return select(along < FloatN(0), FloatN(-1), FloatN(1)); };
    cell_.x = select(by_x, cell_.x + step(direction_.x), cell_.x);
    cell_.y = select(by_y, cell_.y + step(direction_.y), cell_.y);
    cell_.z = select(by_z, cell_.z + step(direction_.z), cell_.z);
    begin_ = select(lanes, end_, begin_);
    MaskN inside = begin_ < last_;
    for (int axis = 0; axis < 3; ++axis) {
      const auto cells = static_cast<float>(grid_.cells()[static_cast<std::size_t>(axis)]);
      FloatN& cell = component(cell_, axis);
      inside = inside & (cell >= FloatN(0)) & (cell < FloatN(cells));
      cell = min(max(cell, FloatN(0)), FloatN(cells - 1));
    }
    lanes_ = lanes_ & !(lanes & !inside);
    set_cell();
  }

  /// The extinction where they are.
  FloatN extinction() const {
    const MaskN has_brick = float_mask<FloatN>(brick_ > IntN(-1));
    if (none(has_brick & lanes_)) return most_;
    std::array<FloatN, 3> shares;
    IntN place = IntN(0);
    for (int axis = 2; axis >= 0; --axis) {
      const FloatN at = component(origin_, axis) + component(direction_, axis) * begin_ -
                        component(cell_, axis) * FloatN(DensityGrid::cell_edge);
      const FloatN in_cell = min(max(at, FloatN(0)), FloatN(DensityGrid::cell_edge));
      const FloatN first = min(floor(in_cell), FloatN(DensityGrid::cell_edge - 1));
      shares[static_cast<std::size_t>(axis)] = in_cell - first;
      place = place * IntN(DensityGrid::cell_points) + to_int(first);
    }
    constexpr int row = DensityGrid::cell_points, layer = row * row;
    const IntN index = select_lanes(has_brick & lanes_, brick_ + place, IntN(0));
    const float* const numbers = grid_.numbers();
    const auto along_x = [&](int offset) {
      return mix(gather(numbers + offset, index), gather(numbers + offset + 1, index), shares[0]);
    };
    const auto along_y = [&](int offset) { return mix(along_x(offset), along_x(offset + row), shares[1]); };
    return scaled(select(has_brick, mix(along_y(0), along_y(layer), shares[2]), largest_));
  }

 private:
  FloatN scaled(const FloatN& number) const {
    // A flight in a cell of one density ends at once, however large that is.
    const FloatN most = select(float_mask<FloatN>(brick_ > IntN(-1)), most_counted_, FloatN(1e37F));
    return min(number * FloatN(density_.extinction), most);
  }

  void set_cell() {
    const auto& cells = grid_.cells();
    const IntN number = (to_int(cell_.z) * IntN(cells[1]) + to_int(cell_.y)) * IntN(cells[0]) + to_int(cell_.x);
    brick_ = gather(grid_.bricks(), number);
    largest_ = gather(grid_.cells_largest(), number);
    most_ = scaled(largest_);
    least_ = scaled(gather(grid_.cells_least(), number));
    for (int axis = 0; axis < 3; ++axis) {
      const FloatN ahead =
          component(cell_, axis) + select(component(direction_, axis) < FloatN(0), FloatN(0), FloatN(1));
      component(sides_, axis) =
          (ahead * FloatN(DensityGrid::cell_edge) - component(origin_, axis)) * component(inverse_, axis);
    }
    end_ = max(min(min(sides_.x, sides_.y), min(sides_.z, last_)), begin_);
  }

  const Density& density_;
  const DensityGrid& grid_;
  FloatN base_;                                               ///< what the distances below are from
  Vec3<FloatN> origin_, direction_, inverse_, cell_, sides_;  ///< in the lattice; the last: where the cell is left by
  FloatN begin_, end_, last_, most_counted_;
  MaskN lanes_;
  FloatN largest_, most_, least_;
  IntN brick_;
};

/// Random numbers of a ray's way, one after the other. key: of each lane's ray alone.
class FlightNumbers {
 public:
  explicit FlightNumbers(const UintN& key) : key_(mix_bits(key)) {}
  /// In those lanes; anything in others.
  FloatN next(const MaskN& lanes) {
    count_ = select_lanes(lanes, count_ + UintN(1U), count_);
    return to_unit(mix_bits(key_ + count_ * UintN(0x9e3779b9U)));
  }

 private:
  UintN key_, count_{0U};
};

/// A free flight of each lane. u: from 0 to 1, which the first number of the flight is.
struct DensityFlight {
  MaskN ends{false};  ///< those that end in the part of the way
  FloatN distance{0};
};
DensityFlight fly(const Density& density, const Ray<FloatN>& rays, const MaskN& lanes, const FloatN& begin,
                  const FloatN& end, const FloatN& u, const UintN& key);

/// An estimate of what is left of light on that part of the rays, whose directions have the length `unit`.
FloatN left_by(const Density& density, const Ray<FloatN>& rays, const FloatN& unit, const MaskN& lanes,
               const FloatN& begin, const FloatN& end, const UintN& key);

}  // namespace raytrace
