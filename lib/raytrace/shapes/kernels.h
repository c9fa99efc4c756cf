// The kernels of all shapes.
//
// A shape's Kernel provides:
//   template <class T> struct Record { ... };      what the tracer keeps of an object: members of type T only
//   static Record<float or double> record(const Parameters&);
//   static Bounds bounds(const Record<...>&);      none: the shape has no end, and stays out of the BVH
//   static double bounding_radius(const Record<...>&);   perhaps: of a sphere around it with the center of its bounds
//   template <class F> static F intersect(const Record<...>&, const Ray<F>&, const Mask<F>& active);
//   template <class F> static Mask<F> occludes(const Record<...>&, const Ray<F>&, const Mask<F>& active);   perhaps
//   template <class F> static SurfacePoint<F> surface(const Record<Wide>&, const Ray<F>&, const F& distance);
//     of a closed shape with its normal outwards
//   template <class F> static SurfaceUv<F> uv(const Record<Wide>&, const Vec3<F>& position, const Vec3<F>& normal);
//     the texture coordinates at a position that surface() gave; the normal may have been turned round
//   static void add_patches(const Record<...>&, std::vector<LightPatch>&);   perhaps: what light is drawn from, where
//   an
//     object shines; else its light is met by rays that go there of themselves
// A Record that is no template is of a shape whose objects are few: surface() then takes one of them.
#pragma once

#include <algorithm>

#include "raytrace/math/bounds.h"
#include "raytrace/shapes/annulus_kernel.h"
#include "raytrace/shapes/box_kernel.h"
#include "raytrace/shapes/cone_kernel.h"
#include "raytrace/shapes/cylinder_kernel.h"
#include "raytrace/shapes/disk_kernel.h"
#include "raytrace/shapes/plane_kernel.h"
#include "raytrace/shapes/rectangle_kernel.h"
#include "raytrace/shapes/registry.h"
#include "raytrace/shapes/sphere_kernel.h"
#include "raytrace/shapes/torus_kernel.h"
#include "raytrace/shapes/triangle_kernel.h"

namespace raytrace {

/// The radius of a sphere around an object, whose center is that of its bounds.
template <class Shape, class Record>
double bounding_radius(const Record& record) {
  const double radius = sphere_around(Kernel<Shape>::bounds(record)).radius;
  if constexpr (requires { Kernel<Shape>::bounding_radius(record); })
    return std::min(radius, Kernel<Shape>::bounding_radius(record));
  else
    return radius;
}

}  // namespace raytrace
