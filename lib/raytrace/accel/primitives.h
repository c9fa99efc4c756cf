// What the callbacks put rays to: the records of shapes, the faces of meshes, and the pieces of curves.
#pragma once

#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"
#include "raytrace/scene/geometry_table.h"

namespace raytrace {

/// Shapes whose records are Embree's triangles.
template <class Shape>
concept EmbreeTriangle = requires { &Kernel<Shape>::template Record<float>::vertex1; };

/// Shapes without end: every ray is tested against them, and they stay out of the BVH. There all boxes on the way to
/// them would be without end.
template <class Shape>
concept UnboundedShape = !requires { &Kernel<Shape>::bounds; };

/// All others: they bring their own intersection, and bounds for a BVH to keep them in.
template <class Shape>
concept UserGeometry = !EmbreeTriangle<Shape> && !UnboundedShape<Shape>;

/// Shapes whose objects are few and large: their surface() takes one, so that it can be of the plain numbers.
template <class Shape>
concept SurfaceOfOne = requires(typename ShapeTable<Shape>::Record record, Ray<FloatN> rays, FloatN distance) {
  Kernel<Shape>::surface(record, rays, distance);
};

/// Whether the object lies on the rays, in the lanes of `active`. Kernel::occludes(), where there is one, need not find
/// out where.
template <class Shape, class Record, class F>
RAYTRACE_INLINE Mask<F> occludes(const Record& record, const Ray<F>& ray, const Mask<F>& active) {
  if constexpr (requires { Kernel<Shape>::template occludes<F>(record, ray, active); }) {
    return Kernel<Shape>::template occludes<F>(record, ray, active);
  } else if constexpr (EmbreeTriangle<Shape>) {
    F u, v;
    return Kernel<Shape>::template intersect<F>(record, ray, active, u, v) < infinity<F>();
  } else {
    return Kernel<Shape>::template intersect<F>(record, ray, active) < infinity<F>();
  }
}

namespace detail {

/// The user pointer of a shape's geometry is its table.
template <class Shape>
const auto& record_of(void* table, unsigned primitive) {
  return static_cast<const ShapeTable<Shape>*>(table)->records[primitive];
}

/// The triangles of a shape's table.
template <class Shape>
struct RecordTriangles {
  template <class F>
  RAYTRACE_INLINE static F intersect(void* table, std::uint32_t primitive, const Ray<F>& rays, const Mask<F>& active,
                                     F& u, F& v) {
    return Kernel<Shape>::template intersect<F>(record_of<Shape>(table, primitive), rays, active, u, v);
  }
};

/// The faces of a mesh. Their user pointer is its MeshTable.
struct MeshFaces {
  template <class F>
  RAYTRACE_INLINE static F intersect(void* table, std::uint32_t face, const Ray<F>& rays, const Mask<F>& active, F& u,
                                     F& v) {
    const MeshTable& mesh = *static_cast<const MeshTable*>(table);
    const F t = Kernel<Triangle>::intersect<F>(mesh.triangle(face), rays, active, u, v);
    if (mesh.corners() == 3) return t;
    F second_u(0), second_v(0);
    const F second = Kernel<Triangle>::intersect<F>(mesh.triangle(face, true), rays, active, second_u, second_v);
    const Mask<F> nearer = second < t;
    u = select(nearer, F(1) - second_u, u);
    v = select(nearer, F(1) - second_v, v);
    return select(nearer, second, t);
  }
};

/// The objects of a shape that brings its own intersection.
template <class Shape>
struct ShapeObjects {
  template <class F>
  RAYTRACE_INLINE static F intersect(void* table, std::uint32_t primitive, const Ray<F>& rays, const Mask<F>& active,
                                     std::int32_t, F&) {
    return Kernel<Shape>::template intersect<F>(record_of<Shape>(table, primitive), rays, active);
  }
  template <class F>
  RAYTRACE_INLINE static Mask<F> occludes(void* table, std::uint32_t primitive, const Ray<F>& rays,
                                          const Mask<F>& active, std::int32_t) {
    return raytrace::occludes<Shape>(record_of<Shape>(table, primitive), rays, active);
  }
};

/// The pieces of curves. Their user pointer is their CurveTable. material: in place of their own, or -1.
struct CurvePieces {
  static constexpr bool has_u = true;
  template <class F>
  RAYTRACE_INLINE static F intersect(void* table, std::uint32_t piece, const Ray<F>& rays, const Mask<F>& active,
                                     std::int32_t material, F& u) {
    return static_cast<const CurveTable*>(table)->intersect<F>(piece, rays, active, material, u);
  }
  template <class F>
  RAYTRACE_INLINE static Mask<F> occludes(void* table, std::uint32_t piece, const Ray<F>& rays, const Mask<F>& active,
                                          std::int32_t material) {
    F u(0);
    return intersect<F>(table, piece, rays, active, material, u) < infinity<F>();
  }
};

}  // namespace detail

}  // namespace raytrace
