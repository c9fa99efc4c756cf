// glTF and GLB: gltf_model.h reads what the file says; this joins its primitives into one mesh in world space.
#include <algorithm>
#include <cmath>

#include "raytrace/import/gltf_model.h"
#include "raytrace/import/mesh_faces.h"
#include "raytrace/import/mesh_readers.h"
#include "raytrace/memory/process_status.h"
#include "raytrace/text/message.h"

namespace raytrace {
namespace gltf {
namespace {

class MeshWriter {
 public:
  MeshWriter(const Model& model, const MeshReadSettings& settings, Diagnostics& diagnostics)
      : model_(model), settings_(settings), diagnostics_(diagnostics) {}

  /// file_size: of all that the model was read from.
  std::optional<MeshData> write(std::size_t file_size) {
    if (!allocate(file_size)) return std::nullopt;
    for (const Instance& instance : model_.instances) {
      begin_part(model_.node_names.at(instance.node));
      std::vector<std::size_t> first_vertices;
      for (const Primitive& primitive : *instance.mesh) {
        const bool is_new = primitive.vertices_of == first_vertices.size();
        first_vertices.push_back(is_new ? next_vertex_ : first_vertices[primitive.vertices_of]);
        if (is_new) write_vertices(primitive, instance);
        write_faces(primitive, first_vertices.back(), is_mirrored(primitive, instance));
      }
    }
    MeshFaults faults;
    faults.too_small_polygons = incomplete_;
    const auto sum = [&](std::size_t count, const auto& of_chunk) {
      std::vector<std::size_t> counts(chunk_count(count));
      for_each_chunk(count, settings_.threads, [&](std::size_t chunk, std::size_t first, std::size_t last) {
        counts[chunk] = of_chunk(first, last);
      });
      std::size_t all = 0;
      for (const std::size_t of_one : counts) all += of_one;
      return all;
    };
    faults.bad_vertices = sum(mesh_.vertex_count(), [&](std::size_t first, std::size_t last) {
      return mark_bad_positions(mesh_.positions.data() + 3 * first, last - first);
    });
    faults.degenerate_faces = sum(mesh_.face_count(), [&](std::size_t first, std::size_t last) {
      std::size_t degenerate = 0;
      for (std::size_t i = first; i < last; ++i) degenerate += is_degenerate(&mesh_.indices[3 * i], 3) ? 1U : 0U;
      return degenerate;
    });
    mesh_.materials = model_.materials;
    mesh_.cameras = model_.cameras;
    mesh_.lights = model_.lights;
    mesh_.animation_end = model_.animation_end;
    for (MeshMaterial& material : mesh_.materials) material.vertex_colors = !mesh_.colors.empty();
    if (mesh_.parts.size() == 1) mesh_.parts.clear();
    if (!finish_mesh(mesh_, faults, false, settings_.threads, diagnostics_)) return std::nullopt;
    return std::move(mesh_);
  }

 private:
  bool allocate(std::size_t file_size);
  static bool has_skin(const Primitive& primitive, const Instance& instance) {
    return instance.skin != nullptr && !primitive.joint_sets.empty();
  }
  static bool is_deformed(const Primitive& primitive, const Instance& instance) {
    return has_skin(primitive, instance) || is_morphed(primitive, *instance.weights);
  }
  /// A skin mirrors as its first joint does.
  static bool is_mirrored(const Primitive& primitive, const Instance& instance) {
    const Affine& affine = has_skin(primitive, instance) ? instance.skin->joints.front() : instance.transform;
    return affine.determinant() < 0;
  }
  /// Nodes of one name are one part where they follow each other, as instances of a node do.
  void begin_part(const std::string& name) {
    if (mesh_.parts.empty() || mesh_.parts.back().name != name) mesh_.parts.push_back({name, next_face_});
  }
  void write_vertices(const Primitive& primitive, const Instance& instance);
  void write_tangents(const Primitive& primitive, const Instance& instance, std::size_t first_vertex);
  void write_faces(const Primitive& primitive, std::size_t first_vertex, bool mirrored);

