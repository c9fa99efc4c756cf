// Where a surface point lies for its textures.
#pragma once

#include "raytrace/math/color.h"
#include "raytrace/math/vec2.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

/// In space and on the surface, with half of what a pixel covers there: samples share a pixel. It is about the shape
/// with the two axes `across` and `along`, at right angles: `along` is the one that the view stretches. Lanes that hit
/// nothing hold anything.
template <class F>
struct TexturePoint {
  Vec3<F> p;
  Vec3<F> p_across, p_along;
  Vec2<F> uv;
  Vec2<F> uv_across, uv_along;
  Vec3<F> dpdu, dpdv;   ///< how the point moves with u and v
  Rgb<F> vertex_color;  ///< between those of the mesh's vertices; white where there are none
};

/// How much of a coordinate is covered, of which the axes cover so much.
template <class F>
RAYTRACE_INLINE F covered(const F& across, const F& along) {
  return sqrt(across * across + along * along);
}

}  // namespace raytrace
