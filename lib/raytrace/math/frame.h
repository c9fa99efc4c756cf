// An orthonormal frame about a normal, in which BSDFs draw directions: there the normal is z.
#pragma once

#include "raytrace/math/vec3.h"

namespace raytrace {

/// T: float or a batch.
template <class T>
struct Frame {
  Vec3<T> x, y, z;

  /// z: of unit length. Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017.
  explicit Frame(const Vec3<T>& normal) : z(normal) {
    const T sign = select(normal.z < T(0), T(-1), T(1));
    const T a = T(-1) / (sign + normal.z);
    const T b = normal.x * normal.y * a;
    x = {T(1) + sign * normal.x * normal.x * a, sign * b, -sign * normal.x};
    y = {b, sign + normal.y * normal.y * a, -normal.y};
  }

  Vec3<T> to_local(const Vec3<T>& v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
  Vec3<T> to_world(const Vec3<T>& v) const { return x * v.x + y * v.y + z * v.z; }
};

}  // namespace raytrace
