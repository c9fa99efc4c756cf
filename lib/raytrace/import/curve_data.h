// Strands of hair, fur or grass: as a file has them, and as they are rendered.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "raytrace/import/mesh_data.h"

namespace raytrace {

/// Points that curves are made of.
struct Strands {
  Vec3d origin{0, 0, 0};            ///< as a mesh's
  MeshBuffer<float> positions;      ///< as a mesh's
  MeshBuffer<float> radii;          ///< of each point, at least 0; empty where the file has none
  MeshBuffer<float> colors;         ///< as a mesh's
  std::vector<std::uint32_t> ends;  ///< of each strand, among the points; each has at least two

  std::size_t size() const { return positions.size() / 3; }
};

/// Strands of straight pieces: from each point to the next one of its strand.
struct CurveData {
  Vec3d origin{0, 0, 0};     ///< as a mesh's
  MeshBuffer<float> points;  ///< x, y, z, as a mesh's positions, and the radius of each, which is at least 0
  /// Of each point, how far it is along its strand: 0 at the root, 1 at the tip, growing in between. Each strand has at
  /// least two, none of which lies where the one before does.
  MeshBuffer<float> along;
  MeshBuffer<float> colors;  ///< of each point, as a mesh's
  bool is_smooth = true;     ///< whether the pieces stand for a curve without corners

  std::size_t size() const { return along.size(); }
};

}  // namespace raytrace
