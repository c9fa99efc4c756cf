// Materials of a glTF file as OpenPBR's. Inside of read_gltf().
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "raytrace/import/gltf_json.h"
#include "raytrace/import/mesh_data.h"

namespace raytrace::gltf {

/// What primitives have several materials by.
inline constexpr const char* variants_extension = "KHR_materials_variants";
inline constexpr const char* visibility_extension = "KHR_node_visibility";

/// Whether read_material() reads it.
bool is_material_extension(std::string_view name);

/// What a material's textures are, and what is said of them.
struct MaterialContext {
  std::function<MeshTexture(const Item&)> texture;  ///< that of a JSON object with its index
  std::function<void(const std::string& place, const std::string& what)> warn;
  /// By Assimp: what it calls a specular colour is that of Phong's highlights, and not what a mirror has.
  bool is_converted = false;
};

MeshMaterial read_material(const Item& material, const MaterialContext& context);

/// What an object has of an extension.
std::optional<Item> extension(const Item& object, const char* name);

/// Sets scale, rotation and offset from KHR_texture_transform, whose v grows downwards.
void place_texture(const Item& transform, MeshTexture& texture);

}  // namespace raytrace::gltf
