// EXT_meshopt_compression and KHR_meshopt_compression: buffer views of a glTF file that are compressed by
// meshoptimizer. Inside of read_gltf().
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "raytrace/import/gltf_json.h"

namespace raytrace::gltf {

bool is_meshopt_extension(std::string_view name);
/// The library and its version; empty: it is not there.
std::string meshopt_version();
inline bool can_read_meshopt() { return !meshopt_version().empty(); }

/// How a buffer view is compressed.
struct MeshoptLayout {
  enum class Mode { attributes, triangles, indices };
  enum class Filter { none, octahedral, quaternion, exponential, color };

  Item compressed;  ///< what the view has of the extension: the bytes' place, as a buffer view has it
  std::size_t count = 0, stride = 0;
  Mode mode = Mode::attributes;
  Filter filter = Filter::none;

  std::size_t size() const { return count * stride; }
};

/// None: the view is not compressed, or the library is not there. Throws Error.
std::optional<MeshoptLayout> meshopt_layout(const Item& view);

/// So many bytes as the layout has. Throws Error.
std::string meshopt_decoded(const MeshoptLayout& layout, std::string_view bytes);

}  // namespace raytrace::gltf
