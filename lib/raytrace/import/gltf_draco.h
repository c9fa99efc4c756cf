// KHR_draco_mesh_compression: primitives of a glTF file that are compressed by Draco. Inside of read_gltf().
#pragma once

#include <functional>
#include <map>
#include <string>

#include "raytrace/import/gltf_document.h"

namespace raytrace::gltf {

inline constexpr const char* draco_extension = "KHR_draco_mesh_compression";
/// The library and its version; empty: it is not there.
std::string draco_version();
inline bool can_read_draco() { return !draco_version().empty(); }

/// What a primitive's compressed mesh has.
struct DracoPrimitive {
  std::map<std::string, Accessor, std::less<>> attributes;  ///< by their names
  Accessor indices;                                         ///< of triangles
};

/// Decodes each of them once, though several primitives may name it.
class DracoReader {
 public:
  explicit DracoReader(Document& document) : document_(document) {}

  /// extension: the primitive's. What is returned lives as long as this, and what it points into as long as the
  /// document. Throws Error.
  const DracoPrimitive& read(const Item& primitive, const Item& extension);

 private:
  Document& document_;
  std::map<std::string, DracoPrimitive> known_;
};

}  // namespace raytrace::gltf
