// The readers of each format. Inside of read_mesh().
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "raytrace/import/mesh_file.h"
#include "raytrace/import/read_mesh.h"

namespace raytrace {

std::optional<MeshData> read_ply(MeshFile& file, const MeshReadSettings& settings, Diagnostics& diagnostics);
std::optional<PointCloud> read_ply_cloud(MeshFile& file, const MeshReadSettings& settings, Diagnostics& diagnostics);
std::optional<MeshData> read_stl(MeshFile& file, const MeshReadSettings& settings, Diagnostics& diagnostics);

/// folder: of the OBJ file, which MTL files are looked for in.
std::optional<MeshData> read_obj(MeshFile& file, const std::string& folder, const MeshReadSettings& settings,
                                 Diagnostics& diagnostics);

/// Adds the materials of an MTL file. Calls report(line, message) for what is wrong, which is skipped.
void read_mtl(std::string_view text, std::vector<MeshMaterial>& materials,
              const std::function<void(std::uint32_t, const std::string&)>& report);

}  // namespace raytrace
