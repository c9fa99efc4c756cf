// A square as a glTF file, for tests of what else such files say.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "import/support.h"
#include "support/catch.h"
#include "support/gltf.h"

namespace raytrace::test {

using Corners = std::vector<std::uint32_t>;
using Numbers = std::vector<float>;
inline constexpr int float_type = 5126;

/// One node, and one mesh of one primitive.
inline std::string primitive(const std::string& members) {
  return R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{)" + members + "}]}]";
}

/// A unit square: positions 0, indices 1.
inline GltfFile square() {
  GltfFile file;
  file.add(Numbers{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", float_type, 4);
  file.add(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR", 5123, 6);
  return file;
}
inline const std::string of_square = primitive(R"("attributes":{"POSITION":0},"indices":1)");

inline std::string square_with(const std::string& members) {
  return square().text(R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)" + members);
}

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

inline Corners corners_of(const std::string& bytes) {
  const ReadResult read = read_bytes("a.gltf", bytes);
  INFO(read.messages);
  REQUIRE(read.mesh);
  return values(read.mesh->indices);
}

}  // namespace raytrace::test
