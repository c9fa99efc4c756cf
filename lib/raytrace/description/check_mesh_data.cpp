#include "raytrace/description/check_mesh_data.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

namespace raytrace {

namespace {

constexpr float farthest = 1e18F;  // of positions, as mesh_data.h has it

bool is_finite(const Vec3d& vector) {
  return std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
}

OptionalMessage check_positions(const MeshBuffer<float>& positions, const Vec3d& origin) {
  if (positions.size() % 3 != 0) return "has " + std::to_string(positions.size()) + " positions, no multiple of 3";
  if (!is_finite(origin)) return "has an origin that is not finite";
  bool fine = true;  // no end at the first that is not: so the loop takes several at once
  for (const float position : positions) fine &= std::abs(position) <= farthest;
  if (!fine) return "has a position that is not finite, or beyond 1e18";
  return std::nullopt;
}

/// Of a buffer of so many values for each of `count` things, or none.
OptionalMessage check_size(const char* name, std::size_t size, std::size_t each, std::size_t count,
                           const char* things) {
  if (size == 0 || size == each * count) return std::nullopt;
  return "has " + std::to_string(size) + " " + name + "; " + std::to_string(count) + " " + things + " take " +
         std::to_string(each * count);
}

OptionalMessage check_buffers(const MeshData& mesh, std::size_t materials) {
  if (mesh.corners != 3 && mesh.corners != 4)
    return "has faces of " + std::to_string(mesh.corners) + " corners; they are triangles or quads, of 3 or 4";
  const auto corners = static_cast<std::size_t>(mesh.corners);
  if (mesh.indices.empty()) return "has no faces";
  if (mesh.indices.size() % corners != 0)
    return "has " + std::to_string(mesh.indices.size()) + " indices, no multiple of " + std::to_string(corners);
  if (OptionalMessage message = check_positions(mesh.positions, mesh.origin)) return message;
  std::uint32_t last = 0;
  for (const std::uint32_t index : mesh.indices) last = std::max(last, index);
  const std::size_t vertices = mesh.vertex_count(), faces = mesh.face_count();
  if (last >= vertices)
    return "has a face at vertex " + std::to_string(last) + "; vertices are counted from 0, and there are " +
           std::to_string(vertices);
  for (const auto& [name, size, each] :
       {std::tuple("normals", mesh.normals.size(), std::size_t{3}), std::tuple("uvs", mesh.uvs.size(), std::size_t{2}),
        std::tuple("uvs2", mesh.uvs2.size(), std::size_t{2}), std::tuple("colors", mesh.colors.size(), std::size_t{3}),
        std::tuple("alphas", mesh.alphas.size(), std::size_t{1}),
        std::tuple("tangents", mesh.tangents.size(), std::size_t{4})})
    if (OptionalMessage message = check_size(name, size, each, vertices, "vertices")) return message;
  if (OptionalMessage message = check_size("face_materials", mesh.face_materials.size(), 1, faces, "faces"))
    return message;
  if (materials == 1) return std::nullopt;  // which is that of all faces
  for (const std::uint32_t material : mesh.face_materials)
    if (material >= materials && material != MeshData::no_material)
      return "has a face of material " + std::to_string(material) + "; the mesh has " + std::to_string(materials) +
             ", counted from 0";
  return std::nullopt;
}

OptionalMessage check_parts(const MeshData& mesh) {
  std::size_t last = 0;
  for (const MeshPart& part : mesh.parts) {
    if (&part == mesh.parts.data() && part.first_face != 0) return "has faces before the first of its parts";
    if (part.first_face < last) return "has parts that are not in the order of their faces";
    last = part.first_face;
  }
  if (last > mesh.face_count())
    return "has a part from face " + std::to_string(last) + " on; it has " + std::to_string(mesh.face_count());
  return std::nullopt;
}

}  // namespace

OptionalMessage check_mesh_data(const MeshData& mesh, std::size_t materials) {
  if (OptionalMessage message = check_buffers(mesh, materials)) return message;
  if (OptionalMessage message = check_parts(mesh)) return message;
  for (const MeshCopies& copies : mesh.copies) {
    if (copies.mesh == nullptr) return "has copies of no mesh";
    if (!copies.mesh->copies.empty() || !copies.mesh->parts.empty())
      return "has copies of a mesh that has parts or copies itself";
    if (const OptionalMessage message = check_buffers(*copies.mesh, materials))
      return "has copies of a mesh that " + *message;
    for (const MeshCopies::Place& place : copies.places) {
      const Affine& affine = place.affine;
      if (!is_finite(affine.x) || !is_finite(affine.y) || !is_finite(affine.z) || !is_finite(affine.origin))
        return "has a copy at a place that is not finite";
      if (place.part > 0 && place.part >= mesh.parts.size())
        return "has a copy of part " + std::to_string(place.part) + "; it has " + std::to_string(mesh.parts.size());
    }
  }
  return std::nullopt;
}

OptionalMessage check_point_cloud(const PointCloud& cloud) {
  if (OptionalMessage message = check_positions(cloud.positions, cloud.origin)) return message;
  if (OptionalMessage message = check_size("radii", cloud.radii.size(), 1, cloud.size(), "points")) return message;
  if (OptionalMessage message = check_size("colors", cloud.colors.size(), 3, cloud.size(), "points")) return message;
  for (const float radius : cloud.radii)
    if (const OptionalMessage message = check_value(static_cast<double>(radius), Range::positive))
      return "has a radius that " + *message;
  return std::nullopt;
}

OptionalMessage check_curve_data(const CurveData& curves) {
  const std::size_t points = curves.size();
  if (points == 0) return "has no points";
  if (curves.points.size() != 4 * points)
    return "has " + std::to_string(curves.points.size()) + " numbers of points; " + std::to_string(points) +
           " points take " + std::to_string(4 * points);
  if (!is_finite(curves.origin)) return "has an origin that is not finite";
  if (OptionalMessage message = check_size("colors", curves.colors.size(), 3, points, "points")) return message;
  constexpr float farthest = 5e17F;  // what reaches beyond 5e17, Embree leaves out
  bool fine = true, is_radius = true, grows = true;
  for (std::size_t i = 0; i < points; ++i) {
    const float* const p = &curves.points[4 * i];
    fine &= std::abs(p[0]) <= farthest && std::abs(p[1]) <= farthest && std::abs(p[2]) <= farthest;
    is_radius &= p[3] >= 0 && p[3] <= farthest;
    const float here = curves.along[i], before = i == 0 ? 1 : curves.along[i - 1];
    const bool goes_on = here > 0 && here <= 1 && here >= before && i > 0;
    const bool begins = here == 0 && before == 1 && i + 1 < points && curves.along[i + 1] > 0;
    grows &= goes_on || begins;
    if (goes_on) fine &= p[-4] != p[0] || p[-3] != p[1] || p[-2] != p[2];
  }
  if (!fine) return "has a point that is not finite, beyond 5e17, or where the one before is";
  if (!is_radius) return "has a radius that is less than 0 or beyond 5e17";
  if (!grows || curves.along[points - 1] != 1) return "has strands that do not go from 0 to 1";
  return std::nullopt;
}

}  // namespace raytrace
