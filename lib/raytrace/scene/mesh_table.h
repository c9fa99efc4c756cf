// A mesh as the tracer reads it: buffers that Embree shares, and what shading takes from them.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "raytrace/description/scene_description.h"
#include "raytrace/import/vertex_tangents.h"
#include "raytrace/math/bounds.h"
#include "raytrace/math/gather.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"
#include "raytrace/math/surface_uv.h"
#include "raytrace/scene/hits.h"
#include "raytrace/scene/instance_table.h"
#include "raytrace/shapes/kernels.h"
#include "raytrace/textures/uv_set.h"

namespace raytrace {

/// One triangle for each lane: a face, or half of one.
struct LaneTriangles {
  IntN vertex1, vertex2, vertex3;  ///< in the mesh's buffers
  FloatN u, v;                     ///< of the lane's hit, as Kernel<Triangle> has them
};

/// Of the materials that there are, what meshes want to know.
struct MeshMaterials {
  std::span<const std::int32_t> first;  ///< of each material type, the number of its first material
  /// For each set of texture coordinates, of each material by number: 1 if it asks for tangents by that set. Empty: no
  /// material does.
  std::array<std::vector<std::uint8_t>, 2> want_tangents{};
  /// Whether instances replace materials by such ones.
  std::array<bool, 2> instances_want_tangents{};
  /// Of each material by number, 1 if what is of it takes the whole way through a fibre as one: curves are then hit
  /// from outside alone. Empty: none does.
  std::vector<std::uint8_t> fibres{};
};

/// Quads are two triangles: the first with corners 0, 1 and 3, the second with corners 2, 3 and 1. Hits on the second
/// have 1 - u and 1 - v of its own, as in Embree (doc/src/api/RTC_GEOMETRY_TYPE_QUAD.md).
class MeshTable {
 public:
  /// origin: as GeometryTable's.
  MeshTable(const ObjectItem<Mesh>& mesh, const Vec3d& origin, const MeshMaterials& materials, int threads);

  const float* positions() const { return moved_.empty() ? data_->positions.data() : moved_.data(); }
  const std::uint32_t* indices() const { return turned_faces_.empty() ? data_->indices.data() : turned_faces_.data(); }
  /// To where its points lay in its file.
  const AffineRecord<float>& object_from_world() const { return object_from_world_; }
  std::size_t vertex_count() const { return data_->vertex_count(); }
  std::size_t face_count() const { return data_->face_count(); }
  int corners() const { return data_->corners; }
  const Bounds& bounds() const { return bounds_; }
  /// Of a sphere around all vertices, whose center is that of the bounds.
  double bounding_radius() const;

  /// A face's triangle, or its second where `second`.
  RAYTRACE_INLINE Kernel<Triangle>::Record<float> triangle(std::size_t face, bool second = false) const {
    const std::uint32_t* const corner = indices() + static_cast<std::size_t>(corners()) * face;
    if (corners() == 3) return {position(corner[0]), position(corner[1]), position(corner[2])};
    if (!second) return {position(corner[0]), position(corner[1]), position(corner[3])};
    return {position(corner[2]), position(corner[3]), position(corner[1])};
  }

  /// The triangles of the hits. faces: of each lane, for every lane one that exists.
  LaneTriangles triangles(const IntN& faces, const Hits& hits) const;
  Kernel<Triangle>::Record<FloatN> records(const LaneTriangles& triangles) const;

  /// Whether it has normals at vertices.
  bool is_smooth() const { return normals_ != nullptr; }
  /// At those of the lanes: unit length, or 0 0 0 where a vertex has none.
  Vec3<FloatN> normal(const IntN& vertex) const;

  /// By the coordinates at vertices of that set; without a second one by the first, and without any barycentric.
  SurfaceUv<FloatN> uv(const LaneTriangles& triangles, UvSet set) const;

  /// Its u and v alone, as uv() has them, where vertices have such coordinates.
  Vec2<FloatN> coordinates(const LaneTriangles& triangles, UvSet set) const;
  bool has_coordinates(UvSet set) const { return !uvs_of(set).empty(); }

  /// Whether it has tangents at vertices: if it is smooth and has that set, and its materials ask for them.
  bool has_tangents(UvSet set) const { return !tangents_[set == UvSet::first ? 0 : 1].empty(); }
  /// Between those of the lanes' triangles: where u grows and where v does, not across any normal and of any length; 0
  /// where vertices have none.
  struct Tangents {
    Vec3<FloatN> u, v;
  };
  Tangents tangents(const LaneTriangles& triangles, UvSet set) const;

  /// Whether it has colours at vertices, and what they are between those of the lanes' triangles.
  bool has_colors() const { return !data_->colors.empty(); }
  Rgb<FloatN> color(const LaneTriangles& triangles) const;
  /// The same of alphas.
  bool has_alphas() const { return !data_->alphas.empty(); }
  FloatN alpha(const LaneTriangles& triangles) const;

  /// Of all faces; none if they differ.
  std::optional<std::int32_t> only_material() const;
  IntN material(const IntN& faces) const;
  std::int32_t material(std::size_t face) const;
  /// 1 in those that it has.
  void add_used_materials(std::vector<std::uint8_t>& used) const;

 private:
  Vec3f position(std::size_t vertex) const {
    const float* const p = positions() + 3 * vertex;
    return {p[0], p[1], p[2]};
  }
  /// The first, if there is no second.
  const MeshBuffer<float>& uvs_of(UvSet set) const {
    return set == UvSet::second && !data_->uvs2.empty() ? data_->uvs2 : data_->uvs;
  }
  void move(const Affine& affine, int threads);
  void turn_faces(int threads);
  void turn_normals(const Affine& affine, int threads);
  void set_tangents(UvSet set, const Affine& affine, int threads);
  void set_bounds(int threads);

  /// Of one set of texture coordinates.
  struct TangentTable {
    VertexTangents of_faces;

    bool empty() const { return of_faces[0].empty() && of_faces[1].empty(); }
    /// Of the faces that it mirrors, or of the others.
    const float* at(bool mirrored) const {
      const std::size_t wanted = mirrored ? 1 : 0;
      return of_faces[of_faces[wanted].empty() ? 1 - wanted : wanted].data();
    }
  };

  std::shared_ptr<const MeshData> data_;
  MeshBuffer<float> moved_;                 ///< positions, if they are not the data's
  MeshBuffer<std::uint32_t> turned_faces_;  ///< indices, if faces are mirrored
  MeshBuffer<float> computed_normals_;
  const float* normals_ = nullptr;
  std::array<TangentTable, 2> tangents_;  ///< of each UvSet
  std::vector<std::int32_t> materials_;   ///< the numbers of those of the data
  Bounds bounds_ = empty_bounds;
  AffineRecord<float> object_from_world_;
};

}  // namespace raytrace
