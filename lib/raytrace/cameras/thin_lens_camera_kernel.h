// The rays of a thin lens camera.
#pragma once

#include "raytrace/cameras/aperture.h"
#include "raytrace/cameras/pixel_frame.h"
#include "raytrace/cameras/thin_lens_camera.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"

namespace raytrace {

template <>
class Kernel<ThinLensCamera> {
 public:
  Kernel(const ThinLensCamera::Parameters& parameters, const ViewPlane& viewplane)
      : Kernel(parameters, {parameters.eye, parameters.lookat, parameters.up},
               viewplane.pixelsize / parameters.viewdistance, shift_in_pixels(parameters, viewplane)) {}

  Vec2d axis() const { return {-shift_.x, -shift_.y}; }

  template <class F>
  Ray<F> generate(const F& x, const F& y, const FloatN& u1, const FloatN& u2) const {
    const auto& in_focus = in_focus_.vectors<F>();
    const auto& lens = lens_.vectors<F>();
    const auto [right, up] = aperture_.point(u1, u2);
    const Vec3<F> start = lens.at_pixel(lens.forward, F(right), F(up));
    return {Vec3<F>(lens.eye) + start, normalize(in_focus.at_pixel(in_focus.forward, x, y) - start), F(0),
            infinity<F>()};
  }

  /// From the lens' point that generate() has for u1 and u2, in that lane.
  std::optional<FilmPoint> project(const Vec3d& p, const FloatN& u1, const FloatN& u2, std::size_t lane) const {
    const auto& plane = in_focus_.in_double();
    const auto& lens = lens_.in_double();
    const auto [right, up] = aperture_.point(u1, u2);
    const Vec3d start = lens.right * double{right.get(lane)} + lens.up * double{up.get(lane)};
    const Vec3d forward = plane.forward - plane.right * shift_.x - plane.up * shift_.y;
    const double focus = length(forward);
    auto point = project_on_plane(p, lens.eye + start, forward * (1 / focus), plane.right * (1 / focus),
                                  plane.up * (1 / focus), shift_);
    if (!point) return point;
    // Where the way from there crosses the plane in focus, seen from the lens' middle.
    point->x += dot(start, plane.right) / dot(plane.right, plane.right);
    point->y += dot(start, plane.up) / dot(plane.up, plane.up);
    return point;
  }

 private:
  /// The view plane at distance 1, where pixels are so wide.
  Kernel(const ThinLensCamera::Parameters& parameters, const ViewFrame& frame, double pixel, const Vec2d& shift)
      : in_focus_(parameters.eye,
                  -(frame.w - frame.u * (pixel * shift.x) - frame.v * (pixel * shift.y)) * parameters.focaldistance,
                  frame.u * (pixel * parameters.focaldistance), frame.v * (pixel * parameters.focaldistance)),
        lens_(parameters.eye, {0, 0, 0}, frame.u * parameters.lensradius, frame.v * parameters.lensradius),
        aperture_(parameters.blades, parameters.bladerotation),
        shift_(shift) {}

  PixelFrame in_focus_, lens_;  ///< the first's forward: to the picture's center; the lens has one pixel
  Aperture aperture_;
  Vec2d shift_;  ///< of the picture's center from the view's axis, in pixels
};

}  // namespace raytrace
