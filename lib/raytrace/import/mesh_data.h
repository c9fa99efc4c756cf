// A mesh of triangles or quads, in buffers that Embree can share (rtcSetSharedGeometryBuffer). Readers of files make
// it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "raytrace/math/affine.h"
#include "raytrace/math/color.h"
#include "raytrace/math/vec3.h"
#include "raytrace/memory/large_array.h"

namespace raytrace {

/// So many values, and 16 bytes behind them that may be read, as Embree asks of buffers that it shares.
template <class T>
class MeshBuffer {
 public:
  MeshBuffer() = default;
  /// Of values that are to be written before they are read. Throws std::bad_alloc.
  explicit MeshBuffer(std::size_t size) : values_(LargeArray<T>::unset(size + padding / sizeof(T))), size_(size) {
    std::memset(values_.data() + size, 0, padding);
  }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* data() { return values_.data(); }
  const T* data() const { return values_.data(); }
  T& operator[](std::size_t i) { return values_[i]; }
  const T& operator[](std::size_t i) const { return values_[i]; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }

  /// Leaves out the last ones.
  void shorten_to(std::size_t size) { size_ = size; }

 private:
  static constexpr std::size_t padding = 16;

  LargeArray<T> values_;
  std::size_t size_ = 0;
};

struct SpecularGlossiness;  // import/specular_glossiness.h

/// An image that a material names.
struct MeshTexture {
  enum class Edge { repeat, mirror, clamp };

  std::string file;  ///< as in the file, with '/' between folders; empty: none
  std::array<double, 2> scale{1, 1}, offset{0, 0};
  double rotation = 0;                       ///< in degrees, from u to v, between both
  double value_scale = 1, value_offset = 0;  ///< of what is in the picture
  double strength = 1;                       ///< of a normal map
  bool alpha = false;                        ///< of an opacity: that it is its alpha, which is 1 where it has none
  bool by_vertices = false;                  ///< of an opacity: the vertices' alphas multiply it, before value_scale
  Edge edge_u = Edge::repeat, edge_v = Edge::repeat;  ///< what is beyond
  bool nearest = false;                               ///< its pixels are seen as such from near by
  bool by_uvs2 = false;                               ///< it is placed by the mesh's second texture coordinates
  bool srgb = false;                                  ///< its colours are sRGB's, whatever the picture's depth
  /// The picture's file, where it is within the model's; `file` is then a name for messages.
  std::shared_ptr<const std::string> bytes{};
  /// Pictures that it follows from, pixel by pixel; `file` is then one of them, and for messages.
  std::shared_ptr<const SpecularGlossiness> made_of{};
};

/// A parameter of an OpenPBR material.
struct MeshParameter {
  std::string_view name;       ///< OpenPBR's
  Rgb<double> value{1, 1, 1};  ///< a number's is red
  MeshTexture texture{};       ///< multiplies it
  int channel = 0;             ///< of it, for a number: red, green, blue or alpha
  bool of_vertices = false;    ///< colours of vertices multiply it, if there are any
};

/// A material: of an OpenPBR's parameters, if it has any, or by the names of Wavefront's MTL, where no value says that
/// the file does not say. Opacity and normals are MTL's for both.
struct MeshMaterial {
  std::string name;
  std::vector<MeshParameter> openpbr{};
  bool thin_walled = false;
  std::optional<Rgb<double>> kd, ks, ke, tf;
  std::optional<double> ns, d, ni, pr, pm, ps, pc, pcr, aniso;
  std::optional<int> illum;
  bool vertex_colors = false;  ///< multiply kd
  MeshTexture map_kd, map_ke, map_d, map_pr, map_pm, norm;
  MeshTexture map_bump;  ///< normals, or heights of no known size
};

/// A camera that the mesh's file has, in the file's space.
struct FileCamera {
  std::string name;  ///< may be empty
  Vec3d eye{}, forward{0, 0, -1}, up{0, 1, 0};
  double angle = 0;   ///< of view, upright, in radians; 0: it is orthographic,
  double height = 0;  ///< and shows so much from the picture's lower edge to its upper one
  double aspect = 0;  ///< the picture's width by its height; 0: the file does not say
};

/// A light that it has.
struct FileLight {
  enum class Kind { point, spot, directional };
  std::string name;
  Kind kind = Kind::point;
  Vec3d position{}, direction{0, 0, -1};                       ///< direction: into which it shines
  Rgb<double> intensity{1, 1, 1};                              ///< in candela; of a directional one, in lux
  double inner_angle = 0, outer_angle = std::numbers::pi / 4;  ///< a spot's, from the axis, in radians
};

/// What the file has as an object of its own: faces from one on, up to the next part's.
struct MeshPart {
  std::string name;
  std::size_t first_face;
};

struct MeshData;

/// Faces that a file has at many places, kept once.
struct MeshCopies {
  struct Place {
    Affine affine;           ///< to the file's space
    std::uint32_t part = 0;  ///< of those of the mesh that the copies are of, if it has any
  };

