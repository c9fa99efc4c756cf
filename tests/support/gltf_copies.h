// glTF files with one mesh at very many places.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "support/gltf.h"

namespace raytrace::test {

/// A strip of 64 triangles, 32 wide and 1 high, as a mesh or as several with the same accessors, each of them with its
/// share of the places: the fewer places each has, the less it pays to share it.
struct GltfCopies {
  static constexpr std::size_t enough = 8192;  ///< places of one mesh, to be shared

  std::vector<float> translations, rotations, scales;  ///< x y z, x y z w and x y z of each place
  std::string material;                                ///< members of it

  void add(float x, float y, float z, float scale_x = 1, float scale_y = 1, float scale_z = 1, float turn_z = 0,
           float turn_w = 1) {
    translations.insert(translations.end(), {x, y, z});
    rotations.insert(rotations.end(), {0, 0, turn_z, turn_w});
    scales.insert(scales.end(), {scale_x, scale_y, scale_z});
  }
  std::size_t places() const { return translations.size() / 3; }

  /// meshes: how many there are, each of a node. nodes: more_nodes further ones, each with ',' before.
  std::string text(std::size_t meshes = 1, const std::string& nodes = "", std::size_t more_nodes = 0) const {
    GltfFile file;
    std::vector<float> positions, normals, colors;
    for (int i = 0; i < 66; ++i) {
      const auto x = static_cast<float>(i / 2), y = static_cast<float>(i % 2);
      positions.insert(positions.end(), {x, y, 0});
      normals.insert(normals.end(), {0.0599F, 0, 0.9982F});
      colors.insert(colors.end(), {x / 33, y, 0.5F});
    }
    file.add(positions, "VEC3", 5126, 66).add(normals, "VEC3", 5126, 66).add(colors, "VEC3", 5126, 66);
    std::string roots, all_nodes, all_meshes;
    for (std::size_t i = 0; i < meshes; ++i) {
      const std::size_t first = places() * i / meshes, last = places() * (i + 1) / meshes;
      const auto part = [&](const std::vector<float>& values, std::size_t numbers) {
        const auto begin = values.begin() + static_cast<std::ptrdiff_t>(numbers * first);
        return std::vector<float>(begin, values.begin() + static_cast<std::ptrdiff_t>(numbers * last));
      };
      file.add(part(translations, 3), "VEC3", 5126, last - first);
      file.add(part(rotations, 4), "VEC4", 5126, last - first);
      file.add(part(scales, 3), "VEC3", 5126, last - first);
      const std::string comma = i == 0 ? "" : ",";
      const auto accessor = [&](std::size_t k) { return std::to_string(3 * i + 3 + k); };
      all_nodes += comma + R"({"name":"strips","mesh":)" + std::to_string(i) +
                   R"(,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":)" + accessor(0) +
                   R"(,"ROTATION":)" + accessor(1) + R"(,"SCALE":)" + accessor(2) + "}}}}";
      all_meshes += comma + R"({"primitives":[{"mode":5,"material":0,"attributes":)" +
                    R"({"POSITION":0,"NORMAL":1,"COLOR_0":2}}]})";
    }
    for (std::size_t i = 0; i < meshes + more_nodes; ++i) roots += (i == 0 ? "" : ",") + std::to_string(i);
    return file.text(R"("scenes":[{"nodes":[)" + roots + R"(]}],"nodes":[)" + all_nodes + nodes + R"(],"meshes":[)" +
                     all_meshes + R"(],"materials":[{)" + material + "}]");
  }
};

}  // namespace raytrace::test
