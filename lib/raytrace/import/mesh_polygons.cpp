#include <algorithm>
#include <array>
#include <map>
#include <span>

#include "raytrace/import/subdivision_topology.h"

namespace raytrace {

namespace {

class PolygonCollector {
 public:
  explicit PolygonCollector(const MeshData& mesh) : mesh_(mesh), corners_(static_cast<std::size_t>(mesh.corners)) {}

  MeshPolygons collect() {
    const std::size_t faces = mesh_.face_count();
    polygons_.begins.reserve(faces + 1);
    polygons_.begins.push_back(0);
    polygons_.vertices.reserve(mesh_.indices.size());
    polygons_.faces.reserve(faces);
    std::size_t next_part = 0;
    for (std::size_t face = 0, end = 0; face < faces; face = end) {
      for (; next_part < mesh_.parts.size() && mesh_.parts[next_part].first_face <= face; ++next_part)
        part_ = static_cast<std::uint32_t>(next_part);
      end = face + 1;
      while (end < faces && !mesh_.continued.empty() && mesh_.continued[end] != 0) ++end;
      if (end - face > 1 && join(face, end)) {
        add(polygon_, face);
        continue;
      }
      for (std::size_t i = face; i < end; ++i) add({&mesh_.indices[corners_ * i], corners_}, i);
    }
    return std::move(polygons_);
  }

 private:
  bool at_one_place(std::uint32_t a, std::uint32_t b) const {
    return a == b || std::equal(&mesh_.positions[3 * std::size_t{a}], &mesh_.positions[3 * std::size_t{a}] + 3,
                                &mesh_.positions[3 * std::size_t{b}]);
  }

  /// Less corners that are in the place of the one before.
  void add(std::span<const std::uint32_t> corners, std::size_t face) {
    const std::size_t first = polygons_.vertices.size();
    for (const std::uint32_t vertex : corners)
      if (polygons_.vertices.size() == first || !at_one_place(polygons_.vertices.back(), vertex))
        polygons_.vertices.push_back(vertex);
    while (polygons_.vertices.size() > first + 1 && at_one_place(polygons_.vertices.back(), polygons_.vertices[first]))
      polygons_.vertices.pop_back();
    if (polygons_.vertices.size() < first + 3) {
      polygons_.vertices.resize(first);
      return;
    }
    polygons_.begins.push_back(static_cast<std::uint32_t>(polygons_.vertices.size()));
    polygons_.faces.push_back(static_cast<std::uint32_t>(face));
    if (!mesh_.parts.empty()) polygons_.parts.push_back(part_);
  }

  /// Puts the polygon together that triangles were cut from: its edges are those that one of them has. False where they
  /// are no single ring, since triangles of it were left out or its corners repeat.
  bool join(std::size_t face, std::size_t end) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (std::size_t i = face; i < end; ++i) {
      const std::uint32_t* const triangle = &mesh_.indices[corners_ * i];
      for (std::size_t k = 0; k < 3; ++k) ++edges[{triangle[k], triangle[(k + 1) % 3]}];
    }
    std::map<std::uint32_t, std::uint32_t> after;
    for (const auto& [edge, count] : edges) {
      if (count > 1) return false;
      if (edges.contains({edge.second, edge.first})) continue;
      if (!after.try_emplace(edge.first, edge.second).second) return false;
    }
    polygon_.clear();
    const std::uint32_t first = mesh_.indices[corners_ * face];
    std::uint32_t vertex = first;
    do {
      const auto next = after.find(vertex);
      if (next == after.end() || polygon_.size() == after.size()) return false;
      polygon_.push_back(vertex);
      vertex = next->second;
    } while (vertex != first);
    return polygon_.size() == after.size() && polygon_.size() == end - face + 2;
  }

  const MeshData& mesh_;
  std::size_t corners_;
  MeshPolygons polygons_;
  std::uint32_t part_ = 0;
  std::vector<std::uint32_t> polygon_;
};

}  // namespace

MeshPolygons polygons_of(const MeshData& mesh) { return PolygonCollector(mesh).collect(); }

}  // namespace raytrace
