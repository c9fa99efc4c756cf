// Whether a mesh is closed.
#pragma once

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include "raytrace/import/mesh_data.h"

namespace raytrace::test {

/// How many edges have so many faces; edges are the same whose ends are in the same places, to the bit.
inline std::map<int, int> edges_by_faces(const MeshData& mesh) {
  using Place = std::tuple<float, float, float>;
  std::map<std::pair<Place, Place>, int> faces;
  const auto corners = static_cast<std::size_t>(mesh.corners);
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const std::size_t next = i % corners + 1 < corners ? i + 1 : i + 1 - corners;
    const auto place = [&](std::size_t at) {
      const float* const p = &mesh.positions[3 * std::size_t{mesh.indices[at]}];
      return Place(p[0], p[1], p[2]);
    };
    const Place a = place(i), b = place(next);
    ++faces[{std::min(a, b), std::max(a, b)}];
  }
  std::map<int, int> counts;
  for (const auto& [edge, count] : faces) ++counts[count];
  return counts;
}

}  // namespace raytrace::test
