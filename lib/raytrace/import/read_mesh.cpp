#include "raytrace/import/read_mesh.h"

#include <algorithm>
#include <filesystem>

#include "raytrace/import/mesh_file.h"
#include "raytrace/import/mesh_readers.h"

namespace raytrace {
namespace {

/// ".ply" of "a/b.PLY.gz".
std::string mesh_type(const std::string& file) {
  std::filesystem::path path(file);
  if (path.extension() == ".gz") path = path.stem();
  std::string type = path.extension().string();
  std::transform(type.begin(), type.end(), type.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return type;
}

}  // namespace

bool is_mesh_file(const std::string& file) {
  const std::string type = mesh_type(file);
  return type == ".ply" || type == ".obj" || type == ".stl";
}

std::optional<MeshData> read_mesh(const std::string& name, const MeshReadSettings& settings, Diagnostics& diagnostics) {
  if (!is_mesh_file(name)) {
    diagnostics.error({}, "is no mesh by its name, which ends in none of .ply, .obj and .stl, perhaps with .gz behind");
    return std::nullopt;
  }
  std::optional<MeshFile> file = MeshFile::open(name, diagnostics);
  if (!file) return std::nullopt;
  const std::string type = mesh_type(name);
  if (type == ".ply") return read_ply(*file, settings, diagnostics);
  if (type == ".stl") return read_stl(*file, settings, diagnostics);
  return read_obj(*file, std::filesystem::path(name).parent_path().string(), settings, diagnostics);
}

std::optional<PointCloud> read_point_cloud(const std::string& name, const MeshReadSettings& settings,
                                           Diagnostics& diagnostics) {
  std::optional<MeshFile> file = MeshFile::open(name, diagnostics);
  if (!file) return std::nullopt;
  return read_ply_cloud(*file, settings, diagnostics);
}

}  // namespace raytrace
