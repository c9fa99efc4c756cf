// glTF and GLB: gltf_model.h reads what the file says; this joins its primitives into one mesh in world space, but for
// what is there very often.
#include <algorithm>
#include <cmath>

#include "raytrace/import/empty_files.h"
#include "raytrace/import/gltf_arrays.h"
#include "raytrace/import/gltf_copies.h"
#include "raytrace/import/gltf_model.h"
#include "raytrace/import/mesh_faces.h"
#include "raytrace/import/mesh_readers.h"
#include "raytrace/memory/process_status.h"
#include "raytrace/text/message.h"

namespace raytrace {
namespace gltf {
namespace {

/// Joins instances into one mesh.
class MeshWriter {
 public:
  /// origin: subtracted from the positions.
  MeshWriter(const Vec3d& origin, int threads) : origin_(origin), threads_(threads) {}

  bool allocate(const Size& size, const Arrays& arrays, Diagnostics& diagnostics);
  std::size_t next_face() const { return next_face_; }
  void add(const Instance& instance) {
    std::vector<std::size_t> first_vertices;
    for (const Primitive& primitive : *instance.mesh) {
      const bool is_new = primitive.vertices_of == first_vertices.size();
      first_vertices.push_back(is_new ? next_vertex_ : first_vertices[primitive.vertices_of]);
      if (is_new) write_vertices(primitive, instance);
      write_faces(primitive, first_vertices.back(), is_mirrored(primitive, instance));
    }
  }
  /// What is wrong with it. Bad vertices are marked, and nothing is left out yet.
  MeshFaults faults();
  MeshData& mesh() { return mesh_; }

 private:
  void write_vertices(const Primitive& primitive, const Instance& instance);
  void write_tangents(const Primitive& primitive, const Instance& instance, std::size_t first_vertex);
  void write_faces(const Primitive& primitive, std::size_t first_vertex, bool mirrored);

