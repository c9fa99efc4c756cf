#include "raytrace/import/vertex_tangents.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <vector>

#include "raytrace/import/direction_sums.h"
#include "raytrace/import/unique_items.h"
#include "raytrace/math/vec2.h"

namespace raytrace {

namespace {

Vec3d vector_at(const float* values, std::size_t i) { return {values[3 * i], values[3 * i + 1], values[3 * i + 2]}; }

/// Of unit length, or 0 0 0.
Vec3d direction_of(const Vec3d& v) {
  const double size = length(v);
  return size > 0 ? v * (1 / size) : Vec3d(0, 0, 0);
}

Vec3d across(const Vec3d& normal, const Vec3d& v) { return v - normal * dot(normal, v); }

/// One triangle of a face: its vertices, and how its point moves with u.
struct TangentTriangle {
  std::array<std::uint32_t, 3> vertices;
  std::array<Vec3d, 3> p;
  Vec3d dpdu;        ///< its length means nothing; 0 0 0 where the coordinates are those of one point or a line
  bool is_mirrored;  ///< by its texture
};

TangentTriangle triangle_of(const TangentSource& source, const std::array<std::uint32_t, 3>& vertices) {
  TangentTriangle result{vertices, {}, {0, 0, 0}, false};
  std::array<Vec2<double>, 3> uv;
  for (std::size_t i = 0; i < 3; ++i) {
    result.p[i] = vector_at(source.positions, vertices[i]);
    const float* const of_vertex = source.uvs + std::size_t{2} * vertices[i];
    uv[i] = {of_vertex[0], of_vertex[1]};
  }
  const double du2 = uv[1].x - uv[0].x, dv2 = uv[1].y - uv[0].y, du3 = uv[2].x - uv[0].x, dv3 = uv[2].y - uv[0].y;
  const double determinant = du2 * dv3 - du3 * dv2;
  if (determinant == 0 || !std::isfinite(determinant)) return result;
  result.is_mirrored = determinant < 0;
  const Vec3d dpdu = (result.p[1] - result.p[0]) * dv3 - (result.p[2] - result.p[0]) * dv2;
  result.dpdu = result.is_mirrored ? -dpdu : dpdu;
  return result;
}

/// f(triangle) of each triangle that the faces [first, last) have.
template <class Function>
void for_each_triangle(const TangentSource& source, std::size_t first, std::size_t last, const Function& f) {
  const auto corners = static_cast<std::size_t>(source.mesh.corners);
  for (std::size_t i = first; i < last; ++i) {
    const std::uint32_t* const face = source.indices + corners * i;
    if (corners == 3) {
      f(triangle_of(source, {face[0], face[1], face[2]}));
    } else {
      f(triangle_of(source, {face[0], face[1], face[3]}));
      f(triangle_of(source, {face[2], face[3], face[1]}));
    }
  }
}

/// Vertices that tangents are the same of.
UniqueItems unique_vertices(const TangentSource& source, int threads) {
  const auto bits = [&](std::size_t vertex, std::size_t i) {
    const float* const value = i < 3   ? source.positions + 3 * vertex + i
                               : i < 6 ? source.normals + 3 * vertex + i - 3
                                       : source.uvs + 2 * vertex + i - 6;
    return std::bit_cast<std::uint32_t>(*value + 0.0F);  // -0 is 0
  };
  constexpr std::size_t numbers = 8;
  return unique_items(
      source.mesh.vertex_count(), threads,
      [&](std::size_t i) {
        std::uint64_t hash = 0;
        for (std::size_t k = 0; k < numbers; k += 2)
          hash = mixed_bits(hash + (bits(i, k) | std::uint64_t{bits(i, k + 1)} << 32U));
        return hash;
      },
      [&](std::size_t i, std::size_t j) {
        for (std::size_t k = 0; k < numbers; ++k)
          if (bits(i, k) != bits(j, k)) return false;
        return true;
      });
}

}  // namespace

VertexTangents vertex_tangents(const TangentSource& source, int threads) {
  const std::size_t vertices = source.mesh.vertex_count(), faces = source.mesh.face_count();
  std::array<std::vector<char>, 2> has{std::vector<char>(chunk_count(faces)), std::vector<char>(chunk_count(faces))};
  for_each_chunk(faces, threads, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    for_each_triangle(source, first, last, [&](const TangentTriangle& triangle) {
      if (length(triangle.dpdu) > 0) has[triangle.is_mirrored ? 1 : 0][chunk] = 1;
    });
  });
  VertexTangents result;
  const UniqueItems unique = unique_vertices(source, threads);
  for (std::size_t mirrored = 0; mirrored < 2; ++mirrored) {
    if (std::find(has[mirrored].begin(), has[mirrored].end(), 1) == has[mirrored].end()) continue;
    DirectionSums sums(unique.first.size());
    for_each_chunk(faces, threads, [&](std::size_t, std::size_t first, std::size_t last) {
      for_each_triangle(source, first, last, [&](const TangentTriangle& triangle) {
        if (triangle.is_mirrored != (mirrored == 1)) return;
        for (std::size_t i = 0; i < 3; ++i) {
          const Vec3d normal = direction_of(vector_at(source.normals, triangle.vertices[i]));
          const Vec3d& p = triangle.p[i];
          const double angle =
              angle_between(across(normal, triangle.p[(i + 1) % 3] - p), across(normal, triangle.p[(i + 2) % 3] - p));
          sums.add(unique.number[triangle.vertices[i]], direction_of(across(normal, triangle.dpdu)) * angle);
        }
      });
    });
    MeshBuffer<float>& tangents = result[mirrored] = MeshBuffer<float>(4 * vertices);
    for_each_chunk(vertices, threads, [&](std::size_t, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        float* const tangent = &tangents[4 * i];
        sums.write(unique.number[i], tangent);
        const bool is_there = tangent[0] != 0 || tangent[1] != 0 || tangent[2] != 0;
        tangent[3] = !is_there ? 0.0F : mirrored == 1 ? -1.0F : 1.0F;
      }
    });
  }
  return result;
}

}  // namespace raytrace
