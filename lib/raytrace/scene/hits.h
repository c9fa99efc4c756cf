// What packets of rays hit.
#pragma once

#include <cstddef>
#include <cstdint>

#include "raytrace/math/lanes.h"
#include "raytrace/math/simd.h"

namespace raytrace {

/// The nearest hits of a packet. Lanes that hit nothing hold anything.
struct Hits {
  MaskN hit;
  UintN instance;  ///< as InstanceTable numbers them; 0: none
  UintN geometry;  ///< index in the GeometryTable of the world or of the instance's group
  IntN primitive;  ///< index among the geometry's
  FloatN u, v;     ///< barycentric coordinates on triangles
  FloatN time{0};  ///< of the rays, from the opening of the shutter, 0, to its closing, 1

  bool in_instances = false;  ///< whether any lane hit one

  // Of the first lane with a hit, and whether all others with one hit the same geometry of the world, and the same
  // primitive of it, as neighbours mostly do.
  std::uint32_t first_geometry = 0;
  std::int32_t first_primitive = 0;
  bool one_geometry = false, one_primitive = false;

  /// Sets what is of the first lane with a hit, if there is one.
  RAYTRACE_INLINE void find_first() {
    in_instances = false;
    if (none(hit)) return;
    const std::size_t lane = first_lane(hit);
    first_geometry = geometry.get(lane);
    first_primitive = primitive.get(lane);
    in_instances = any(hit & float_mask<FloatN>(instance != UintN(0u)));
    one_geometry = !in_instances && none(hit & float_mask<FloatN>(geometry != UintN(first_geometry)));
    one_primitive = one_geometry && none(hit & float_mask<FloatN>(primitive != IntN(first_primitive)));
  }
};

/// Of rays that hit nothing, as queries leave them: tables may be asked for any lane.
inline Hits no_hits() {
  Hits hits;
  hits.hit = MaskN(false);
  hits.instance = hits.geometry = UintN(0u);
  hits.primitive = IntN(0);
  hits.u = hits.v = FloatN(0);
  return hits;
}

/// Lane by lane: a where the mask is true, else b.
inline Hits select(const MaskN& mask, const Hits& a, const Hits& b) {
  Hits hits;
  hits.hit = (a.hit & mask) | (b.hit & !mask);
  hits.instance = select_lanes(mask, a.instance, b.instance);
  hits.geometry = select_lanes(mask, a.geometry, b.geometry);
  hits.primitive = select_lanes(mask, a.primitive, b.primitive);
  hits.u = select(mask, a.u, b.u);
  hits.v = select(mask, a.v, b.v);
  hits.time = select(mask, a.time, b.time);
  hits.find_first();
  return hits;
}

}  // namespace raytrace
