#include "raytrace/scene/mesh_table.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "raytrace/import/vertex_normals.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

namespace {

IntN indices_at(const std::uint32_t* indices, const IntN& places) {
  return gather(reinterpret_cast<const std::int32_t*>(indices), places);
}

IntN select_vertex(const MaskN& mask, const IntN& a, const IntN& b) { return select_lanes(mask, a, b); }

Vec3<FloatN> vectors_at(const float* values, const IntN& vertex) {
  const IntN first = vertex * IntN(3);
  return {gather(values, first), gather(values + 1, first), gather(values + 2, first)};
}

/// The coordinates of a triangle's first vertex, and what they are more at the second and the third.
struct UvEdges {
  FloatN u1, v1, du2, dv2, du3, dv3;

  FloatN determinant() const { return du2 * dv3 - du3 * dv2; }
};

UvEdges uv_edges(const float* uvs, const LaneTriangles& triangles) {
  const auto uv_at = [&](const IntN& vertex) {
    const IntN first = vertex * IntN(2);
    return std::pair(gather(uvs, first), gather(uvs + 1, first));
  };
  const auto [u1, v1] = uv_at(triangles.vertex1);
  const auto [u2, v2] = uv_at(triangles.vertex2);
  const auto [u3, v3] = uv_at(triangles.vertex3);
  return {u1, v1, u2 - u1, v2 - v1, u3 - u1, v3 - v1};
}

}  // namespace

MeshTable::MeshTable(const ObjectItem<Mesh>& mesh, const Vec3d& origin, const MeshMaterials& materials, int threads)
    : data_(mesh.data) {
  for (const MaterialReference& material : mesh.materials)
    materials_.push_back(materials.first[material.type] + static_cast<std::int32_t>(material.index));

  Affine affine = mesh.transform.affine();
  Affine to_world = affine;
  to_world.origin += -origin;
  object_from_world_ = to_float(to_world.inverse());
  affine.origin = affine.point(data_->origin) + -origin;
  const bool is_transformed = !mesh.transform.empty();
  if (is_transformed || length(affine.origin) > 0) move(affine, threads);
  if (is_transformed && affine.determinant() < 0) turn_faces(threads);
  if (mesh.parameters.normals.groups.empty() && mesh.parameters.normals.word == Mesh::smooth) {
    computed_normals_ = vertex_normals(*data_, positions(), threads);
    normals_ = computed_normals_.data();
  } else if (!data_->normals.empty() &&
             (!mesh.parameters.normals.groups.empty() || mesh.parameters.normals.word == Mesh::of_file)) {
    normals_ = data_->normals.data();
    if (is_transformed) turn_normals(affine, threads);
  }
  for (const UvSet set : {UvSet::first, UvSet::second}) {
    const auto number = static_cast<std::size_t>(set);
    const std::vector<std::uint8_t>& want = materials.want_tangents[number];
    const auto wants = [&](std::int32_t material) { return want[static_cast<std::size_t>(material)] != 0; };
    if (materials.instances_want_tangents[number] ||
        (!want.empty() && std::any_of(materials_.begin(), materials_.end(), wants)))
      set_tangents(set, affine, threads);
  }
  set_bounds(threads);
}

void MeshTable::move(const Affine& affine, int threads) {
  moved_ = MeshBuffer<float>(data_->positions.size());
  for_each_chunk(vertex_count(), threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = 3 * first; i < 3 * last; i += 3) {
      const float* const p = data_->positions.data() + i;
      const Vec3d moved = affine.point({p[0], p[1], p[2]});
      for (int axis = 0; axis < 3; ++axis) {
        // As far as Embree takes them.
        const double most = 1e18, coordinate = std::clamp(component(moved, axis), -most, most);
        moved_[i + static_cast<std::size_t>(axis)] = static_cast<float>(coordinate);
      }
    }
  });
}

/// Mirrored faces keep their fronts: the corners go round the other way, from the same one.
void MeshTable::turn_faces(int threads) {
  turned_faces_ = MeshBuffer<std::uint32_t>(data_->indices.size());
  const auto count = static_cast<std::size_t>(corners());
  for_each_chunk(face_count(), threads, [&](std::size_t, std::size_t first, std::size_t last) {
    std::copy(&data_->indices[count * first], &data_->indices[0] + count * last, &turned_faces_[count * first]);
    for (std::size_t face = first; face < last; ++face)
      std::swap(turned_faces_[count * face + 1], turned_faces_[count * face + count - 1]);
  });
}

