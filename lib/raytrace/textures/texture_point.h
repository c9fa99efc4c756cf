// Where a surface point lies for its textures.
#pragma once

#include "raytrace/math/color.h"
#include "raytrace/math/vec2.h"
#include "raytrace/math/vec3.h"
#include "raytrace/textures/texture_space.h"
#include "raytrace/textures/uv_set.h"

namespace raytrace {

/// On the surface, as one set of texture coordinates has it.
template <class F>
struct UvPoint {
  Vec2<F> uv;
  Vec2<F> uv_across, uv_along;
  /// Where u and v grow: how the point moves with them, or, on a smooth mesh, what is between the tangents of its
  /// vertices. Not of unit length; 0 0 0 where a coordinate says nothing, as at a pole.
  Vec3<F> tangent, bitangent;
};

/// In a space.
template <class F>
struct SpacePoint {
  Vec3<F> p, p_across, p_along;
};

/// In space and on the surface, with half of what a pixel covers there: samples share a pixel. It is about the shape
/// with the two axes `across` and `along`, at right angles: `along` is the one that the view stretches. Lanes that hit
/// nothing hold anything.
template <class F>
struct TexturePoint : UvPoint<F> {
  SpacePoint<F> world, object;  ///< the latter: anything in scenes without textures in that space
  Rgb<F> vertex_color;          ///< between those of the mesh's vertices; white where there are none
  F vertex_alpha;               ///< likewise; 1 where there are none
  UvPoint<F> second;            ///< of the second set; anything in scenes that have no texture which asks for it

  const SpacePoint<F>& in(TextureSpace space) const { return space == TextureSpace::world ? world : object; }
  UvPoint<F>& by(UvSet set) { return set == UvSet::first ? *this : second; }
  const UvPoint<F>& by(UvSet set) const { return set == UvSet::first ? *this : second; }
};

/// How much of a coordinate is covered, of which the axes cover so much.
template <class F>
RAYTRACE_INLINE F covered(const F& across, const F& along) {
  return sqrt(across * across + along * along);
}

}  // namespace raytrace