  const Model& model_;
  const MeshReadSettings& settings_;
  Diagnostics& diagnostics_;
  MeshData mesh_;
  std::size_t next_vertex_ = 0, next_face_ = 0, incomplete_ = 0;
};

bool MeshWriter::allocate(std::size_t file_size) {
  bool normals = false, tangents = false, uvs = false, uvs2 = false, colors = false, materials = false;
  std::size_t vertices = 0;
  FaceCounts faces;
  std::size_t deformed_at_once = 0;
  for (const Instance& instance : model_.instances)
    for (const Primitive& primitive : *instance.mesh) {
      if (primitive.vertices_of == static_cast<std::size_t>(&primitive - instance.mesh->data()))
        vertices += primitive.positions.elements.count;
      if (is_deformed(primitive, instance))
        deformed_at_once = std::max(deformed_at_once, primitive.positions.elements.count);
      faces.triangles += primitive.faces();
      normals = normals || primitive.normals;
      tangents = tangents || (primitive.tangents && !is_deformed(primitive, instance));
      uvs = uvs || primitive.uvs;
      uvs2 = uvs2 || primitive.uvs2;
      colors = colors || primitive.colors;
      materials = materials || primitive.material != 0;
    }
  // What each node has for itself is some times as large as in the file.
  constexpr std::size_t bytes_of_face = 4 * sizeof(std::uint32_t);
  const std::size_t bytes_of_vertex = (11 + (uvs2 ? 2 : 0) + (tangents ? 4 : 0)) * sizeof(float);
  const std::size_t bytes =
      vertices * bytes_of_vertex + faces.triangles * bytes_of_face + deformed_at_once * bytes_of_deformed_vertex;
  if (bytes / 64 > file_size && bytes > available_memory() / 4) {
    diagnostics_.error({}, "its nodes have " + std::to_string(faces.triangles) +
                               " faces, more than fit into a quarter of the memory that is available");
    return false;
  }
  if (vertices >= no_index) {
    diagnostics_.error({}, "has more than 4294967294 vertices");
    return false;
  }
  if (!make_faces(faces, mesh_, diagnostics_)) return false;
  mesh_.positions = MeshBuffer<float>(3 * vertices);
  if (normals) mesh_.normals = MeshBuffer<float>(3 * vertices);
  if (tangents) mesh_.tangents = MeshBuffer<float>(4 * vertices);
  if (uvs) mesh_.uvs = MeshBuffer<float>(2 * vertices);
  if (uvs2) mesh_.uvs2 = MeshBuffer<float>(2 * vertices);
  if (colors) mesh_.colors = MeshBuffer<float>(3 * vertices);
  if (materials && !model_.materials.empty()) mesh_.face_materials = MeshBuffer<std::uint32_t>(faces.triangles);
  return true;
}

void MeshWriter::write_vertices(const Primitive& primitive, const Instance& instance) {
  // Of what a skin has placed already: none.
  const Affine transform = has_skin(primitive, instance) ? Affine() : instance.transform;
  const std::size_t first = next_vertex_, count = primitive.positions.elements.count;
  next_vertex_ += count;
  using Values = std::array<double, Elements::most_components>;
  const auto put = [](float* out, std::size_t numbers, const Vec3d& value) {
    for (std::size_t k = 0; k < numbers; ++k) out[k] = finite_or_zero(rounded(component(value, static_cast<int>(k))));
  };
  const auto write = [&](MeshBuffer<float>& buffer, std::size_t numbers, const std::optional<Accessor>& accessor,
                         float otherwise, const auto& converted) {
    if (buffer.empty()) return;
    float* const out = buffer.data() + numbers * first;
    if (!accessor) return void(std::fill_n(out, numbers * count, otherwise));
    for_each_element(*accessor, settings_.threads, [&](std::size_t i, const Values& values) {
      put(out + numbers * i, numbers, converted(Vec3d{values[0], values[1], values[2]}));
    });
  };
  const auto put_position = [&](std::size_t i, const Vec3d& local) {
    const Vec3d position = transform.point(local) - settings_.origin;
    for (std::size_t k = 0; k < 3; ++k)
      mesh_.positions[3 * (first + i) + k] = rounded(component(position, static_cast<int>(k)));
  };
  const auto placed_normal = [&](const Vec3d& n) {
    const Vec3d normal = transform.normal(n);
    return normal * (1 / length(normal));
  };
  if (is_deformed(primitive, instance)) {
    const Skin* const skin = has_skin(primitive, instance) ? instance.skin : nullptr;
    const Vertices vertices = deformed(primitive, *instance.weights, skin, settings_.threads);
    for_each_chunk(count, settings_.threads, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        put_position(i, vertices.positions[i]);
        if (mesh_.normals.empty()) continue;
        const Vec3d normal = vertices.normals.empty() ? Vec3d(0, 0, 0) : placed_normal(vertices.normals[i]);
        put(&mesh_.normals[3 * (first + i)], 3, normal);
      }
    });
  } else {
    for_each_element(primitive.positions, settings_.threads,
                     [&](std::size_t i, const Values& values) { put_position(i, {values[0], values[1], values[2]}); });
    write(mesh_.normals, 3, primitive.normals, 0, placed_normal);
  }
  write_tangents(primitive, instance, first);
  const auto from_lower_left = [](const Vec3d& uv) { return Vec3d{uv.x, 1 - uv.y, 0}; };
  write(mesh_.uvs, 2, primitive.uvs, 0, from_lower_left);
  write(mesh_.uvs2, 2, primitive.uvs2 ? primitive.uvs2 : primitive.uvs, 0, from_lower_left);
  write(mesh_.colors, 3, primitive.colors, 1, [](const Vec3d& color) { return color; });
}

/// What is deformed has none: those that follow from its texture coordinates are as good.
void MeshWriter::write_tangents(const Primitive& primitive, const Instance& instance, std::size_t first_vertex) {
  if (mesh_.tangents.empty()) return;
  float* const out = &mesh_.tangents[4 * first_vertex];
  std::fill_n(out, 4 * primitive.positions.elements.count, 0.0F);
  if (!primitive.tangents || is_deformed(primitive, instance)) return;
  const double mirror = is_mirrored(primitive, instance) ? -1 : 1;
  for_each_element(*primitive.tangents, settings_.threads, [&](std::size_t i, const auto& values) {
    const Vec3d tangent = instance.transform.vector({values[0], values[1], values[2]});
    const double size = length(tangent);
    const bool is_there = size > 0 && std::isfinite(size);
    for (int k = 0; k < 3; ++k)
      out[4 * i + static_cast<std::size_t>(k)] = is_there ? rounded(component(tangent, k) / size) : 0.0F;
    out[4 * i + 3] = !is_there ? 0.0F : values[3] * mirror < 0 ? -1.0F : 1.0F;
  });
}

void MeshWriter::write_faces(const Primitive& primitive, std::size_t first_vertex, bool mirrored) {
  const std::size_t vertices = primitive.positions.elements.count, faces = primitive.faces();
  MeshBuffer<std::uint32_t> corners;
  if (primitive.indices) {
    corners = MeshBuffer<std::uint32_t>(primitive.corners());
    for_each_element(*primitive.indices, settings_.threads,
                     [&](std::size_t i, const auto& values) { corners[i] = static_cast<std::uint32_t>(values[0]); });
    if (const std::uint32_t largest = *std::max_element(corners.begin(), corners.end()); largest >= vertices)
      throw Error(primitive.indices->place + ": has the index " + std::to_string(largest) + ", and there are " +
                  std::to_string(vertices) + " vertices");
  }
  std::uint32_t* const out = mesh_.indices.data() + 3 * next_face_;
  for_each_chunk(faces, settings_.threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      std::array<std::size_t, 3> face{3 * i, 3 * i + 1, 3 * i + 2};
      if (primitive.mode == Mode::strip)
        face = {i, i + 1 + i % 2, i + 2 - i % 2};
      else if (primitive.mode == Mode::fan)
        face = {i + 1, i + 2, 0};
      if (mirrored) std::swap(face[1], face[2]);
      for (std::size_t k = 0; k < 3; ++k)
        out[3 * i + k] =
            static_cast<std::uint32_t>(first_vertex + (corners.empty() ? face[k] : std::size_t{corners[face[k]]}));
    }
  });
  if (!mesh_.face_materials.empty()) std::fill_n(mesh_.face_materials.data() + next_face_, faces, primitive.material);
  next_face_ += faces;
  if (primitive.mode == Mode::triangles && primitive.corners() % 3 != 0) ++incomplete_;
}

}  // namespace
}  // namespace gltf

std::optional<MeshData> read_gltf(MeshFile& file, const std::string& name, const MeshReadSettings& settings,
                                  Diagnostics& diagnostics) {
  if (!file.load(settings.threads, diagnostics)) return std::nullopt;
  try {
    const gltf::Model model = gltf::read_model(file.text(false), name, settings, diagnostics);
    if (model.other_primitives > 0)
      diagnostics.warning({}, counted(model.other_primitives, "primitive") +
                                  " of points or lines, or without "
                                  "positions, are left out");
    std::optional<MeshData> mesh = gltf::MeshWriter(model, settings, diagnostics).write(model.document->size());
    if (mesh) mesh->files = model.document->files();
    return mesh;
  } catch (const gltf::Error& error) {
    diagnostics.error({}, error.what());
    return std::nullopt;
  }
}

}  // namespace raytrace
