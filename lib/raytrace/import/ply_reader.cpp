#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <system_error>
#include <utility>

#include "raytrace/import/empty_files.h"
#include "raytrace/import/mesh_readers.h"
#include "raytrace/import/ply_body.h"
#include "raytrace/parameters/fields.h"
#include "raytrace/text/message.h"

namespace raytrace {
namespace ply {
namespace {

using Names = std::initializer_list<std::string_view>;

struct OpenFile {
  Header header;
  std::unique_ptr<Body> body;
  std::size_t vertices = 0;
  std::vector<Column> columns;

  const Element& vertex() const { return header.elements[header.find("vertex")]; }

  /// A buffer for properties of the vertices, if the file has all of them, each a number with one of these names.
  MeshBuffer<float> add(std::initializer_list<Names> names, Column::Use use, const Vec3d& origin = {0, 0, 0}) {
    std::vector<std::size_t> found;
    for (const Names& one : names)
      if (const auto property = vertex().find(one); property && !vertex().properties[*property].count_type)
        found.push_back(*property);
    if (found.size() < names.size()) return {};
    MeshBuffer<float> buffer(vertices * names.size());
    for (std::size_t i = 0; i < found.size(); ++i)
      columns.push_back({found[i], use, component(origin, static_cast<int>(i)), buffer.data() + i, found.size()});
    return buffer;
  }
  MeshBuffer<float> add_colors() {
    return add({{"red", "r", "diffuse_red"}, {"green", "g", "diffuse_green"}, {"blue", "b", "diffuse_blue"}},
               Column::Use::color);
  }
  /// What colours have beside them.
  MeshBuffer<float> add_alphas() { return add({{"alpha", "a", "diffuse_alpha"}}, Column::Use::alpha); }
};

/// Reads the head, and makes sure that the file has the vertices and that these have positions.
bool open(MeshFile& file, const MeshReadSettings& settings, Diagnostics& diagnostics, OpenFile& open,
          MeshBuffer<float>& positions) {
  constexpr std::size_t longest_head = std::size_t{1} << 20U;
  MeshFile::Scratch scratch;
  const std::size_t size = std::min(file.size(), longest_head);
  const char* const first = file.bytes(0, size, scratch);
  if (first == nullptr) {
    MeshFile::report_changed(diagnostics);
    return false;
  }
  std::optional<Header> header = read_header({first, size}, diagnostics);
  if (!header) return false;
  open.header = std::move(*header);
  const auto refuse = [&](const std::string& message) {
    diagnostics.error({open.header.lines, 0}, message);
    return false;
  };
  if (open.header.find("vertex") == open.header.elements.size()) return refuse("there is no element 'vertex'");
  open.vertices = open.vertex().count;
  if (open.vertices >= std::numeric_limits<std::uint32_t>::max())
    return refuse("there are more than 4294967294 vertices");
  for (const std::string_view name : {"x", "y", "z"}) {
    const auto property = open.vertex().find({name});
    if (!property || open.vertex().properties[*property].count_type)
      return refuse("the element 'vertex' has no property " + in_quotes(name));
  }
  const bool text = open.header.format == Header::Format::ascii;
  open.body = (text ? text_body : binary_body)(file, open.header, settings.threads, diagnostics);
  if (!open.body->find_vertices()) return false;
  positions = open.add({{"x"}, {"y"}, {"z"}}, Column::Use::position, settings.origin);
  return true;
}

/// Of the textures that MeshLab and others name in comments: white materials with them, if they can be seen, of the
/// faces that have their numbers, or of all.
void add_textures(std::vector<std::string> names, const std::string& folder, MeshData& mesh,
                  MeshBuffer<std::uint32_t> of_faces, const MeshReadSettings& settings, Diagnostics& diagnostics) {
  if (names.empty()) return;
  if (names.size() > 1 && of_faces.empty()) {
    diagnostics.warning({}, "names " + std::to_string(names.size()) +
                                " textures, and faces do not say which they have: all have the first");
    names.resize(1);
  }
  bool any = false;
  for (std::string& name : names) {
    std::replace(name.begin(), name.end(), '\\', '/');
    MeshMaterial& material = mesh.materials.emplace_back();
    material.name = name;
    std::error_code unknown;
    std::string reason;
    if (mesh.uvs.empty())
      reason = "there are no texture coordinates";
    else if (!std::filesystem::is_regular_file(std::filesystem::path(folder) / name, unknown))
      reason = "there is no such file";
    if (reason.empty()) {
      material.map_kd.file = name;
      any = true;
    } else {
      material.kd = Rgb<double>(0.5, 0.5, 0.5);
      if (!settings.overrides(name))
        diagnostics.warning({}, "the texture " + in_quotes(name) + " is left out: " + reason);
    }
  }
  const auto is_overridden = [&](const MeshMaterial& material) { return settings.overrides(material.name); };
  if (!any && std::none_of(mesh.materials.begin(), mesh.materials.end(), is_overridden)) return mesh.materials.clear();
  const auto count = static_cast<std::uint32_t>(names.size());
  const auto is_first = [&](std::uint32_t texture) { return texture == 0; };
  if (std::all_of(of_faces.begin(), of_faces.end(), is_first)) return;
  for (std::size_t i = 0; i < of_faces.size(); ++i)
    if (of_faces[i] >= count) of_faces[i] = MeshData::no_material;
  mesh.face_materials = std::move(of_faces);
}

}  // namespace
}  // namespace ply

std::optional<MeshData> read_ply(MeshFile& file, const std::string& folder, const MeshReadSettings& settings,
                                 Diagnostics& diagnostics) {
  using ply::Column;
  ply::OpenFile open;
  MeshData mesh;
  mesh.keeps_polygons = settings.polygons;
  if (!ply::open(file, settings, diagnostics, open, mesh.positions)) return std::nullopt;
  const std::size_t faces = open.header.find("face");
  const auto property = faces < open.header.elements.size()
                            ? open.header.elements[faces].find({"vertex_indices", "vertex_index"})
                            : std::nullopt;
  const auto is_list = [](const ply::Property& p) { return p.count_type && !ply::is_float(p.type); };
  if (!property || !is_list(open.header.elements[faces].properties[*property])) {
    diagnostics.error({open.header.lines, 0},
                      "there is no element 'face' with a list of integers 'vertex_indices'; points alone are for the "
                      "<spherecloud> of a scene");
    return std::nullopt;
  }
  mesh.normals = open.add({{"nx"}, {"ny"}, {"nz"}}, Column::Use::number);
  mesh.colors = open.add_colors();
  if (settings.vertex_alphas && !mesh.colors.empty()) mesh.alphas = open.add_alphas();

  // Those of corners are closer to what is seen.
  ply::FaceColumns columns{*property};
  const ply::Element& face = open.header.elements[faces];
  if (const auto uvs = face.find({"texcoord"}); uvs && face.properties[*uvs].count_type) columns.uvs = uvs;
  if (const auto number = face.find({"texnumber"}); number && !face.properties[*number].count_type)
    columns.texture = number;
  if (face.find({"red", "r", "diffuse_red"}) && face.find({"green", "g", "diffuse_green"}) &&
      face.find({"blue", "b", "diffuse_blue"}))
    diagnostics.warning({},
                        "the colours of its faces ('red', 'green', 'blue' of the element 'face') are left out: only "
                        "vertices have colours here");
  if (!columns.uvs)
    mesh.uvs =
        open.add({{"u", "s", "texture_u", "texture_s"}, {"v", "t", "texture_v", "texture_t"}}, Column::Use::number);
  ply::FaceValues values;

  MeshFaults faults;
  bool dented_quads = false;
  if (!open.body->read_vertices(open.columns, mesh.positions.data(), faults.bad_vertices)) return std::nullopt;
  leave_out_ones(mesh.alphas);
  if (!open.body->read_faces(columns, mesh, values, faults, dented_quads)) return std::nullopt;
  if (columns.uvs) {
    constexpr std::size_t most_corners = std::size_t{1} << 31U;
    if (mesh.indices.size() >= most_corners) {
      diagnostics.error({}, "has faces of more than 2147483647 corners");
      return std::nullopt;
    }
    join_vertices(mesh, values.uvs, settings.threads);
    if (values.other_counts > 0)
      diagnostics.warning({}, std::to_string(values.other_counts) +
                                  " faces have not two numbers 'texcoord' for each corner, which are 0 0 then");
  }
  // Before faces are left out, with them.
  ply::add_textures(std::move(open.header.textures), folder, mesh, std::move(values.textures), settings, diagnostics);
  if (!finish_mesh(mesh, faults, dented_quads, settings.threads, diagnostics)) return std::nullopt;
  return mesh;
}

std::optional<PointCloud> read_ply_cloud(MeshFile& file, const MeshReadSettings& settings, Diagnostics& diagnostics) {
  ply::OpenFile open;
  PointCloud cloud;
  if (!ply::open(file, settings, diagnostics, open, cloud.positions)) return std::nullopt;
  cloud.radii = open.add({{"radius"}}, ply::Column::Use::radius);
  cloud.colors = open.add_colors();
  std::size_t bad = 0;
  if (!open.body->read_vertices(open.columns, cloud.positions.data(), bad)) return std::nullopt;

  const bool has_radii = !cloud.radii.empty(), has_colors = !cloud.colors.empty();
  std::size_t kept = 0;
  const auto move = [&](MeshBuffer<float>& values, std::size_t i, std::size_t numbers) {
    std::copy_n(&values[numbers * i], numbers, &values[numbers * kept]);
  };
  for (std::size_t i = 0; i < open.vertices; ++i) {
    if (std::isnan(cloud.positions[3 * i])) continue;
    if (has_radii && !(cloud.radii[i] >= smallest_size && cloud.radii[i] <= largest_number)) continue;
    if (kept < i) {
      move(cloud.positions, i, 3);
      if (has_radii) move(cloud.radii, i, 1);
      if (has_colors) move(cloud.colors, i, 3);
    }
    ++kept;
  }
  cloud.positions.shorten_to(3 * kept);
  if (has_radii) cloud.radii.shorten_to(kept);
  if (has_colors) cloud.colors.shorten_to(3 * kept);
  if (kept < open.vertices)
    diagnostics.warning({}, std::to_string(open.vertices - kept) +
                                " points are not finite, beyond 1e18 or without a size, and are left out");
  if (kept == 0) {
    diagnostics.error({}, open.vertices == 0 ? no_points : "has no points that can be rendered");
    return std::nullopt;
  }
  return cloud;
}

}  // namespace raytrace
