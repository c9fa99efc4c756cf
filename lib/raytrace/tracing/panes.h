// Light that comes straight through panes.
//
// A thin wall bends nothing, so that lights are behind it where they are in view: shadow rays pass it, and lose what it
// reflects and absorbs. Paths that come straight through one know where they were last scattered, so that what they
// meet is weighed as what is drawn from there.
#pragma once

#include "raytrace/accel/traced_scene.h"

namespace raytrace {

/// Of shadow rays from a point.
struct PanesAhead {
  IntN most;                  ///< so many at most may be crossed
  Refraction<FloatN> around;  ///< by the index of the medium that they are in
  FloatN distance;            ///< the length of the path up to the point
};

/// What panes leave of the light that comes along rays; nothing of rays that cross more than panes.most.
Rgb<FloatN> light_through_panes(const TracedScene& scene, const Ray<FloatN>& rays, const MaskN& lanes,
                                const RayIds& ids, const PanesAhead& panes);

/// Whether these directions go on straight from those, both of unit length: as far as rounding says.
inline MaskN goes_straight(const Vec3<FloatN>& from, const Vec3<FloatN>& to) {
  const Vec3<FloatN> difference = to - from;
  return dot(difference, difference) < FloatN(1e-8F);
}

}  // namespace raytrace
