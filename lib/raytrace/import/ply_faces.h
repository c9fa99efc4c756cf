// The faces of a PLY file, and what they have beside their vertices. Inside of the reader: programs include
// read_mesh.h.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "raytrace/import/mesh_faces.h"
#include "raytrace/import/ply_header.h"

namespace raytrace::ply {

/// What is read of the elements `face`, by their properties.
struct FaceColumns {
  std::size_t vertices = 0;              ///< a list of vertices
  std::optional<std::size_t> uvs{};      ///< a list of u and v of each corner
  std::optional<std::size_t> texture{};  ///< the number of its texture
};

/// What faces have beside their vertices: of each corner of the mesh's faces its u and v, and of each face its texture,
/// or MeshData::no_material. Empty where the file has none.
struct FaceValues {
  MeshBuffer<float> uvs;
  MeshBuffer<std::uint32_t> textures;
  std::size_t other_counts = 0;  ///< faces that have not two numbers for each corner, whose u and v are 0

  void allocate(const FaceColumns& columns, const MeshData& mesh) {
    if (columns.uvs) uvs = MeshBuffer<float>(2 * mesh.indices.size());
    if (columns.texture) textures = MeshBuffer<std::uint32_t>(mesh.face_count());
  }
  void set_texture(std::size_t face, double number) {
    textures[face] = number >= 0 && number < 0x1p31 ? static_cast<std::uint32_t>(number) : MeshData::no_material;
  }
};

/// Writes the faces of a part of a file.
class FaceValuesWriter {
 public:
  FaceValuesWriter(MeshData& mesh, std::size_t first_face, FaceValues& values)
      : faces_(mesh, first_face), corners_(static_cast<std::size_t>(mesh.corners)), values_(values) {}

  /// One face's, before add().
  std::vector<std::uint32_t> polygon;
  std::vector<float> uvs;
  double texture = -1;

  void clear() {
    polygon.clear();
    uvs.clear();
    texture = -1;
  }
  void add() {
    const bool has_uvs = uvs.size() == 2 * polygon.size();
    if (!values_.uvs.empty() && !has_uvs && polygon.size() >= 3) ++other_counts_;
    faces_.add(polygon, [&](std::size_t out, std::uint32_t local) {
      for (std::size_t k = 0; k < 2 && !values_.uvs.empty(); ++k)
        values_.uvs[2 * out + k] = has_uvs ? uvs[2 * std::size_t{local} + k] : 0;
      if (!values_.textures.empty()) values_.set_texture(out / corners_, texture);
    });
  }
  std::size_t degenerate() const { return faces_.degenerate(); }
  std::size_t other_counts() const { return other_counts_; }

 private:
  FaceWriter faces_;
  std::size_t corners_;
  FaceValues& values_;
  std::size_t other_counts_ = 0;
};

/// An element's rows, all of one length.
struct FixedRows {
  std::size_t start = 0, count = 0, length = 0;
  std::vector<std::size_t> offsets;       ///< of properties in a row, of a list's count
  std::vector<std::int64_t> list_counts;  ///< of each property; 0 where it is no list
};

/// Of faces that have all the same number of corners.
struct FixedFaces {
  const Element& element;
  const FixedRows& rows;
  const FaceColumns& columns;
  bool big_endian;
};

/// Whether lists of so many faces, whose rows' bytes these are, are as long as those of the rows.
bool have_same_lists(const FixedFaces& faces, const char* bytes, std::size_t count);

/// Of so many faces from `first` on, whose rows' bytes these are.
void read_fixed_values(const FixedFaces& faces, const char* bytes, std::size_t first, std::size_t count,
                       FaceValues& values);

}  // namespace raytrace::ply
