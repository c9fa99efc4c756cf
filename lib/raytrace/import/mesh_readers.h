// The readers of each format. Inside of read_mesh().
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "raytrace/import/mesh_file.h"
#include "raytrace/import/read_mesh.h"

namespace raytrace {

/// folder: of the PLY file, which its texture is looked for in.
std::optional<MeshData> read_ply(MeshFile& file, const std::string& folder, const MeshReadSettings& settings,
                                 Diagnostics& diagnostics);
std::optional<PointCloud> read_ply_cloud(MeshFile& file, const MeshReadSettings& settings, Diagnostics& diagnostics);
std::optional<MeshData> read_stl(MeshFile& file, const MeshReadSettings& settings, Diagnostics& diagnostics);

/// folder: of the OBJ file, which MTL files are looked for in.
std::optional<MeshData> read_obj(MeshFile& file, const std::string& folder, const MeshReadSettings& settings,
                                 Diagnostics& diagnostics);

/// name: the file's, beside which its buffers are.
std::optional<MeshData> read_gltf(MeshFile& file, const std::string& name, const MeshReadSettings& settings,
                                  Diagnostics& diagnostics);

/// Adds the materials of the MTL files that a statement names, in the line of an OBJ file in the folder: one file whose
/// name may have spaces, or several, and their names to files. What is wrong with them are warnings of that line, but
/// for materials that are overridden.
void read_material_libraries(std::string_view names, const std::string& folder, std::uint32_t line,
                             std::vector<MeshMaterial>& materials, std::vector<std::string>& files,
                             const MeshReadSettings& settings, Diagnostics& diagnostics);

}  // namespace raytrace
