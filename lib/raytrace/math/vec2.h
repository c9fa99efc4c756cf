// Pairs of numbers: places in a texture, and ways across it.
#pragma once

namespace raytrace {

/// T is a scalar or a SIMD batch.
template <class T>
struct Vec2 {
  T x, y;  // not set by default, as in Vec3
};

using Vec2d = Vec2<double>;

}  // namespace raytrace
