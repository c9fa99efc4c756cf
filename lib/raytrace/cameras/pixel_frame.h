// What leads camera rays through the picture.
#pragma once

#include <optional>

#include "raytrace/cameras/view_frame.h"
#include "raytrace/math/simd.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

/// Where the picture shows a point.
struct FilmPoint {
  double x, y;      ///< in pixels from the picture's center, to the right and upwards
  Vec3d from;       ///< where the camera's ray to the point starts
  double area;      ///< in square pixels: of the picture, for a unit of area at the point that faces the camera
  double seen = 1;  ///< the share of the way from the point to there along which the camera sees
};

/// What a camera shows of a plane at distance 1 before `from`, whose pixels have those edges, at right angles. shift:
/// from the point before it to the picture's center, in pixels.
inline std::optional<FilmPoint> project_on_plane(const Vec3d& p, const Vec3d& from, const Vec3d& forward,
                                                 const Vec3d& right, const Vec3d& up, const Vec2d& shift) {
  const Vec3d way = p - from;
  const double depth = dot(way, forward), distance = length(way);
  if (!(depth > 0)) return std::nullopt;
  const double pixel = length(right) * length(up);
  return FilmPoint{dot(way, right) / (depth * dot(right, right)) - shift.x,
                   dot(way, up) / (depth * dot(up, up)) - shift.y, from, distance / (depth * depth * depth * pixel)};
}

/// In float, and in double for cameras that are far away.
class PixelFrame {
 public:
  template <class T>
  struct Vectors {
    Vec3<T> eye, forward;
    Vec3<T> right, up;  ///< one pixel

    /// from + right x + up y.
    template <class F>
    RAYTRACE_INLINE Vec3<F> at_pixel(const Vec3<T>& from, const F& x, const F& y) const {
      return {multiply_add(F(right.x), x, multiply_add(F(up.x), y, F(from.x))),
              multiply_add(F(right.y), x, multiply_add(F(up.y), y, F(from.y))),
              multiply_add(F(right.z), x, multiply_add(F(up.z), y, F(from.z)))};
    }
  };

  /// A unit a pixel.
  PixelFrame(const Vec3d& eye, const ViewFrame& frame) : PixelFrame(eye, -frame.w, frame.u, frame.v) {}
  PixelFrame(const Vec3d& eye, const Vec3d& forward, const Vec3d& right, const Vec3d& up)
      : in_float_{Vec3f(eye), Vec3f(forward), Vec3f(right), Vec3f(up)}, in_double_{eye, forward, right, up} {}

  const Vectors<double>& in_double() const { return in_double_; }

  /// As precise as F is.
  template <class F>
  RAYTRACE_INLINE const auto& vectors() const {
    if constexpr (requires(F number) { number.to_float(); }) {
      return in_double_;
    } else {
      return in_float_;
    }
  }

 private:
  Vectors<float> in_float_;
  Vectors<double> in_double_;
};

}  // namespace raytrace
