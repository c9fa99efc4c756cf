// Scenes of few objects, where testing each ray with all of them is faster than Embree's queries for rays that scatter:
// those are for one ray each, and call back for each object that it may hit.
//
// The rays of a packet are tested with the box of each object. Rays that scatter meet few boxes of spheres and
// triangles, and different ones: the pairs of a ray and an object are collected, and tested as packets whose lanes have
// objects of their own. An object of another shape is tested with all rays that meet its box. What is hit is what
// Embree's callbacks decide, by the same arithmetic and the same order of what is equally far.
#pragma once

#include <cstdint>
#include <vector>

#include "raytrace/math/bounds.h"
#include "raytrace/scene/geometry_table.h"
#include "raytrace/scene/hits.h"

namespace raytrace {

class FewObjects {
 public:
  /// The table's objects that have bounds; none if they are too many, or there are instances.
  explicit FewObjects(const GeometryTable& table);

  bool empty() const { return boxes_.empty(); }
  /// Forgets all.
  void clear() { boxes_.clear(); }

  /// The nearest hits in the lanes of `active`, whose rays Embree could take. distance, hits: of the hits so far;
  /// rays.far: as far as the rays are followed.
  void intersect(Ray<FloatN>& rays, const MaskN& active, FloatN& distance, Hits& hits) const;

  /// The lanes of `active` in which anything lies between near and far.
  MaskN occluded(const Ray<FloatN>& rays, const MaskN& active) const;

 private:
  struct Id {
    std::uint32_t geometry, primitive;
    bool second_triangle;  ///< of a quad
  };
  struct NearestOfLanes;

  template <class Shape>
  void add_shapes();
  void add_mesh(std::uint32_t geometry);
  void add(const Bounds& box, std::uint32_t geometry, std::size_t primitive, bool second_triangle = false);
  /// Calls f(type, record, primitive, lanes) for each object that is no sphere and no triangle, with the rays that meet
  /// its box, until it returns false. The result: whether it never did.
  template <class Meets, class Function>
  bool for_each_other(const Meets& meets, const Function& f) const;

  const GeometryTable& table_;
  // Of spheres, then triangles, then all others.
  std::vector<Bounds> boxes_;
  std::vector<Id> ids_;
  std::vector<Kernel<Sphere>::Record<float>> spheres_;
  std::vector<Kernel<Triangle>::Record<float>> triangles_;
};

}  // namespace raytrace
