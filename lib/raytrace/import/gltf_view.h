// Cameras and lights of a glTF file. Inside of read_gltf().
#pragma once

#include <string_view>

#include "raytrace/import/gltf_json.h"
#include "raytrace/import/mesh_data.h"
#include "raytrace/math/affine.h"

namespace raytrace::gltf {

inline constexpr const char* lights_extension = "KHR_lights_punctual";

/// transform: of the node that has it, into the scene.
FileCamera read_camera(const Item& camera, const Affine& transform);
FileLight read_light(const Item& light, const Affine& transform);

}  // namespace raytrace::gltf
