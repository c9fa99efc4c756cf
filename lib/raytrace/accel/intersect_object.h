// A packet of rays and one object.
#pragma once

#include <cstdint>

#include "raytrace/accel/callbacks.h"
#include "raytrace/accel/cutouts.h"
#include "raytrace/accel/primitives.h"
#include "raytrace/scene/hits.h"

namespace raytrace {

/// The nearest hits so far.
struct Nearest {
  Hits& hits;
  FloatN& distance;  ///< of the hits, or where the rays end
  FloatN& far;       ///< as far as the rays are followed: those that have hit something, to behind(distance)
  const RayIdentity* cutouts = nullptr;
};

/// Where rays meet an object without end.
template <class Shape>
FloatN distance_to_cutout(const typename ShapeTable<Shape>::Record& record, std::uint32_t primitive,
                          const Ray<FloatN>& rays, const MaskN& active, const RayIdentity& query) {
  const auto find = [&](const Ray<FloatN>& some, const MaskN& lanes, FloatN&, FloatN&) {
    return Kernel<Shape>::template intersect<FloatN>(record, some, lanes);
  };
  FloatN u(0), v(0);
  constexpr auto geometry = static_cast<std::uint32_t>(index_of<Shape>(Shapes{}));
  return without_passed<FloatN>(query, 0, packet_lanes, {0, geometry, primitive, 0}, rays, find(rays, active, u, v), u,
                                v, find);
}

/// Keeps the hits with an object that come first. rays: their far is nearest.far.
template <class Shape, class Rays>
RAYTRACE_INLINE void intersect_object(const typename ShapeTable<Shape>::Record& record, std::uint32_t primitive,
                                      const Rays& rays, const MaskN& active, const Nearest& nearest) {
  FloatN t, u(0), v(0);  // a triangle that no ray hits leaves u and v as they are
  if constexpr (EmbreeTriangle<Shape>) {
    t = Kernel<Shape>::template intersect<FloatN>(record, rays, active, u, v);
  } else {
    t = Kernel<Shape>::template intersect<FloatN>(record, rays, active);
    if constexpr (UnboundedShape<Shape>)
      if (nearest.cutouts != nullptr) [[unlikely]]
        t = distance_to_cutout<Shape>(record, primitive, rays, active, *nearest.cutouts);
  }
  constexpr auto geometry = static_cast<std::uint32_t>(index_of<Shape>(Shapes{}));
  Hits& hits = nearest.hits;
  const MaskN hit = comes_first<FloatN>(t, {0, geometry, primitive}, nearest.distance, [&]() RAYTRACE_INLINE_LAMBDA {
    return HitIds<UintN>{UintN(0u), hits.geometry, same_bits<UintN>(hits.primitive)};
  });
  if (none(hit)) return;
  nearest.distance = select(hit, t, nearest.distance);
  if constexpr (!UnboundedShape<Shape>) nearest.far = select(hit, behind(t), nearest.far);
  hits.hit = hits.hit | hit;
  hits.geometry = select_lanes(hit, UintN(geometry), hits.geometry);
  hits.primitive = select_lanes(hit, IntN(static_cast<std::int32_t>(primitive)), hits.primitive);
  if constexpr (EmbreeTriangle<Shape>) {
    hits.u = select(hit, u, hits.u);
    hits.v = select(hit, v, hits.v);
  }
}

}  // namespace raytrace
