// The pieces that surfaces are cut into to draw light from them.
#pragma once

#include <vector>

#include "raytrace/math/vec3.h"

namespace raytrace {

enum class PatchShape {
  parallelogram,  ///< from `origin` with the edges a and b
  triangle,       ///< likewise
  sphere,         ///< about `origin`, of radius a.x
  band,   ///< about the axis a, of unit length: from the circle about `origin` of radius b.x to the one of radius
          ///< b.y that lies b.z further along it
  torus,  ///< about `origin` and the axis a, of swept radius b.x and tube radius b.y
};

/// Its front is where a turns to b anticlockwise, the outside of a sphere and a torus, and of a band the side that is
/// on the right of someone who walks on it along the axis, outwards: the outside of a cylinder; of a disk, a band from
/// its rim to its center, the side of the axis.
struct LightPatch {
  PatchShape shape;
  Vec3d origin, a, b;
};

}  // namespace raytrace
