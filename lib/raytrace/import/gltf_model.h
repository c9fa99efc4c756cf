// What a glTF file says of its default scene, before a mesh is made of it. Inside of read_gltf().
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "raytrace/import/gltf_accessor.h"
#include "raytrace/import/mesh_data.h"
#include "raytrace/import/mesh_file.h"
#include "raytrace/math/affine.h"
#include "raytrace/xml/diagnostics.h"

namespace raytrace::gltf {

/// How corners make triangles, as the format numbers it.
enum class Mode { triangles = 4, strip, fan };

struct Primitive {
  Accessor positions;
  std::optional<Accessor> normals, uvs, colors, indices;
  Mode mode = Mode::triangles;
  std::uint32_t material = MeshData::no_material;  ///< its number in the model
  std::size_t vertices_of = 0;                     ///< the first primitive of the mesh that has the same vertices

  std::size_t corners() const { return indices ? indices->elements.count : positions.elements.count; }
  std::size_t faces() const {
    if (mode == Mode::triangles) return corners() / 3;
    return corners() < 3 ? 0 : corners() - 2;
  }
};

struct Instance {
  const std::vector<Primitive>* mesh;
  Affine transform;
};

struct Model {
  std::vector<Instance> instances;  ///< in the order of the nodes
  std::map<std::uint64_t, std::vector<Primitive>> meshes;
  std::vector<MeshMaterial> materials;  ///< those that are used
  std::vector<FileCamera> cameras;
  std::vector<FileLight> lights;
  std::size_t other_primitives = 0;  ///< those of points and lines, which are left out

  // What accessors point into.
  std::map<std::string, MeshFile> files;
  std::map<std::uint64_t, std::string> data;  ///< of the buffers that the file has as URIs
};

/// file: all of it. name: its file's, beside which others are. Warnings go to `diagnostics`. Throws Error.
Model read_model(std::string_view file, const std::string& name, int threads, Diagnostics& diagnostics);

}  // namespace raytrace::gltf
