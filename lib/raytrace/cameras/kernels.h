// The kernels of all cameras.
//
// A camera's Kernel provides:
//   Kernel(const Parameters&, const ViewPlane&);
//   template <class F> Ray<F> generate(const F& x, const F& y) const;
//                              rays through points of the picture: x to the right and y upwards from its center, in
//                              pixels; directions of unit length. F: floats, or Doubles of them
//   Vec3f origin() const;      if all rays start there
#pragma once

#include "raytrace/cameras/orthographic_camera_kernel.h"
#include "raytrace/cameras/pinhole_camera_kernel.h"
#include "raytrace/cameras/registry.h"