void MeshTable::turn_normals(const Affine& affine, int threads) {
  computed_normals_ = MeshBuffer<float>(data_->normals.size());
  for_each_chunk(vertex_count(), threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = 3 * first; i < 3 * last; i += 3) {
      const float* const n = data_->normals.data() + i;
      const Vec3d turned = affine.normal({n[0], n[1], n[2]});
      const double size = length(turned);
      for (int axis = 0; axis < 3; ++axis)
        computed_normals_[i + static_cast<std::size_t>(axis)] =
            size > 0 ? static_cast<float>(component(turned, axis) / size) : 0.0F;
    }
  });
  normals_ = computed_normals_.data();
}

void MeshTable::set_tangents(UvSet set, const Affine& affine, int threads) {
  const MeshBuffer<float>& uvs = uvs_of(set);
  if (!is_smooth() || uvs.empty()) return;
  VertexTangents& tangents = tangents_[static_cast<std::size_t>(set)].of_faces;
  tangents = vertex_tangents({*data_, positions(), indices(), normals_, uvs.data()}, threads);
  if (data_->tangents.empty()) return;
  const float mirror = affine.determinant() < 0 ? -1.0F : 1.0F;
  for (MeshBuffer<float>& of_faces : tangents) {
    if (of_faces.empty()) continue;
    for_each_chunk(vertex_count(), threads, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = 4 * first; i < 4 * last; i += 4) {
        const float* const t = data_->tangents.data() + i;
        if (t[3] == 0) continue;
        const Vec3d turned = affine.vector({t[0], t[1], t[2]});
        const double size = length(turned);
        for (int axis = 0; axis < 3; ++axis)
          of_faces[i + static_cast<std::size_t>(axis)] = static_cast<float>(component(turned, axis) / size);
        of_faces[i + 3] = t[3] * mirror;
      }
    });
  }
}

void MeshTable::set_bounds(int threads) {
  std::vector<Bounds> chunks(chunk_count(vertex_count()), empty_bounds);
  for_each_chunk(vertex_count(), threads, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    Bounds& bounds = chunks[chunk];
    for (std::size_t i = first; i < last; ++i) bounds = join(bounds, {position(i), position(i)});
  });
  for (const Bounds& chunk : chunks) bounds_ = join(bounds_, chunk);
}

double MeshTable::bounding_radius() const {
  const BoundingSphere sphere = sphere_around(bounds_);
  double square = 0;
  for (std::size_t i = 0; i < vertex_count(); ++i) {
    const Vec3d way = Vec3d(position(i)) - sphere.center;
    square = std::max(square, dot(way, way));
  }
  return std::min(std::sqrt(square), sphere.radius);
}

LaneTriangles MeshTable::triangles(const IntN& faces, const Hits& hits) const {
  const IntN first = faces * IntN(corners());
  const auto corner = [&](int number) { return indices_at(indices() + number, first); };
  if (corners() == 3) return {corner(0), corner(1), corner(2), hits.u, hits.v};
  const MaskN second = hits.u + hits.v > FloatN(1);
  const IntN corner1 = corner(1), corner3 = corner(3);
  return {select_vertex(second, corner(2), corner(0)), select_vertex(second, corner3, corner1),
          select_vertex(second, corner1, corner3), select(second, FloatN(1) - hits.u, hits.u),
          select(second, FloatN(1) - hits.v, hits.v)};
}

Kernel<Triangle>::Record<FloatN> MeshTable::records(const LaneTriangles& triangles) const {
  return {vectors_at(positions(), triangles.vertex1), vectors_at(positions(), triangles.vertex2),
          vectors_at(positions(), triangles.vertex3)};
}

Vec3<FloatN> MeshTable::normal(const IntN& vertex) const {
  const Vec3<FloatN> normal = vectors_at(normals_, vertex);
  const FloatN scale = inverse_power_of_2(largest_component(normal));  // floats do not hold the squares of all
  const Vec3<FloatN> scaled = normal * scale;
  const FloatN squared_length = dot(scaled, scaled);
  return select(squared_length > FloatN(0), scaled * (FloatN(1) / sqrt(squared_length)), Vec3<FloatN>(Vec3f(0, 0, 0)));
}

Vec2<FloatN> MeshTable::coordinates(const LaneTriangles& triangles, UvSet set) const {
  const auto [u1, v1, du2, dv2, du3, dv3] = uv_edges(uvs_of(set).data(), triangles);
  return {u1 + du2 * triangles.u + du3 * triangles.v, v1 + dv2 * triangles.u + dv3 * triangles.v};
}

