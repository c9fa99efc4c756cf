// libFuzzer target: any bytes as a mesh file. The first byte says of which type, and of glTF at which time of its
// animation; they are read without a crash, a hang, a report of a sanitizer, or memory that follows from a claim. What
// is read can be rendered: indices are of vertices.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "fuzz/require.h"
#include "raytrace/import/read_mesh.h"
#include "support/temporary_folder.h"

namespace {

using namespace raytrace;

/// In memory where the system has such a folder.
const test::TemporaryFolder& work_folder() {
  static const test::TemporaryFolder folder = [] {
    if (std::filesystem::is_directory("/dev/shm")) setenv("TMPDIR", "/dev/shm", 1);
    return test::TemporaryFolder();
  }();
  return folder;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  static const char* const names[] = {"a.ply", "a.obj", "a.stl", "a.ply.gz", "a.mtl", "a.gltf", "a.glb"};
  const std::string name = names[data[0] % std::size(names)];
  const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  test::write_text(work_folder().file(name), bytes);
  std::string file = work_folder().file(name);
  if (name == "a.mtl") {
    file = work_folder().file("library.obj");
    test::write_text(file, "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
  }
  MeshReadSettings settings;
  settings.threads = 1;
  const bool is_gltf = name == "a.gltf" || name == "a.glb";
  const std::size_t moment = data[0] / std::size(names);
  if (is_gltf) settings.animation = "0";
  settings.vertex_alphas = moment % 3 != 0;
  settings.time = 0.25 * static_cast<double>(moment);
  if (is_gltf && moment % 2 == 0) settings.variant = "0";
  Diagnostics diagnostics(file);
  const auto mesh = read_mesh(file, settings, diagnostics);
  require(mesh.has_value() == !diagnostics.has_errors(), "refused without an error, or read with one\n");
  if (mesh) {
    for (const std::uint32_t index : mesh->indices)
      require(index < mesh->vertex_count(), "an index without a vertex\n");
    for (const float value : mesh->positions) require(std::abs(value) <= 1e18F, "a position that is not finite\n");
  }
  if (name == "a.ply") {
    Diagnostics of_cloud(file);
    const auto cloud = read_point_cloud(file, settings, of_cloud);
    require(cloud.has_value() == !of_cloud.has_errors(), "points refused without an error\n");
  }
  return 0;
}
