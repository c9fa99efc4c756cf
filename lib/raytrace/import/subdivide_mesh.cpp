#include "raytrace/import/subdivide_mesh.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "raytrace/import/subdivision_topology.h"
#include "raytrace/import/subdivision_values.h"
#include "raytrace/import/unique_items.h"
#include "raytrace/import/vertex_normals.h"
#include "raytrace/memory/process_status.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

namespace {

/// What of a mesh's vertices is interpolated.
struct VertexValues {
  MeshBuffer<float> MeshData::* buffer;
  int size;
};

/// As far as the mesh has them, positions aside.
std::vector<VertexValues> values_of(const MeshData& mesh, const SubdivisionSettings& settings) {
  std::vector<VertexValues> values{
      {&MeshData::uvs, 2}, {&MeshData::uvs2, 2}, {&MeshData::colors, 3}, {&MeshData::alphas, 1}};
  if (settings.flat && settings.normals) values.push_back({&MeshData::normals, 3});
  std::erase_if(values, [&](const VertexValues& one) { return (mesh.*one.buffer).empty(); });
  return values;
}

/// Corners of a part that are in one place are of one vertex; with `values`, only where these are the same, too.
UniqueItems vertices_of(const MeshData& mesh, const MeshPolygons& polygons, const std::vector<VertexValues>& values,
                        int threads) {
  std::vector<std::uint32_t> parts;  // of corners
  if (!polygons.parts.empty()) {
    parts.resize(polygons.vertices.size());
    for_each_item(polygons.count(), threads, [&](std::size_t i) {
      std::fill(parts.begin() + polygons.begins[i], parts.begin() + polygons.begins[i + 1], polygons.parts[i]);
    });
  }
  const auto part = [&](std::size_t corner) { return parts.empty() ? 0 : parts[corner]; };
  const auto bits = [](const float* value) { return std::bit_cast<std::uint32_t>(*value + 0.0F); };  // -0 is 0
  // visit(a number of the vertex) for all that tells it from others.
  const auto all_numbers = [&](std::uint32_t vertex, const auto& visit) {
    const auto visit_all = [&](const MeshBuffer<float>& buffer, std::size_t size) {
      for (std::size_t k = 0; k < size; ++k) visit(bits(&buffer[size * vertex + k]));
    };
    visit_all(mesh.positions, 3);
    for (const VertexValues& one : values) visit_all(mesh.*one.buffer, static_cast<std::size_t>(one.size));
  };
  return unique_items(
      polygons.vertices.size(), threads,
      [&](std::size_t i) {
        std::uint64_t hash = part(i);
        all_numbers(polygons.vertices[i], [&](std::uint32_t number) { hash = mixed_bits(hash + number); });
        return hash;
      },
      [&](std::size_t i, std::size_t j) {
        const std::uint32_t a = polygons.vertices[i], b = polygons.vertices[j];
        if (part(i) != part(j)) return false;
        if (a == b) return true;
        std::array<std::uint32_t, 3 + SubdivisionStep::most_numbers> of_a{};
        std::size_t count = 0;
        all_numbers(a, [&](std::uint32_t number) { of_a[count++] = number; });
        bool same = true;
        count = 0;
        all_numbers(b, [&](std::uint32_t number) { same = same && of_a[count++] == number; });
        return same;
      });
}

/// Of some vertices, and of the surface that they are on. Vertices of `values` may be several in one place.
struct ValueChannel {
  SubdivisionTopology topology{};
  LargeArray<double> values{};
  SubdivisionRules rules{};
  std::vector<int> kinds{};  ///< how many numbers each has
  int size = 0;              ///< all of them
};

class Subdivider {
 public:
  Subdivider(const MeshData& mesh, const SubdivisionSettings& settings)
      : mesh_(mesh), settings_(settings), polygons_(polygons_of(mesh)), interpolated_(values_of(mesh, settings)) {}

  void run(MeshData& out) {
    out.corners = polygons_.are_triangles() ? 3 : 4;
    if (polygons_.count() == 0) return;
    start();
    for (int level = 1; level < settings_.levels; ++level) step();
    write(out);
    write_faces(out);
  }

 private:
  int threads() const { return settings_.threads; }
  bool triangles() const { return positions_.rules.triangles; }
  /// Where values jump, vertices of theirs are more than places.
  bool has_jumps() const { return others_.topology.vertex_count > 0; }
  const SubdivisionTopology& topology_of_values() const { return has_jumps() ? others_.topology : positions_.topology; }