SurfaceUv<FloatN> MeshTable::uv(const LaneTriangles& triangles, UvSet set) const {
  const auto corners = records(triangles);
  const SurfaceUv<FloatN> barycentric = Kernel<Triangle>::uv(corners, triangles.u, triangles.v);
  const MeshBuffer<float>& uvs = uvs_of(set);
  if (uvs.empty()) {
    if (turned_faces_.empty()) return barycentric;
    return {barycentric.v, barycentric.u, barycentric.dpdv, barycentric.dpdu};
  }
  const UvEdges edges = uv_edges(uvs.data(), triangles);
  const auto& [u1, v1, du2, dv2, du3, dv3] = edges;
  const FloatN determinant = edges.determinant();
  // Where the coordinates are those of one point or a line, they say nothing of directions.
  const MaskN fine = abs(determinant) > FloatN(0);
  const FloatN scale = FloatN(1) / determinant;
  const Vec3<FloatN>&edge2 = barycentric.dpdu, &edge3 = barycentric.dpdv;
  return {u1 + du2 * triangles.u + du3 * triangles.v, v1 + dv2 * triangles.u + dv3 * triangles.v,
          select(fine, (edge2 * dv3 - edge3 * dv2) * scale, edge2),
          select(fine, (edge3 * du2 - edge2 * du3) * scale, edge3)};
}

MeshTable::Tangents MeshTable::tangents(const LaneTriangles& triangles, UvSet set) const {
  const MaskN mirrored = uv_edges(uvs_of(set).data(), triangles).determinant() < FloatN(0);
  const TangentTable& table = tangents_[static_cast<std::size_t>(set)];
  const auto at = [&](int number, const IntN& first) {
    return select(mirrored, gather(table.at(true) + number, first), gather(table.at(false) + number, first));
  };
  Tangents result{Vec3<FloatN>(Vec3f(0, 0, 0)), {}};
  FloatN sign(0);
  const auto add = [&](const IntN& vertex, const FloatN& weight) {
    const IntN first = vertex * IntN(4);
    result.u = result.u + Vec3<FloatN>(at(0, first), at(1, first), at(2, first)) * weight;
    sign = sign + at(3, first);
  };
  add(triangles.vertex1, FloatN(1) - triangles.u - triangles.v);
  add(triangles.vertex2, triangles.u);
  add(triangles.vertex3, triangles.v);
  const auto corners = records(triangles);
  const Vec3<FloatN> normal = cross(corners.vertex2 - corners.vertex1, corners.vertex3 - corners.vertex1);
  const Vec3<FloatN> across = cross(normal, result.u);
  result.v = select(sign < FloatN(0), -across, across);
  return result;
}

Rgb<FloatN> MeshTable::color(const LaneTriangles& triangles) const {
  const Vec3<FloatN> mean =
      vectors_at(data_->colors.data(), triangles.vertex1) * (FloatN(1) - triangles.u - triangles.v) +
      vectors_at(data_->colors.data(), triangles.vertex2) * triangles.u +
      vectors_at(data_->colors.data(), triangles.vertex3) * triangles.v;
  return {mean.x, mean.y, mean.z};
}

FloatN MeshTable::alpha(const LaneTriangles& triangles) const {
  const float* const alphas = data_->alphas.data();
  return gather(alphas, triangles.vertex1) * (FloatN(1) - triangles.u - triangles.v) +
         gather(alphas, triangles.vertex2) * triangles.u + gather(alphas, triangles.vertex3) * triangles.v;
}

std::optional<std::int32_t> MeshTable::only_material() const {
  if (data_->face_materials.empty() || materials_.size() == 1) return materials_.front();
  return std::nullopt;
}

std::int32_t MeshTable::material(std::size_t face) const {
  if (const auto material = only_material()) return *material;
  return materials_[std::min<std::size_t>(data_->face_materials[face], materials_.size() - 1)];
}

IntN MeshTable::material(const IntN& faces) const {
  if (const auto material = only_material()) return IntN(*material);
  // Faces without one have the last, as material() of a single face has it: compared without sign.
  const UintN number = same_bits<UintN>(indices_at(data_->face_materials.data(), faces));
  const UintN last(static_cast<std::uint32_t>(materials_.size() - 1));
  return gather(materials_.data(), same_bits<IntN>(select_lanes(float_mask<FloatN>(number < last), number, last)));
}

void MeshTable::add_used_materials(std::vector<std::uint8_t>& used) const {
  for (const std::int32_t material : materials_) used[static_cast<std::size_t>(material)] = 1;
}

}  // namespace raytrace
