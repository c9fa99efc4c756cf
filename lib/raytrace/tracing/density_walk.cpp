#include "raytrace/tracing/density_walk.h"

#include "raytrace/tracing/fog_distances.h"

namespace raytrace {

namespace {

/// Of a flight; one that has had as many is in what no light gets through.
constexpr int most_ends = 1 << 20;

}  // namespace

DensityFlight fly(const Density& density, const Ray<FloatN>& rays, const MaskN& lanes, const FloatN& begin,
                  const FloatN& end, const FloatN& u, const UintN& key) {
  DensityFlight flight;
  DensityWalk walk(density, rays, FloatN(1), lanes, begin, end);
  FlightNumbers numbers(key);
  FloatN depth = depth_of_share(u);  // that is left to fly
  MaskN flying = walk.lanes();
  for (int i = 0; i < most_ends && any(flying); ++i) {
    // To the next end, or out of all cells. Lanes that are there wait for the others.
    MaskN goes_on = flying;
    while (any(goes_on)) {
      const FloatN passed = walk.most() * walk.way();
      goes_on = goes_on & !(depth < passed);
      depth = select(goes_on, depth - passed, depth);
      walk.next(goes_on);
      goes_on = goes_on & walk.lanes();
    }
    flying = flying & walk.lanes();
    if (none(flying)) break;
    walk.go_on(flying, depth / walk.most());
    const MaskN is_end = flying & (numbers.next(flying) * walk.most() < walk.extinction());
    flight.distance = select(is_end, walk.begin(), flight.distance);
    flight.ends = flight.ends | is_end;
    flying = flying & !is_end;
    depth = select(flying, depth_of_share(numbers.next(flying)), depth);
  }
  return flight;
}

FloatN left_by(const Density& density, const Ray<FloatN>& rays, const FloatN& unit, const MaskN& lanes,
               const FloatN& begin, const FloatN& end, const UintN& key) {
  DensityWalk walk(density, rays, unit, lanes, begin, end);
  FlightNumbers numbers(key);
  FloatN left(1), taken(0);  // the latter: the depth of the thinnest
  MaskN flying = walk.lanes();
  FloatN depth = depth_of_share(numbers.next(flying));
  const auto rest = [&] { return (walk.most() - walk.least()) * unit; };
  for (int i = 0; i < most_ends && any(flying); ++i) {
    MaskN goes_on = flying;
    while (any(goes_on)) {
      const FloatN passed = rest() * walk.way();
      goes_on = goes_on & !(depth < passed);
      depth = select(goes_on, depth - passed, depth);
      taken = select(goes_on, taken + walk.least() * unit * walk.way(), taken);
      walk.next(goes_on);
      goes_on = goes_on & walk.lanes() & (taken < FloatN(100));  // of more, nothing is left in float
    }
    flying = flying & walk.lanes() & (taken < FloatN(100));
    if (none(flying)) break;
    const FloatN way = min(depth / rest(), walk.way());
    taken = select(flying, taken + walk.least() * unit * way, taken);
    walk.go_on(flying, way);
    const FloatN more = max(walk.extinction() - walk.least(), FloatN(0)) * unit / rest();
    left = select(flying, left * max(FloatN(1) - more, FloatN(0)), left);
    // Little light is followed by chance.
    const FloatN survival = left * exp(-taken) * FloatN(8);
    const MaskN at_stake = flying & (survival < FloatN(1));
    if (any(at_stake)) {
      const MaskN dies = at_stake & (numbers.next(at_stake) >= survival);
      left = select(dies, FloatN(0), select(at_stake, left / max(survival, FloatN(1e-30F)), left));
      flying = flying & !dies & (left > FloatN(0));
    }
    depth = select(flying, depth_of_share(numbers.next(flying)), depth);
  }
  return select(lanes, left * exp(-taken), FloatN(1));
}

}  // namespace raytrace
