// Textures of a glTF file's materials. Inside of read_gltf().
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "raytrace/import/gltf_document.h"
#include "raytrace/import/mesh_data.h"

namespace raytrace::gltf {

inline constexpr const char* webp_extension = "EXT_texture_webp";
inline constexpr const char* basisu_extension = "KHR_texture_basisu";  // which is not read

class TextureReader {
 public:
  explicit TextureReader(Document& document) : document_(document) {}

  /// A material's textures have at most two sets of coordinates, which the first of them that are read say.
  void begin_material() { coordinates_.clear(); }
  /// TEXCOORD_n of these numbers.
  const std::vector<std::uint64_t>& coordinates() const { return coordinates_; }

  /// info: a JSON object with the texture's index. What it says of an image that it cannot use, it warns of.
  MeshTexture read(const Item& info);

 private:
  Document& document_;
  std::vector<std::uint64_t> coordinates_;
  std::map<std::uint64_t, std::shared_ptr<const std::string>> images_;  ///< those in buffers and URIs
};

}  // namespace raytrace::gltf
