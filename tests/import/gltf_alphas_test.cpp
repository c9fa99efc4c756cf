// The alphas of a glTF file's vertex colours: kept where a material of the file shows them, or one of the scene asks.
#include <cstdint>

#include "import/gltf_square.h"

namespace raytrace::test {
namespace {

/// A square of two primitives with those colours, accessor 2; of the materials 0 and 1.
ReadResult read_colored(GltfFile file, const std::string& materials, bool for_scene = false,
                        const std::string& more_of_second = {}) {
  const auto one = [](const std::string& members) {
    return R"({"attributes":{"POSITION":0,"COLOR_0":2},"indices":1)" + members + "}";
  };
  MeshReadSettings settings;
  settings.vertex_alphas = for_scene;
  return read_bytes(
      "a.gltf",
      file.text(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[)" + one(R"(,"material":0)") +
                ',' + one(R"(,"material":1)" + more_of_second) + R"(]}],"materials":[)" + materials + "]"),
      settings);
}

GltfFile with_bytes(std::uint8_t alpha) {
  return test::square().add(std::vector<std::uint8_t>{255, 0, 51, 255, 0, 0, 0, 255, 0, 0, 0, alpha, 0, 0, 0, 0},
                            "VEC4", 5121, 4, R"(,"normalized":true)");
}

const std::string opaque = R"({"name":"wall"})", blend = R"({"alphaMode":"BLEND"})", mask = R"({"alphaMode":"MASK"})";

}  // namespace

TEST_CASE("the alphas of a glTF file's vertex colours are kept where a material shows them") {
  const Numbers wanted{1, 1, 0.2F, 0};
  for (const std::string& shown : {blend, mask}) {
    // Vertices that two materials share are there once, with their alphas, whichever comes first.
    for (const std::string& materials : {opaque + ',' + shown, shown + ',' + opaque}) {
      INFO(materials);
      const ReadResult read = read_colored(with_bytes(51), materials);
      CHECK(read.messages.empty());
      REQUIRE(read.mesh);
      CHECK(values(read.mesh->alphas) == wanted);
      CHECK(read.mesh->colors.size() == 12);
      for (const MeshMaterial& material : read.mesh->materials)
        CHECK(material.map_d.by_vertices == (material.name != "wall"));
    }
  }
  const ReadResult unused = read_colored(with_bytes(51), opaque + ',' + opaque);
  REQUIRE(unused.mesh);
  CHECK(unused.mesh->alphas.empty());
  CHECK(unused.mesh->colors.size() == 12);
  const ReadResult asked = read_colored(with_bytes(51), opaque + ',' + opaque, true);
  REQUIRE(asked.mesh);
  CHECK(values(asked.mesh->alphas) == wanted);
  for (const MeshMaterial& material : asked.mesh->materials) CHECK_FALSE(material.map_d.by_vertices);
}

TEST_CASE(
    "alphas of floats, of bytes and shorts, and of sparse accessors are the same; where all are 1 there are none") {
  const auto alphas = [](const GltfFile& file) {
    const ReadResult read = read_colored(file, blend + ',' + opaque);
    INFO(read.messages);
    REQUIRE(read.mesh);
    CHECK(read.mesh->materials[0].map_d.by_vertices == !read.mesh->alphas.empty());
    return values(read.mesh->alphas);
  };
  const Numbers wanted{1, 0.2F, 0, 1};
  CHECK(alphas(test::square().add(Numbers{1, 0, 1, 7, 0, 0, 0, 0.2F, 0, 0, 0, -3, 0, 0, 0, 1}, "VEC4", float_type,
                                  4)) == wanted);  // none is beyond 0 or 1
  CHECK(alphas(test::square().add(std::vector<std::uint8_t>{9, 9, 9, 255, 9, 9, 9, 51, 9, 9, 9, 0, 9, 9, 9, 255},
                                  "VEC4", 5121, 4, R"(,"normalized":true)")) == wanted);
  CHECK(
      alphas(test::square().add(std::vector<std::uint16_t>{9, 9, 9, 65535, 9, 9, 9, 13107, 9, 9, 9, 0, 9, 9, 9, 65535},
                                "VEC4", 5123, 4, R"(,"normalized":true)")) == wanted);
  GltfFile sparse = test::square();
  sparse.add_view(bytes_of(Numbers{1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}));
  sparse.add_view(bytes_of(std::vector<std::uint16_t>{1, 2}));
  sparse.add_view(bytes_of(Numbers{1, 1, 1, 0.2F, 1, 1, 1, 0}));
  sparse.add_accessor(
      R"({"bufferView":2,"type":"VEC4","componentType":5126,"count":4,"sparse":{"count":2,
          "indices":{"bufferView":3,"componentType":5123},"values":{"bufferView":4}}})");
  CHECK(alphas(sparse) == wanted);
  CHECK(alphas(test::square().add(Numbers{1, 1, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC4", float_type, 4))
            .empty());
  CHECK(alphas(test::square().add(Numbers{1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0}, "VEC3", float_type, 4)).empty());
}

TEST_CASE("what has no colours in a glTF file has an alpha of 1, beside what has some") {
  GltfFile file = with_bytes(51);
  const ReadResult read =
      read_bytes("a.gltf", file.text(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":[
        {"attributes":{"POSITION":0},"indices":1},{"attributes":{"POSITION":0,"COLOR_0":2},"indices":1,"material":0}]}],
        "materials":[)" + blend + "]"));
  REQUIRE(read.mesh);
  CHECK(values(read.mesh->alphas) == Numbers{1, 1, 1, 1, 1, 1, 0.2F, 0});
}

TEST_CASE("glTF: a mask's cutoff is one of the product with the alphas of vertices") {
  const auto material = [](const std::string& of) {
    const ReadResult read = read_colored(with_bytes(51), of + ',' + opaque);
    REQUIRE(read.mesh);
    return read.mesh->materials[0];
  };
  const MeshMaterial bare =
      material(R"({"alphaMode":"MASK","alphaCutoff":0.3,"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5]}})");
  CHECK(bare.d == 1);  // where no alphas count, it is beyond the cutoff
  CHECK(bare.map_d.value_scale * 0.3 / 0.5 + bare.map_d.value_offset == Approx(0.5));
  const MeshMaterial veil = material(R"({"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.5]}})");
  CHECK(veil.d == 0.5);
  CHECK(veil.map_d.value_scale == 1);
}

}  // namespace raytrace::test