  Vec3d origin_;
  int threads_;
  MeshData mesh_;
  std::size_t next_vertex_ = 0, next_face_ = 0, incomplete_ = 0;
};

bool MeshWriter::allocate(const Size& size, const Arrays& arrays, Diagnostics& diagnostics) {
  const std::size_t vertices = size.vertices;
  if (vertices >= no_index) {
    diagnostics.error({}, "has more than 4294967294 vertices");
    return false;
  }
  if (!make_faces(size.faces, mesh_, diagnostics)) return false;
  mesh_.positions = MeshBuffer<float>(3 * vertices);
  if (arrays.normals) mesh_.normals = MeshBuffer<float>(3 * vertices);
  if (arrays.tangents) mesh_.tangents = MeshBuffer<float>(4 * vertices);
  if (arrays.uvs) mesh_.uvs = MeshBuffer<float>(2 * vertices);
  if (arrays.uvs2) mesh_.uvs2 = MeshBuffer<float>(2 * vertices);
  if (arrays.colors) mesh_.colors = MeshBuffer<float>(3 * vertices);
  if (arrays.alphas) mesh_.alphas = MeshBuffer<float>(vertices);
  if (arrays.materials) mesh_.face_materials = MeshBuffer<std::uint32_t>(size.faces.triangles);
  return true;
}

MeshFaults MeshWriter::faults() {
  MeshFaults faults;
  faults.too_small_polygons = incomplete_;
  const auto sum = [&](std::size_t count, const auto& of_chunk) {
    std::vector<std::size_t> counts(chunk_count(count));
    for_each_chunk(count, threads_, [&](std::size_t chunk, std::size_t first, std::size_t last) {
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
  return faults;
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
    for_each_element(*accessor, threads_, [&](std::size_t i, const Values& values) {
      put(out + numbers * i, numbers, converted(Vec3d{values[0], values[1], values[2]}));
    });
  };
  const auto put_position = [&](std::size_t i, const Vec3d& local) {
    const Vec3d position = transform.point(local) - origin_;
    for (std::size_t k = 0; k < 3; ++k)
      mesh_.positions[3 * (first + i) + k] = rounded(component(position, static_cast<int>(k)));
  };
  const auto placed_normal = [&](const Vec3d& n) {
    const Vec3d normal = transform.normal(n);
    return normal * (1 / length(normal));
  };
  if (is_deformed(primitive, instance)) {
    const Skin* const skin = has_skin(primitive, instance) ? instance.skin : nullptr;
    const Vertices vertices = deformed(primitive, *instance.weights, skin, threads_);
    for_each_chunk(count, threads_, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        put_position(i, vertices.positions[i]);
        if (mesh_.normals.empty()) continue;
        const Vec3d normal = vertices.normals.empty() ? Vec3d(0, 0, 0) : placed_normal(vertices.normals[i]);
        put(&mesh_.normals[3 * (first + i)], 3, normal);
      }
    });
  } else {
    for_each_element(primitive.positions, threads_,
                     [&](std::size_t i, const Values& values) { put_position(i, {values[0], values[1], values[2]}); });
    write(mesh_.normals, 3, primitive.normals, 0, placed_normal);
  }
  write_tangents(primitive, instance, first);
  const auto from_lower_left = [](const Vec3d& uv) { return Vec3d{uv.x, 1 - uv.y, 0}; };
  write(mesh_.uvs, 2, primitive.uvs, 0, from_lower_left);
  write(mesh_.uvs2, 2, primitive.uvs2 ? primitive.uvs2 : primitive.uvs, 0, from_lower_left);
  write(mesh_.colors, 3, primitive.colors, 1, [](const Vec3d& color) { return color; });
  if (mesh_.alphas.empty()) return;
  // Of opaque materials, too: others may have the same vertices.
  float* const alphas = mesh_.alphas.data() + first;
  std::fill_n(alphas, count, 1.0F);
  if (!primitive.has_alpha()) return;
  for_each_element(*primitive.colors, threads_, [&](std::size_t i, const Values& values) {
    alphas[i] = values[3] > 0 ? rounded(std::min(values[3], 1.0)) : 0;
  });
}

/// What is deformed has none: those that follow from its texture coordinates are as good.
void MeshWriter::write_tangents(const Primitive& primitive, const Instance& instance, std::size_t first_vertex) {
  if (mesh_.tangents.empty()) return;
  float* const out = &mesh_.tangents[4 * first_vertex];
  std::fill_n(out, 4 * primitive.positions.elements.count, 0.0F);
  if (!primitive.tangents || is_deformed(primitive, instance)) return;
  const double mirror = is_mirrored(primitive, instance) ? -1 : 1;
  for_each_element(*primitive.tangents, threads_, [&](std::size_t i, const auto& values) {
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
    for_each_element(*primitive.indices, threads_,
                     [&](std::size_t i, const auto& values) { corners[i] = static_cast<std::uint32_t>(values[0]); });
    if (const std::uint32_t largest = *std::max_element(corners.begin(), corners.end()); largest >= vertices)
      throw Error(primitive.indices->place + ": has the index " + std::to_string(largest) + ", and there are " +
                  std::to_string(vertices) + " vertices");
  }
  std::uint32_t* const out = mesh_.indices.data() + 3 * next_face_;
  for_each_chunk(faces, threads_, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      std::array<std::size_t, 3> face = primitive.face(i);
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

/// All of a model, as one mesh and copies of others.
class ModelWriter {
 public:
  ModelWriter(const Model& model, const MeshReadSettings& settings, Diagnostics& diagnostics)
      : model_(model),
        settings_(settings),
        diagnostics_(diagnostics),
        plan_(plan_copies(model, settings.joined)),
        joined_(settings.origin, settings.threads),
        first_copies_(plan_.meshes) {
    arrays_.all_alphas = settings.vertex_alphas;
  }

  std::optional<MeshData> write() {
    if (!allocate()) return std::nullopt;
    std::vector<MeshCopies> copies(plan_.meshes);
    MeshFaults faults = write_places(copies);
    const std::size_t errors_before = diagnostics_.error_count();
    faults += write_copied(copies);
    if (diagnostics_.error_count() > errors_before) return std::nullopt;
    MeshData& mesh = joined_.mesh();
    if (mesh.face_count() == 0) faults += join_first(copies);
    std::erase_if(copies, [](const MeshCopies& of_one) { return of_one.mesh == nullptr || of_one.places.empty(); });
    mesh.copies = std::move(copies);
    mesh.materials = model_.materials;
    mesh.cameras = model_.cameras;
    mesh.lights = model_.lights;
    mesh.animation_end = model_.animation_end;
    const bool has_alphas = !mesh.alphas.empty() ||
                            std::ranges::any_of(mesh.copies, [](const auto& of) { return !of.mesh->alphas.empty(); });
    for (MeshMaterial& material : mesh.materials) {
      material.vertex_colors = !mesh.colors.empty();
      material.map_d.by_vertices = has_alphas && material.map_d.alpha;
    }
    if (mesh.parts.size() == 1) mesh.parts.clear();
    report_faults(faults, diagnostics_);
    if (mesh.face_count() > 0) return std::move(mesh);
    diagnostics_.error({}, has_faces_ ? "has no faces that can be rendered" : no_faces);
    return std::nullopt;
  }

 private:
  static constexpr std::uint32_t joined = CopyPlan::joined, unseen = CopyPlan::unseen;

  bool allocate();
  /// The joined mesh, and where the copies are.
  MeshFaults write_places(std::vector<MeshCopies>& copies);
  /// The meshes that are copied; null where nothing of one is left.
  MeshFaults write_copied(std::vector<MeshCopies>& copies);
  /// A mesh has a face: the first copy of the smallest of the copied ones is then no copy.
  MeshFaults join_first(std::vector<MeshCopies>& copies);
  MeshFaults finish(MeshWriter& writer) const {
    MeshFaults faults = writer.faults();
    leave_out_faults(writer.mesh(), faults);
    leave_out_ones(writer.mesh().alphas);
    return faults;
  }

  const Model& model_;
  const MeshReadSettings& settings_;
  Diagnostics& diagnostics_;
  CopyPlan plan_;
  Arrays arrays_;
  MeshWriter joined_;
  std::vector<const Instance*> first_copies_;  ///< of each mesh that is copied
  bool has_faces_ = false;
};

bool ModelWriter::allocate() {
  Size joined_size;
  for (std::size_t i = 0; i < model_.instances.size(); ++i) {
    const Instance& instance = model_.instances[i];
    const std::uint32_t number = plan_.of_instances[i];
    arrays_.add(instance);
    if (number == joined) joined_size.add(instance);
    if (number < plan_.meshes && first_copies_[number] == nullptr) first_copies_[number] = &instance;
  }
  arrays_.materials = arrays_.materials && !model_.materials.empty();
  std::size_t bytes = joined_size.bytes(arrays_), faces = joined_size.faces.triangles;
  for (const Instance* const instance : first_copies_) {
    Size size;
    size.add(*instance);
    bytes += size.bytes(arrays_);
    faces += size.faces.triangles;
  }
  has_faces_ = faces > 0;
  // What each node has for itself is some times as large as in the file.
  if (bytes / 64 > model_.document->size() && bytes > available_memory() / 4) {
    diagnostics_.error({}, "its nodes have " + std::to_string(faces) +
                               " faces, more than fit into a quarter of the memory that is available");
    return false;
  }
  return joined_.allocate(joined_size, arrays_, diagnostics_);
}

MeshFaults ModelWriter::write_places(std::vector<MeshCopies>& copies) {
  std::vector<MeshPart>& parts = joined_.mesh().parts;
  for (std::size_t i = 0; i < model_.instances.size(); ++i) {
    const Instance& instance = model_.instances[i];
    const std::uint32_t number = plan_.of_instances[i];
    if (number == unseen) continue;
    // Nodes of one name are one part where they follow each other, as instances of a node do.
    const std::string& name = model_.node_names.at(instance.node);
    if (parts.empty() || parts.back().name != name) parts.push_back({name, joined_.next_face()});
    if (number == joined)
      joined_.add(instance);
    else
      copies[number].places.push_back({instance.transform, static_cast<std::uint32_t>(parts.size() - 1)});
  }
  return finish(joined_);
}

MeshFaults ModelWriter::write_copied(std::vector<MeshCopies>& copies) {
  MeshFaults faults;
  for (std::size_t i = 0; i < copies.size(); ++i) {
    Instance instance = *first_copies_[i];
    instance.transform = {};
    MeshWriter writer({0, 0, 0}, settings_.threads);
    Size size;
    size.add(instance);
    if (!writer.allocate(size, arrays_, diagnostics_)) continue;
    writer.add(instance);
    faults += finish(writer);
    if (writer.mesh().face_count() > 0) copies[i].mesh = std::make_shared<const MeshData>(std::move(writer.mesh()));
  }
  return faults;
}

MeshFaults ModelWriter::join_first(std::vector<MeshCopies>& copies) {
  std::size_t smallest = copies.size();
  const auto faces = [&](std::size_t i) { return copies[i].mesh->face_count(); };
  for (std::size_t i = 0; i < copies.size(); ++i)
    if (copies[i].mesh != nullptr && (smallest == copies.size() || faces(i) < faces(smallest))) smallest = i;
  if (smallest == copies.size()) return {};
  std::vector<MeshPart> parts = std::move(joined_.mesh().parts);
  joined_ = MeshWriter(settings_.origin, settings_.threads);
  Size size;
  size.add(*first_copies_[smallest]);
  if (!joined_.allocate(size, arrays_, diagnostics_)) return {};
  joined_.add(*first_copies_[smallest]);
  std::vector<MeshCopies::Place>& places = copies[smallest].places;
  for (std::size_t i = 0; i < parts.size(); ++i)
    parts[i].first_face = i > places.front().part ? joined_.next_face() : 0;
  joined_.mesh().parts = std::move(parts);
  places.erase(places.begin());
  return finish(joined_);
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
    std::optional<MeshData> mesh = gltf::ModelWriter(model, settings, diagnostics).write();
    if (mesh) mesh->files = model.document->files();
    return mesh;
  } catch (const gltf::Error& error) {
    diagnostics.error({}, error.what());
    return std::nullopt;
  }
}

}  // namespace raytrace
