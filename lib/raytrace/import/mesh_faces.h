// Polygons as faces of a mesh, and what is left out of one.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "raytrace/import/mesh_data.h"
#include "raytrace/xml/diagnostics.h"

namespace raytrace {

/// The polygons in a part of a file, by what becomes of them.
struct FaceCounts {
  std::size_t triangles = 0, quads = 0;
  std::size_t cut = 0;        ///< triangles that polygons of more corners are cut into
  std::size_t too_small = 0;  ///< polygons of less than three corners

  bool operator==(const FaceCounts&) const = default;
  void add(std::size_t corners) {
    if (corners == 3) {
      ++triangles;
    } else if (corners == 4) {
      ++quads;
    } else if (corners > 4) {
      cut += corners - 2;
    } else {
      ++too_small;
    }
  }
  bool any() const { return triangles + quads + cut + too_small > 0; }
  FaceCounts& operator+=(const FaceCounts& more) {
    triangles += more.triangles, quads += more.quads, cut += more.cut, too_small += more.too_small;
    return *this;
  }

  /// Of a mesh with so many of them: 3 or 4.
  int corners() const { return quads > 0 && quads >= triangles + cut ? 4 : 3; }
  std::size_t faces(int corners) const { return triangles + cut + (corners == 4 ? quads : 2 * quads); }
};

/// Of a corner that has no such value.
inline constexpr std::uint32_t no_index = 0xffffffff;

/// Makes one vertex of each combination of position, uv and normal that corners of a mesh's faces have, where the file
/// numbers each of them for itself. uvs, normals: of each corner, indices in the mesh's buffers, or no_index; empty:
/// there are none.
void join_vertices(MeshData& mesh, const MeshBuffer<std::uint32_t>& uvs, const MeshBuffer<std::uint32_t>& normals,
                   int threads);

/// The same of a mesh whose corners have u and v of their own, instead of its vertices.
void join_vertices(MeshData& mesh, const MeshBuffer<float>& uvs, int threads);

/// Allocates the faces of a mesh, as it keeps polygons or not. False, and an error, if they are more than Embree
/// numbers, 2^32 - 1.
bool make_faces(const FaceCounts& counts, MeshData& mesh, Diagnostics& diagnostics);

/// Cuts a polygon of at least three corners into faces of a mesh of triangles or of quads, as read_mesh.h says.
class PolygonCutter {
 public:
  /// positions: of the vertices; corners: of the mesh's faces.
  PolygonCutter(const float* positions, int corners) : positions_(positions), corners_(corners) {}

  /// The corners of the faces, one after the other, as places in `polygon`. They stand until the next call.
  std::span<const std::uint32_t> cut(std::span<const std::uint32_t> polygon);

 private:
  void add(std::uint32_t a, std::uint32_t b, std::uint32_t c);
  void cut_ears(std::span<const std::uint32_t> polygon);
  /// In which corners a polygon turns the other way than it does as a whole; whether there are any.
  bool find_dents(std::span<const std::uint32_t> polygon);

  const float* positions_;
  int corners_;
  std::vector<std::uint32_t> faces_, next_, previous_;
  std::vector<char> dents_;
  std::vector<std::array<double, 2>> plane_;
};

/// Whether a face has no area, since its corners repeat.
inline bool is_degenerate(const std::uint32_t* face, int corners) {
  const auto same = [&](int a, int b, int c) { return face[a] == face[b] || face[b] == face[c] || face[a] == face[c]; };
  return corners == 3 ? same(0, 1, 2) : same(0, 1, 3) && same(2, 3, 1);
}

/// Writes polygons as faces of a mesh, from one of its faces on.
class FaceWriter {
 public:
  FaceWriter(MeshData& mesh, std::size_t first_face)
      : cutter_(mesh.positions.data(), mesh.corners),
        corners_(static_cast<std::size_t>(mesh.corners)),
        indices_(mesh.indices.data()),
        continued_(mesh.continued.empty() ? nullptr : mesh.continued.data()),
        next_(corners_ * first_face) {}

  /// Calls on_corner(i, j) where it writes corner j of the polygon as the mesh's index i.
  template <class OnCorner>
  void add(std::span<const std::uint32_t> polygon, const OnCorner& on_corner) {
    if (polygon.size() < 3) return;
    const std::size_t first = next_;
    static constexpr std::uint32_t triangle[] = {0, 1, 2};
    const bool is_face = polygon.size() == 3 && corners_ == 3;
    for (const std::uint32_t corner : is_face ? std::span<const std::uint32_t>(triangle) : cutter_.cut(polygon)) {
      on_corner(next_, corner);
      indices_[next_++] = polygon[corner];
    }
    if (continued_ != nullptr)
      for (std::size_t i = first; i < next_; i += corners_) continued_[i / corners_] = i > first ? 1 : 0;
    for (std::size_t i = first; i < next_; i += corners_)
      degenerate_ += is_degenerate(indices_ + i, static_cast<int>(corners_)) ? 1U : 0U;
  }
  void add(std::span<const std::uint32_t> polygon) {
    add(polygon, [](std::size_t, std::uint32_t) {});
  }

  /// How many of the faces were.
  std::size_t degenerate() const { return degenerate_; }

 private:
  PolygonCutter cutter_;
  std::size_t corners_;
  std::uint32_t* indices_;
  std::uint8_t* continued_;
  std::size_t next_, degenerate_ = 0;
};

/// Rounds; NaN for what a float cannot have.
inline float rounded(double value) {
  return std::abs(value) <= double{std::numeric_limits<float>::max()} ? static_cast<float>(value)
                                                                      : std::numeric_limits<float>::quiet_NaN();
}
inline float finite_or_zero(float value) { return std::abs(value) <= std::numeric_limits<float>::max() ? value : 0; }

/// An integer of sRGB, from 0 to `most`, as linear.
float srgb_to_linear(double value, double most);

/// Makes x of those of `count` positions NaN that no mesh may have; how many there are.
std::size_t mark_bad_positions(float* positions, std::size_t count);

/// What was counted while the faces of a mesh were written.
struct MeshFaults {
  std::size_t bad_vertices = 0;  ///< of which x is NaN
  std::size_t degenerate_faces = 0;
  std::size_t too_small_polygons = 0;
  std::size_t faces_at_bad_vertices = 0;

  MeshFaults& operator+=(const MeshFaults& other) {
    bad_vertices += other.bad_vertices;
    degenerate_faces += other.degenerate_faces;
    too_small_polygons += other.too_small_polygons;
    faces_at_bad_vertices += other.faces_at_bad_vertices;
    return *this;
  }
};

/// Takes all away where they say nothing, since all are 1.
void leave_out_ones(MeshBuffer<float>& alphas);

/// Leaves out the faces that are degenerate or at bad vertices, counts them, and moves those vertices to the origin.
void leave_out_faults(MeshData& mesh, MeshFaults& faults);
/// As warnings.
void report_faults(const MeshFaults& faults, Diagnostics& diagnostics);

/// Leaves out what read_mesh.h says, with warnings, and moves bad vertices to the origin. dented_quads: whether quads
/// may still have to start with another corner. False, and an error, if no face is left.
bool finish_mesh(MeshData& mesh, MeshFaults faults, bool dented_quads, int threads, Diagnostics& diagnostics);

}  // namespace raytrace
