// A point or spotlight that falls off, as tables of many have it: each lane may have another.
#pragma once

#include "raytrace/lights/light_sample.h"
#include "raytrace/lights/point_radiance.h"

namespace raytrace {

/// What of a spotlight's light goes into directions of those cosines to its axis. A cubic in the cosine, without
/// corners at either end, as in pbrt. inverse_width: of the penumbra, in cosines; 0: there is none. Nothing for NaN.
template <class F, class G>
RAYTRACE_INLINE F cone_share(const F& cosine, const G& edge_cosine, const G& inverse_width) {
  const F above_edge = cosine - edge_cosine;
  const F x = select(F(inverse_width) > F(0), min(above_edge * inverse_width, F(1)), F(1));
  return select(above_edge >= F(0), x * x * (F(3) - F(2) * x), F(0));
}

/// T: float, or what a packet has of each lane's.
template <class T>
struct PointSource {
  Vec3<T> location;
  Rgb<T> radiance;               ///< at distance 1, along the axis
  T largest_share;               ///< of it that a point gets (point_radiance.h)
  Vec3<T> towards;               ///< against the axis of its cone, of unit length
  T edge_cosine, inverse_width;  ///< of the cone; an edge below -1: it shines everywhere

  LightSample<T> sample(const Vec3<T>& p) const {
    const Vec3<T> to_light = location - p;
    const T cone = cone_share(dot(normalize(to_light), towards), edge_cosine, inverse_width);
    const T share = select(edge_cosine < T(-1), T(1), cone);
    return {to_light, T(1), radiance * (share * inverse_square(to_light, largest_share))};
  }
};

}  // namespace raytrace