  void start() {
    positions_.rules = {polygons_.are_triangles(), settings_.flat, false};
    others_.rules = {polygons_.are_triangles(), settings_.flat, true};
    const UniqueItems places = vertices_of(mesh_, polygons_, {}, threads());
    positions_.topology = topology_of(polygons_, places.number.data(), places.first.size(), threads());
    load(positions_, {{&MeshData::positions, 3}}, places);
    if (interpolated_.empty()) return;
    const UniqueItems vertices = vertices_of(mesh_, polygons_, interpolated_, threads());
    load(others_, interpolated_, vertices);
    // Without jumps both have the same vertices. But creases of values are straight, and so have kinds of their own.
    others_.topology = topology_of(polygons_, vertices.number.data(), vertices.first.size(), threads());
    fix_sharp_vertices(others_.topology, positions_.topology, threads());
    places_ = LargeArray<std::uint32_t>::unset(vertices.first.size());
    for_each_item(vertices.first.size(), threads(),
                  [&](std::size_t i) { places_[i] = places.number[vertices.first[i]]; });
  }

  void load(ValueChannel& channel, const std::vector<VertexValues>& values, const UniqueItems& vertices) const {
    channel.size = 0;
    for (const VertexValues& one : values) {
      channel.kinds.push_back(one.size);
      channel.size += one.size;
    }
    channel.values = LargeArray<double>::unset(static_cast<std::size_t>(channel.size) * vertices.first.size());
    for_each_item(vertices.first.size(), threads(), [&](std::size_t i) {
      const std::size_t vertex = polygons_.vertices[vertices.first[i]];
      double* out = channel.values.data() + static_cast<std::size_t>(channel.size) * i;
      for (const VertexValues& one : values)
        for (std::size_t k = 0; k < static_cast<std::size_t>(one.size); ++k)
          *out++ = double{(mesh_.*one.buffer)[static_cast<std::size_t>(one.size) * vertex + k]};
    });
  }

  void step() {
    if (has_jumps()) places_ = next_places();
    step(positions_);
    if (has_jumps()) step(others_);
  }

  void step(ValueChannel& channel) const {
    const SubdivisionTopology& topology = channel.topology;
    const auto size = static_cast<std::size_t>(channel.size);
    auto values = LargeArray<double>::unset(size * counts_after_step(topology, triangles()).vertices);
    SubdivisionStep(topology, channel.rules, channel.values.data(), channel.kinds, threads())
        .run(false, [&](std::size_t vertex, const SubdivisionStep::Numbers& numbers) {
          std::copy_n(numbers.data(), size, values.data() + size * vertex);
        });
    channel.values = std::move(values);
    channel.topology = next_topology(topology, triangles(), channel.rules.linear_edges, threads());
  }

  /// Of each vertex of the other values after the step, the vertex that is its place.
  LargeArray<std::uint32_t> next_places() const {
    const SubdivisionTopology &of_places = positions_.topology, &topology = others_.topology;
    auto places = LargeArray<std::uint32_t>::unset(counts_after_step(topology, triangles()).vertices);
    const std::size_t on_edges = vertex_on_edge(topology, triangles(), 0);
    std::copy_n(places_.data(), topology.vertex_count, places.data());
    for (std::size_t i = topology.vertex_count; i < on_edges; ++i)
      places[i] = static_cast<std::uint32_t>(i - topology.vertex_count + of_places.vertex_count);
    for_each_item(topology.edge_count, threads(), [&](std::size_t i) {
      places[on_edges + i] =
          vertex_on_edge(of_places, triangles(), of_places.corner_edges[topology.edges[i].corners[0]]);
    });
    return places;
  }

  /// The last step: what vertices have, and the faces' corners.
  void write(MeshData& out) {
    const SubdivisionTopology& topology = topology_of_values();
    const SubdivisionCounts counts = counts_after_step(topology, triangles());
    out.indices = MeshBuffer<std::uint32_t>(counts.corners);
    write_next_faces(topology, triangles(), out.indices.data(), threads());
    LargeArray<std::uint32_t> places;
    if (has_jumps()) {
      places = next_places();
      for (const VertexValues& one : interpolated_)
        out.*one.buffer = MeshBuffer<float>(static_cast<std::size_t>(one.size) * counts.vertices);
      SubdivisionStep(topology, others_.rules, others_.values.data(), others_.kinds, threads())
          .run(!settings_.flat, [&](std::size_t vertex, const SubdivisionStep::Numbers& numbers) {
            const double* from = numbers.data();
            for (const VertexValues& one : interpolated_)
              for (std::size_t k = 0; k < static_cast<std::size_t>(one.size); ++k)
                (out.*one.buffer)[static_cast<std::size_t>(one.size) * vertex + k] = static_cast<float>(*from++);
          });
      others_ = {};
    }
    MeshBuffer<float> of_places(3 * counts_after_step(positions_.topology, triangles()).vertices);
    SubdivisionStep(positions_.topology, positions_.rules, positions_.values.data(), positions_.kinds, threads())
        .run(!settings_.flat, [&](std::size_t vertex, const SubdivisionStep::Numbers& numbers) {
          for (std::size_t k = 0; k < 3; ++k) of_places[3 * vertex + k] = static_cast<float>(numbers[k]);
        });
    positions_ = {};
    if (places.data() == nullptr) {
      out.positions = std::move(of_places);
      return;
    }
    out.positions = MeshBuffer<float>(3 * counts.vertices);
    for_each_item(counts.vertices, threads(), [&](std::size_t i) {
      std::copy_n(&of_places[3 * std::size_t{places[i]}], 3, &out.positions[3 * i]);
    });
  }

