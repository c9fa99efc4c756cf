#include "raytrace/import/vertex_normals.h"

#include <bit>

#include "raytrace/import/direction_sums.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

UniqueItems unique_positions(const float* positions, std::size_t count, int threads) {
  const auto bits = [&](std::size_t vertex, std::size_t axis) {
    return std::bit_cast<std::uint32_t>(positions[3 * vertex + axis] + 0.0F);  // -0 is 0
  };
  return unique_items(
      count, threads,
      [&](std::size_t i) { return mixed_bits(mixed_bits(bits(i, 0) | std::uint64_t{bits(i, 1)} << 32U) + bits(i, 2)); },
      [&](std::size_t i, std::size_t j) {
        return bits(i, 0) == bits(j, 0) && bits(i, 1) == bits(j, 1) && bits(i, 2) == bits(j, 2);
      });
}

MeshBuffer<float> vertex_normals(const MeshData& mesh, const float* positions, int threads) {
  const std::size_t vertices = mesh.vertex_count();
  const UniqueItems unique = unique_positions(positions, vertices, threads);

  DirectionSums sums(unique.first.size());
  const auto add_triangle = [&](const std::uint32_t* face, int a, int b, int c) {
    const std::uint32_t corners[] = {face[a], face[b], face[c]};
    Vec3d p[3];
    for (int i = 0; i < 3; ++i) {
      const float* const position = positions + std::size_t{3} * corners[i];
      p[i] = Vec3d(position[0], position[1], position[2]);
    }
    const Vec3d normal = cross(p[1] - p[0], p[2] - p[0]);
    const double size = length(normal);
    if (!(size > 0)) return;
    for (int i = 0; i < 3; ++i) {
      const double weight = angle_between(p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
      sums.add(unique.number[corners[i]], normal * (weight / size));
    }
  };
  for_each_chunk(mesh.face_count(), threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const std::uint32_t* const face = mesh.indices.data() + static_cast<std::size_t>(mesh.corners) * i;
      if (mesh.corners == 3) {
        add_triangle(face, 0, 1, 2);
      } else {
        add_triangle(face, 0, 1, 3);
        add_triangle(face, 2, 3, 1);
      }
    }
  });

  MeshBuffer<float> normals(3 * vertices);
  for_each_chunk(vertices, threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) sums.write(unique.number[i], &normals[3 * i]);
  });
  return normals;
}

}  // namespace raytrace
