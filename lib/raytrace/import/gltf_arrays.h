// What the meshes of a glTF file's model have at their vertices, and how much that is. Inside of read_gltf().
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "raytrace/import/gltf_model.h"
#include "raytrace/import/mesh_faces.h"

namespace raytrace::gltf {

/// Which arrays the meshes of a model have: all of them the same.
struct Arrays {
  bool all_alphas = false;  ///< MeshReadSettings::vertex_alphas
  bool normals = false, tangents = false, uvs = false, uvs2 = false, colors = false, alphas = false, materials = false;

  void add(const Instance& instance) {
    for (const Primitive& primitive : *instance.mesh) {
      normals = normals || primitive.normals;
      tangents = tangents || (primitive.tangents && !is_deformed(primitive, instance));
      uvs = uvs || primitive.uvs;
      uvs2 = uvs2 || primitive.uvs2;
      colors = colors || primitive.colors;
      alphas = alphas || (primitive.has_alpha() && (all_alphas || primitive.shows_alpha));
      materials = materials || primitive.material != 0;
    }
  }
};

/// What a mesh is made of.
struct Size {
  std::size_t vertices = 0;
  FaceCounts faces;
  std::size_t deformed_at_once = 0;

  void add(const Instance& instance) {
    for (const Primitive& primitive : *instance.mesh) {
      if (primitive.vertices_of == static_cast<std::size_t>(&primitive - instance.mesh->data()))
        vertices += primitive.positions.elements.count;
      if (is_deformed(primitive, instance))
        deformed_at_once = std::max(deformed_at_once, primitive.positions.elements.count);
      faces.triangles += primitive.faces();
    }
  }
  std::size_t bytes(const Arrays& arrays) const {
    constexpr std::size_t bytes_of_face = 4 * sizeof(std::uint32_t);
    const std::size_t bytes_of_vertex =
        (11 + (arrays.uvs2 ? 2 : 0) + (arrays.tangents ? 4 : 0) + (arrays.alphas ? 1 : 0)) * sizeof(float);
    return vertices * bytes_of_vertex + faces.triangles * bytes_of_face + deformed_at_once * bytes_of_deformed_vertex;
  }
};

}  // namespace raytrace::gltf
