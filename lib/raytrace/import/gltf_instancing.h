// EXT_mesh_gpu_instancing: a node's mesh at many places. Inside of read_gltf().
#pragma once

#include <vector>

#include "raytrace/import/gltf_document.h"
#include "raytrace/math/affine.h"

namespace raytrace::gltf {

inline constexpr const char* instancing_extension = "EXT_mesh_gpu_instancing";

/// A node's transform. rotation: a quaternion of any length.
Affine affine_of(const std::array<double, 3>& translation, const std::array<double, 4>& rotation,
                 const std::array<double, 3>& scale);

/// Where the instances are in the node's space. instancing: the extension's object.
std::vector<Affine> read_instances(Document& document, const Item& instancing);

}  // namespace raytrace::gltf
