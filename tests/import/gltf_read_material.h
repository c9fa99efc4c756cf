// A material of a glTF file, as it is read.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "import/support.h"
#include "raytrace/materials/openpbr.h"
#include "support/catch.h"
#include "support/gltf.h"

namespace raytrace::test {

/// What becomes of a material, in a file with textures 0 to 3.
struct ReadMaterial {
  MeshMaterial material;
  std::string messages;

  explicit ReadMaterial(const std::string& members) {
    GltfFile file;
    file.add(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 5126, 3);
    std::string images, textures;
    for (const char* const number : {"0", "1", "2", "3"}) {
      images += std::string(images.empty() ? "" : ",") + R"({"uri":")" + number + R"(.png"})";
      textures += std::string(textures.empty() ? "" : ",") + R"({"source":)" + number + "}";
    }
    const ReadResult read = read_bytes(
        "a.gltf",
        file.text(
            R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},
            "material":0}]}],"images":[)" +
            images + R"(],"textures":[)" + textures + R"(],"materials":[{)" + members + "}]"));
    messages = read.messages;
    if (read.mesh) material = read.mesh->materials.at(0);
    // The names are those of fields.
    const Fields fields = OpenPbr::fields();
    for (const MeshParameter& parameter : material.openpbr)
      CHECK(std::any_of(fields.begin(), fields.end(), [&](const Field& f) { return f.name == parameter.name; }));
  }
  const MeshParameter* find(std::string_view name) const {
    for (const MeshParameter& parameter : material.openpbr)
      if (parameter.name == name) return &parameter;
    return nullptr;
  }
  const MeshParameter& at(std::string_view name) const {
    INFO(messages << ": " << name);
    const MeshParameter* const found = find(name);
    REQUIRE(found);
    return *found;
  }
  double number(std::string_view name) const { return at(name).value.red; }
};

inline std::string extended(const std::string& name, const std::string& members) {
  return R"("extensions":{"KHR_materials_)" + name + R"(":{)" + members + "}}";
}

}  // namespace raytrace::test
