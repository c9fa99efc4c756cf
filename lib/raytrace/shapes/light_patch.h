// The pieces that surfaces are cut into to draw light from them.
#pragma once

#include <vector>

#include "raytrace/math/vec3.h"

namespace raytrace {

enum class PatchShape {
  parallelogram,  ///< from `origin` with the edges a and b
  triangle,       ///< likewise
  sphere,         ///< about `origin`, of radius a.x
  band,       ///< about the axis a, of unit length: from the circle about `origin` of radius b.x to the one of radius
              ///< b.y that lies b.z further along it
  ellipsoid,  ///< about `origin`, where the symmetric map of diagonal a, and b.x in its row y and column z and so on,
              ///< takes the unit sphere
  torus,      ///< about `origin` and the axis a, of swept radius b.x and tube radius b.y
  ellipse,    ///< about `origin`, with the half axes a and b - h a, which are at right angles: h is the size of a hole
              ///< of the same shape, over its own, or 0
};

/// The front is where a turns to b anticlockwise, and the outside of a sphere, an ellipsoid and a torus. That of a band
/// is to the right of the way from its first circle to its second, in a plane that has the axis, upwards, on its left:
/// the outside of a cylinder, and of a disk that runs from its rim to its center, the axis' side.
struct LightPatch {
  PatchShape shape;
  Vec3d origin, a, b;
};

}  // namespace raytrace
