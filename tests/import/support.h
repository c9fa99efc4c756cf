// Mesh files that tests write, and what the readers say of them.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <sstream>
#include <string>
#include <vector>

#include "raytrace/import/read_mesh.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

struct ReadResult {
  std::optional<MeshData> mesh;
  std::string messages;
};

inline std::string printed(const Diagnostics& diagnostics, const std::string& folder) {
  std::ostringstream out;
  diagnostics.print(out);
  std::string text = out.str();
  for (std::size_t at = text.find(folder); at != std::string::npos; at = text.find(folder))
    text.erase(at, folder.size() + 1);
  return text;
}

/// Reads a file with these bytes; messages name it without its folder.
inline ReadResult read_bytes(const std::string& name, const std::string& bytes, const MeshReadSettings& settings = {}) {
  const TemporaryFolder folder;
  write_text(folder.file(name), bytes);
  Diagnostics diagnostics(folder.file(name));
  ReadResult result;
  result.mesh = read_mesh(folder.file(name), settings, diagnostics);
  result.messages = printed(diagnostics, folder.path().string());
  return result;
}

/// Reads a file with these bytes, which may be damaged. True: it was read, and the mesh is sound; false: an error says
/// why not. The file stays.
inline bool is_read_or_refused(const std::string& file, const std::string& bytes, MeshReadSettings settings = {}) {
  write_text(file, bytes);
  settings.threads = 1;
  Diagnostics diagnostics(file);
  const auto mesh = read_mesh(file, settings, diagnostics);
  REQUIRE(mesh.has_value() == !diagnostics.has_errors());
  if (!mesh) return false;
  for (const std::uint32_t index : mesh->indices) REQUIRE(index < mesh->vertex_count());
  for (const float value : mesh->positions) REQUIRE(std::abs(value) <= 1e18F);
  return true;
}

template <class T>
std::vector<T> values(const MeshBuffer<T>& buffer) {
  return {buffer.begin(), buffer.end()};
}

/// The bytes of a value in that order.
template <class T>
std::string bytes_of_value(T value, bool big_endian = false) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  if (big_endian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

/// So that the messages of a failed test have both.
inline bool same_mesh(const MeshData& a, const MeshData& b) {
  return a.corners == b.corners && values(a.positions) == values(b.positions) &&
         values(a.indices) == values(b.indices) && values(a.normals) == values(b.normals) &&
         values(a.uvs) == values(b.uvs) && values(a.uvs2) == values(b.uvs2) && values(a.colors) == values(b.colors) &&
         values(a.alphas) == values(b.alphas) && values(a.tangents) == values(b.tangents) &&
         values(a.face_materials) == values(b.face_materials);
}

}  // namespace raytrace::test
