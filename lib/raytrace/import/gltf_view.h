// Cameras and lights of a glTF file. Inside of read_gltf().
#pragma once

#include <optional>

#include "raytrace/import/gltf_document.h"
#include "raytrace/import/mesh_data.h"
#include "raytrace/math/affine.h"

namespace raytrace::gltf {

inline constexpr const char* lights_extension = "KHR_lights_punctual";

/// transform: of the node that has it, into the scene.
FileCamera read_camera(const Item& camera, const Affine& transform);
/// None, and a warning of the document's, for what sends no light anywhere, which is no reason to refuse a file.
std::optional<FileLight> read_light(const Item& light, const Affine& transform, Document& document);

}  // namespace raytrace::gltf
