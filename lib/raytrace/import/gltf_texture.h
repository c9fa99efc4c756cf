// Textures of a glTF file's materials. Inside of read_gltf().
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "raytrace/import/gltf_document.h"
#include "raytrace/import/mesh_data.h"

namespace raytrace::gltf {

class TextureReader {
 public:
  explicit TextureReader(Document& document) : document_(document) {}

  /// info: a JSON object with the texture's index. What it says of an image that it cannot use, it warns of.
  MeshTexture read(const Item& info);

 private:
  Document& document_;
  std::map<std::uint64_t, std::shared_ptr<const std::string>> images_;  ///< those in buffers and URIs
};

}  // namespace raytrace::gltf
