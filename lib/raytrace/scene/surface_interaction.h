// What a ray met, as shading wants it.
#pragma once

#include "raytrace/bsdfs/layer_normals.h"
#include "raytrace/math/ray.h"

namespace raytrace {

/// In world space. Lanes without a hit hold anything.
template <class F>
struct SurfaceInteraction {
  Vec3<F> p;      ///< on the surface as closely as floats allow
  Vec3<F> ng;     ///< the surface's normal, of unit length, on the side that the ray came from
  Vec3<F> ns;     ///< the normal for shading, likewise
  Vec3<F> wo;     ///< unit length, to where the ray came from
  Mask<F> front;  ///< whether the ray came from the surface's front
  F error;        ///< bound of the distance between p and the true surface

  /// On meshes with normals at vertices, from p to the smooth surface that they stand for, where it bulges above the
  /// flat faces: so far out, shadows are those of the smooth surface. Hanika, "Hacking the Shadow Terminator", Ray
  /// Tracing Gems II, chapter 4.
  Vec3<F> to_smooth_surface;
  bool is_smooth = false;     ///< whether any lane has it
  Vec3<F> ns_without_relief;  ///< where is_smooth and has_relief

  /// Whether a normal map or a bump has turned any lane's ns, and the lanes where light then ends softly.
  bool has_relief = false;
  Mask<F> relief;

  /// Whether light comes out in any lane that went in below the surface elsewhere, and which lanes': it leaves evenly
  /// to all sides.
  bool has_emerging = false;
  Mask<F> emerges;

  /// Whether coats have normals of their own in any lane; there they and the base below turn from ns, which is the
  /// surface's without relief.
  bool has_layers = false;
  LayerNormals<F> layers;

  /// The normal whose side says which light comes to the surface: ng, or, where a smooth surface bulges above flat
  /// faces, the smooth one's.
  Vec3<F> true_normal() const {
    if (!is_smooth) return ng;
    const Vec3<F>& far = to_smooth_surface;
    return select(abs(far.x) + abs(far.y) + abs(far.z) > F(0), has_relief ? ns_without_relief : ns, ng);
  }

  /// ns, or what it is of what is diffuse of the base.
  Vec3<F> base_normal() const { return has_layers ? select(layers.lanes, layers.diffuse, ns) : ns; }
};

/// The share of the light from wi, of unit length, that reaches the surface. Of those that have relief.
template <class F>
RAYTRACE_INLINE F relief_shadow(const SurfaceInteraction<F>& surface, const Vec3<F>& wi) {
  const Vec3<F> normal = surface.true_normal();
  const F share = relief_shadow(dot(normal, wi), dot(surface.ns, wi), dot(normal, surface.ns));
  return select(surface.relief, share, F(1));
}

/// Where rays that leave the surface on ng's side start: p moved along ng just so far that neither its own rounding nor
/// that of an intersection with the surface it lies on can put it on the other side: a few units in the last place of
/// its largest coordinate. This is the one place that decides it; no other code has an epsilon for this. Wächter and
/// Binder, "A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing Gems chapter 6, argue why the
/// distance must scale so.
template <class F>
RAYTRACE_INLINE Vec3<F> offset_ray_origin(const SurfaceInteraction<F>& surface) {
  const Vec3<F> origin = surface.p + surface.ng * (surface.error * F(4));
  return surface.is_smooth ? origin + surface.to_smooth_surface : origin;
}

/// The same of rays that leave on the other side in the lanes of `through`.
template <class F>
RAYTRACE_INLINE Vec3<F> offset_ray_origin(const SurfaceInteraction<F>& surface, const Mask<F>& through) {
  const Vec3<F> origin = offset_ray_origin(surface);
  return any(through) ? select(through, surface.p - surface.ng * (surface.error * F(4)), origin) : origin;
}

}  // namespace raytrace
