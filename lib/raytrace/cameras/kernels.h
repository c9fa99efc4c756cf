// The kernels of all cameras.
//
// A camera's Kernel provides:
//   Kernel(const Parameters&, const ViewPlane&);
//   template <class F> Ray<F> generate(const F& x, const F& y) const;
//                              rays through points of the picture: x to the right and y upwards from its center, in
//                              pixels; directions of unit length. F: floats, or Doubles of them
//   template <class F> Ray<F> generate(const F& x, const F& y, const FloatN& u1, const FloatN& u2) const;
//                              or this, if rays to one point of the picture start at many points of a lens, uniformly
//                              distributed if (u1, u2) are, over the unit square
//   MaskN has_ray(const FloatN& x, const FloatN& y) const;
//                              if the picture has points without a ray, which are black; generate() gives any there
//   Vec3f origin() const;      if all rays start there
//   Vec2d axis() const;        if the view's axis may meet another point of the picture than its center: that point
//   std::optional<FilmPoint> project(const Vec3d& p) const;   where the picture shows p (cameras/pixel_frame.h); none:
//                              nowhere. With a lens (p, u1, u2, lane): from the point of it that generate() has for
//                              these in that lane
#pragma once

#include "raytrace/cameras/fisheye_camera_kernel.h"
#include "raytrace/cameras/orthographic_camera_kernel.h"
#include "raytrace/cameras/pinhole_camera_kernel.h"
#include "raytrace/cameras/registry.h"
#include "raytrace/cameras/spherical_camera_kernel.h"
#include "raytrace/cameras/thin_lens_camera_kernel.h"