  /// In a space of its own, and with faces. It has no materials, parts or copies: those of the other mesh are meant.
  std::shared_ptr<const MeshData> mesh;
  std::vector<Place> places;
};

struct MeshData {
  static constexpr std::uint32_t no_material = 0xffffffff;

  Vec3d origin{0, 0, 0};  ///< the file's point that is (0, 0, 0) in the positions

  /// x, y, z of each vertex, less the origin. All are finite, and at most 1e18 in magnitude.
  MeshBuffer<float> positions;
  /// `corners` vertices of each face, in the order of the file. A triangle in a mesh of quads repeats its last vertex.
  MeshBuffer<std::uint32_t> indices;
  int corners = 3;  ///< 3 or 4
  /// While a file is read: that a mesh with any larger polygons than triangles is one of quads, and has what follows.
  bool keeps_polygons = false;
  /// Of each face, whether it is a triangle of one polygon with the face before. Empty: none is, or nothing wants it.
  MeshBuffer<std::uint8_t> continued;

  // Of each vertex; empty where the file has none.
  MeshBuffer<float> normals;  ///< three numbers, not normalized; 0 0 0 where that vertex has none
  MeshBuffer<float> uvs;      ///< two numbers; (0, 0) is the lower left of an image
  MeshBuffer<float> uvs2;     ///< a second set of such
  MeshBuffer<float> colors;   ///< linear red, green and blue
  MeshBuffer<float> alphas;  ///< one number, what colours have beside them; empty where all are 1 or nothing wants them
  /// The directions in which u grows where the material's normal map is looked up, and 1, or -1 where v grows against
  /// normal x tangent; 0 0 0 0 where that vertex has none.
  MeshBuffer<float> tangents;

  /// Of each face its material, or no_material. Empty: all have the first material, or none if there is none.
  MeshBuffer<std::uint32_t> face_materials;
  std::vector<MeshMaterial> materials;
  /// In the order of their faces, of which the first is 0. Empty: the file does not have two or more.
  std::vector<MeshPart> parts;
  /// Beside its own faces, of which there is at least one.
  std::vector<MeshCopies> copies;

  // In the order of the file's nodes; not part of the mesh.
  std::vector<FileCamera> cameras;
  std::vector<FileLight> lights;
  /// The time of the last key of the animation that was asked for, or 0. None: the file has no animations.
  std::optional<double> animation_end{};
  /// Others that were read with it: material libraries, buffers.
  std::vector<std::string> files{};

  std::size_t vertex_count() const { return positions.size() / 3; }
  std::size_t face_count() const { return indices.size() / static_cast<std::size_t>(corners); }
};

/// What a mesh that is made of that one's faces has of it: all but these, their vertices, and copies.
inline MeshData without_faces(const MeshData& mesh) {
  MeshData rest;
  rest.origin = mesh.origin;
  rest.materials = mesh.materials;
  rest.parts = mesh.parts;
  rest.cameras = mesh.cameras;
  rest.lights = mesh.lights;
  rest.animation_end = mesh.animation_end;
  rest.files = mesh.files;
  return rest;
}

/// Points with perhaps a radius and a colour each.
struct PointCloud {
  Vec3d origin{0, 0, 0};        ///< as a mesh's
  MeshBuffer<float> positions;  ///< as a mesh's
  MeshBuffer<float> radii;      ///< as sizes in scenes may be; empty where the file has none
  MeshBuffer<float> colors;     ///< as a mesh's

  std::size_t size() const { return positions.size() / 3; }
};

}  // namespace raytrace