  /// The materials and the parts that the finer faces have of those that they are of.
  void write_faces(MeshData& out) const {
    const bool of_three = polygons_.are_triangles();
    const auto each = std::size_t{1} << (2 * static_cast<unsigned>(settings_.levels - (of_three ? 0 : 1)));
    // Where the finer faces of a polygon begin.
    const auto begin = [&](std::size_t polygon) { return each * (of_three ? polygon : polygons_.begins[polygon]); };
    if (!mesh_.face_materials.empty()) {
      out.face_materials = MeshBuffer<std::uint32_t>(begin(polygons_.count()));
      for_each_item(polygons_.count(), threads(), [&](std::size_t i) {
        std::fill_n(out.face_materials.data() + begin(i), begin(i + 1) - begin(i),
                    mesh_.face_materials[polygons_.faces[i]]);
      });
    }
    for (MeshPart& part : out.parts) {
      const auto first = std::lower_bound(polygons_.faces.begin(), polygons_.faces.end(), part.first_face);
      part.first_face = begin(static_cast<std::size_t>(first - polygons_.faces.begin()));
    }
  }

  const MeshData& mesh_;
  const SubdivisionSettings& settings_;
  MeshPolygons polygons_;
  std::vector<VertexValues> interpolated_;
  ValueChannel positions_, others_;
  LargeArray<std::uint32_t> places_;  ///< of each vertex of the others
};

}  // namespace

std::size_t subdivided_faces(const MeshData& mesh, const SubdivisionSettings& settings) {
  // A triangle in a mesh of quads, or of polygons, becomes three at first; as many as its corners, that is.
  bool are_triangles = mesh.continued.empty();
  std::size_t corners = 0;
  for (std::size_t i = 0; i < mesh.face_count(); ++i) {
    const std::uint32_t* const face = &mesh.indices[static_cast<std::size_t>(mesh.corners) * i];
    const bool is_quad = mesh.corners == 4 && face[2] != face[3];
    are_triangles = are_triangles && !is_quad;
    corners += is_quad ? 4 : !mesh.continued.empty() && mesh.continued[i] != 0 ? 1 : 3;
  }
  const auto levels = static_cast<unsigned>(settings.levels);
  std::size_t faces = are_triangles ? mesh.face_count() << 2U * levels : corners << 2U * (levels - 1);
  for (const MeshCopies& copies : mesh.copies) faces += subdivided_faces(*copies.mesh, settings);
  return faces;
}

std::optional<std::string> too_many_subdivisions(const MeshData& mesh, const SubdivisionSettings& settings) {
  const std::size_t faces = subdivided_faces(mesh, settings);
  const std::string made = "would have " + std::to_string(faces) + " faces after " + std::to_string(settings.levels) +
                           (settings.levels == 1 ? " subdivision" : " subdivisions");
  // So that Embree and we can number all that they have.
  constexpr std::size_t most = std::size_t{1} << 28U;
  if (faces > most) return made + "; at most " + std::to_string(most) + " are possible";
  std::size_t numbers = 6;  // positions and normals
  for (const VertexValues& one : values_of(mesh, settings)) numbers += static_cast<std::size_t>(one.size);
  // Each with a vertex, indices and what is needed while it is made; about as much again is what Embree takes.
  const std::size_t bytes = faces * (4 * numbers + 16 + 100), available = available_memory();
  if (bytes <= available / 2) return std::nullopt;
  const auto gigabytes = [](std::size_t of) {
    return std::to_string((of >> 20U) * 10 / 1024 / 10) + "." + std::to_string((of >> 20U) * 10 / 1024 % 10) + " GiB";
  };
  return made + ", which take " + gigabytes(bytes) + "; of " + gigabytes(available) +
         " that are free, half may be used";
}

MeshData subdivided(const MeshData& mesh, const SubdivisionSettings& settings) {
  MeshData out = without_faces(mesh);
  Subdivider(mesh, settings).run(out);
  return out;
}

}  // namespace raytrace
