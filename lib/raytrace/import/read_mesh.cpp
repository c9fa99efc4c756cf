#include "raytrace/import/read_mesh.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include "raytrace/import/converted_model.h"
#include "raytrace/import/mesh_faces.h"
#include "raytrace/import/mesh_file.h"
#include "raytrace/import/mesh_readers.h"
#include "raytrace/math/float_origin.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

template <class T>
Vec3d origin_of(std::span<const T> positions) {
  const auto at = [&](std::size_t i) { return Vec3d(Vec3<T>(positions[i], positions[i + 1], positions[i + 2])); };
  const Vec3d first = at(0);
  const double distance = length(first);
  double size = 0;
  // Of most meshes, a few of the vertices show that they are large enough.
  for (std::size_t i = 3; i < positions.size() && (size == 0 || is_coarse(distance, size)); i += 3)
    size = std::max(size, length(at(i) - first));
  if (size > 0 && is_coarse(distance, size)) return rounded_origin(first, size);
  const bool is_far = std::max({std::abs(first.x), std::abs(first.y), std::abs(first.z)}) > near_the_origin;
  return is_far ? rounded_origin(first, 1) : Vec3d(0, 0, 0);
}

/// MTL files of MeshLab say Tr 1, and Collada files of many programs transparency 0, of what is opaque. Nobody sees
/// what has an opacity of 0: such materials become opaque, with one warning that names those that faces have. But with
/// MTL's illum 9 it is meant, as Blender writes an Alpha of 0.
void make_visible(MeshData& mesh, const MeshReadSettings& settings, Diagnostics& diagnostics) {
  std::vector<bool> used(mesh.materials.size(), mesh.face_materials.empty());
  const auto use = [&](const MeshData& part) {
    for (const std::uint32_t material : part.face_materials)
      if (material < used.size()) used[material] = true;
  };
  use(mesh);
  for (const MeshCopies& copies : mesh.copies) use(*copies.mesh);
  std::string names;
  std::size_t count = 0;
  constexpr std::size_t most_names = 10;
  for (std::size_t i = 0; i < mesh.materials.size(); ++i) {
    MeshMaterial& material = mesh.materials[i];
    if (material.d.value_or(1) > 0 || (material.illum == 9 && !material.tf)) continue;
    material.d = 1;
    if (used[i] && !settings.overrides(material.name) && count++ < most_names)
      names += (names.empty() ? "" : ", ") + in_quotes(material.name);
  }
  if (count > most_names) names += " and " + std::to_string(count - most_names) + " more";
  if (count > 0)
    diagnostics.warning({}, "an opacity of 0, which would show nothing, is taken as opaque, of the " +
                                std::string(count > 1 ? "materials " : "material ") + names);
}

}  // namespace

bool is_mesh_file(const std::string& file) {
  const std::string type = mesh_type(file);
  return type == ".ply" || type == ".obj" || type == ".stl" || type == ".gltf" || type == ".glb" ||
         is_converted_model(file);
}

std::optional<MeshData> read_mesh(const std::string& name, const MeshReadSettings& settings, Diagnostics& diagnostics) {
  if (!is_mesh_file(name)) {
    diagnostics.error({},
                      "is no mesh by its name, which ends in none of .ply, .obj, .stl, .gltf and .glb, perhaps with "
                      ".gz behind, and " +
                          converted_types_text());
    return std::nullopt;
  }
  std::optional<MeshFile> file = MeshFile::open(name, diagnostics);
  if (file && is_converted_model(name) && !file->convert(name, diagnostics)) file.reset();
  if (!file) return std::nullopt;
  const std::string type = mesh_type(name), folder = std::filesystem::path(name).parent_path().string();
  std::optional<MeshData> mesh;
  const bool is_gltf = type == ".gltf" || type == ".glb" || is_converted_model(name);
  if (!is_gltf && !settings.variant.empty()) {
    diagnostics.error({}, "has no material variant " + in_quotes(settings.variant) + ": it is no glTF");
    return std::nullopt;
  }
  if (!is_gltf && !settings.animation.empty() && settings.animation != "0") {
    diagnostics.error({}, "has no animation " + in_quotes(settings.animation) + ": it is no glTF");
    return std::nullopt;
  }
  if (type == ".ply")
    mesh = read_ply(*file, folder, settings, diagnostics);
  else if (type == ".stl")
    mesh = read_stl(*file, settings, diagnostics);
  else if (is_gltf)
    mesh = read_gltf(*file, name, settings, diagnostics);
  else
    mesh = read_obj(*file, folder, settings, diagnostics);
  if (!mesh) return mesh;
  mesh->origin = settings.origin;
  if (type == ".obj" || is_converted_model(name))
    make_visible(*mesh, settings, diagnostics);  // glTF means what it says
  return mesh;
}

std::optional<MeshData> make_mesh(std::span<const double> positions, std::span<const double> corners,
                                  std::span<const std::uint32_t> face_ends, std::span<const double> normals,
                                  std::span<const double> uvs, std::span<const double> uvs2, bool polygons,
                                  Diagnostics& diagnostics) {
  MeshData mesh;
  mesh.keeps_polygons = polygons;
  const auto floats = [](std::span<const double> values, const Vec3d& origin) {
    MeshBuffer<float> buffer(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      buffer[i] = rounded(values[i] - component(origin, static_cast<int>(i % 3)));
    return buffer;
  };
  mesh.origin = origin_of(positions);
  mesh.positions = floats(positions, mesh.origin);
  mesh.normals = floats(normals, {0, 0, 0});
  mesh.uvs = floats(uvs, {0, 0, 0});
  mesh.uvs2 = floats(uvs2, {0, 0, 0});

  FaceCounts counts;
  std::uint32_t first = 0;
  for (const std::uint32_t end : face_ends) counts.add(end - std::exchange(first, end));
  if (!make_faces(counts, mesh, diagnostics)) return std::nullopt;
  FaceWriter writer(mesh, 0);
  std::vector<std::uint32_t> polygon;
  first = 0;
  for (const std::uint32_t end : face_ends) {
    polygon.clear();
    for (; first < end; ++first) polygon.push_back(static_cast<std::uint32_t>(corners[first]));
    writer.add(polygon);
  }
  MeshFaults faults;
  faults.bad_vertices = mark_bad_positions(mesh.positions.data(), mesh.vertex_count());
  faults.degenerate_faces = writer.degenerate();
  if (!finish_mesh(mesh, faults, false, 1, diagnostics)) return std::nullopt;
  return mesh;
}

Vec3d near_origin(std::span<const float> positions) { return origin_of(positions); }

std::optional<PointCloud> read_point_cloud(const std::string& name, const MeshReadSettings& settings,
                                           Diagnostics& diagnostics) {
  if (mesh_type(name) != ".ply") {
    diagnostics.error({}, "is no cloud by its name, which does not end in .ply, perhaps with .gz behind");
    return std::nullopt;
  }
  std::optional<MeshFile> file = MeshFile::open(name, diagnostics);
  if (!file) return std::nullopt;
  std::optional<PointCloud> cloud = read_ply_cloud(*file, settings, diagnostics);
  if (cloud) cloud->origin = settings.origin;
  return cloud;
}

}  // namespace raytrace
