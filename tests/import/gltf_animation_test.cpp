// glTF's animations, skins, morph targets, instances and material variants.
#include "raytrace/import/gltf_animation.h"

#include <numbers>
#include <random>

#include "import/support.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/gltf.h"

using namespace raytrace;
using namespace raytrace::test;

namespace {

using Numbers = std::vector<float>;
constexpr int floats = 5126;
const float half_root = std::sqrt(0.5F);

/// A triangle of positions 0, with an inner product of nothing else.
GltfFile triangle() {
  GltfFile file;
  file.add(Numbers{0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", floats, 3);
  return file;
}
const std::string mesh_of_triangle = R"("meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}])";

std::string animation(const std::string& sampler, const std::string& path, const std::string& name = "walk") {
  return R"({"name":")" + name + R"(","samplers":[{)" + sampler +
         R"(}],"channels":[{"sampler":0,"target":{"node":0,"path":")" + path + R"("}}]})";
}
std::string animated(const std::string& sampler, const std::string& path) {
  return R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)" + mesh_of_triangle + R"(,"animations":[)" +
         animation(sampler, path) + "]";
}

MeshReadSettings at(double time, const std::string& name = "walk") {
  MeshReadSettings settings;
  settings.animation = name;
  settings.time = time;
  return settings;
}

/// The position of a vertex.
Vec3d vertex(const std::string& bytes, const MeshReadSettings& settings, std::size_t i) {
  const ReadResult read = read_bytes("a.gltf", bytes, settings);
  INFO(read.messages);
  REQUIRE(read.mesh);
  REQUIRE(i < read.mesh->vertex_count());
  const float* const p = &read.mesh->positions[3 * i];
  return {double{p[0]}, double{p[1]}, double{p[2]}};
}
bool near_to(const Vec3d& a, const Vec3d& b) { return length(a - b) < 1e-6; }

std::string swapped(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return text.replace(at, what.size(), by);
}

}  // namespace

TEST_CASE("between two turns, glTF's nodes turn evenly") {
  // From none to a quarter about z, of which the third key has the negative.
  GltfFile file = triangle();
  file.add(Numbers{1, 3, 4}, "SCALAR", floats, 3);
  file.add(Numbers{0, 0, 0, 2, 0, 0, half_root, half_root, 0, 0, -half_root, -half_root}, "VEC4", floats, 3);
  const std::string bytes = file.text(animated(R"("input":1,"output":2)", "rotation"));
  const auto turned = [](double degrees) {
    const double angle = degrees * std::numbers::pi / 180;
    return Vec3d{std::cos(angle), std::sin(angle), 0};
  };
  for (const auto& [time, degrees] :
       {std::pair(0.0, 0.0), {1.0, 0.0}, {1.5, 22.5}, {2.0, 45.0}, {3.0, 90.0}, {3.5, 90.0}, {9.0, 90.0}}) {
    INFO(time);
    CHECK(near_to(vertex(bytes, at(time), 1), turned(degrees)));
    CHECK(near_to(vertex(bytes, at(time, "0"), 1), turned(degrees)));
  }
  CHECK(near_to(vertex(bytes, {}, 1), turned(0)));  // at rest
  const std::string step = file.text(animated(R"("input":1,"output":2,"interpolation":"STEP")", "rotation"));
  CHECK(near_to(vertex(step, at(2.9), 1), turned(0)));
  CHECK(near_to(vertex(step, at(3), 1), turned(90)));
}

TEST_CASE("slerp() goes along the arc") {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  using Quaternion = std::array<double, 4>;
  const auto dot_of = [](const Quaternion& a, const Quaternion& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
  };
  for (int i = 0; i < 1000; ++i) {
    Quaternion a{}, b{};
    for (double& x : a) x = normal(random);
    for (double& x : b) x = normal(random);
    const double size_a = std::sqrt(dot_of(a, a)), size_b = std::sqrt(dot_of(b, b));
    for (double& x : a) x /= size_a;
    for (double& x : b) x /= size_b;
    const double sign = dot_of(a, b) < 0 ? -1 : 1, angle = std::acos(std::min(1.0, sign * dot_of(a, b)));
    const double t = (i % 11) / 10.0;
    const Quaternion found = gltf::slerp(a, b, t);
    for (std::size_t k = 0; k < 4; ++k)
      CHECK(std::abs(found[k] -
                     (std::sin((1 - t) * angle) * a[k] + sign * std::sin(t * angle) * b[k]) / std::sin(angle)) < 1e-12);
  }
}

TEST_CASE("glTF's cubic splines have the tangents of their keys") {
  // At 0: at 0, and on with 3 a second; at 2: at 10, reached with -1 a second.
  GltfFile file = triangle();
  file.add(Numbers{0, 2}, "SCALAR", floats, 2);
  file.add(Numbers{9, 9, 9, 0, 0, 0, 3, 0, 0, -1, 0, 0, 10, 0, 0, 9, 9, 9}, "VEC3", floats, 6);
  const std::string bytes = file.text(animated(R"("input":1,"output":2,"interpolation":"CUBICSPLINE")", "translation"));
  const auto expected = [](double t) {
    return t * (1 - t) * (1 - t) * 2 * 3 + t * t * (3 - 2 * t) * 10 - t * t * (1 - t) * 2 * -1;
  };
  for (const double time : {0.0, 0.5, 1.0, 1.7, 2.0})
    CHECK(near_to(vertex(bytes, at(time), 0), {expected(time / 2), 0, 0}));
}

TEST_CASE("animations of glTF are chosen by name or number") {
  GltfFile file = triangle();
  file.add(Numbers{0}, "SCALAR", floats, 1).add(Numbers{1, 2, 3}, "VEC3", floats, 1);
  const std::string sampler = R"("input":1,"output":2)";
  const std::string bytes =
      file.text(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)" + mesh_of_triangle + R"(,"animations":[)" +
                animation(sampler, "scale", "grow") + ',' + animation(sampler, "translation", "") + ']');
  CHECK(near_to(vertex(bytes, at(0, "grow"), 1), {1, 0, 0}));
  CHECK(near_to(vertex(bytes, at(0, "grow"), 2), {0, 2, 0}));
  CHECK(near_to(vertex(bytes, at(0, "1"), 1), {2, 2, 3}));
  CHECK(read_bytes("a.gltf", bytes, at(0, "run")).messages ==
        "a.gltf: error: has no animation 'run'; there are 'grow', 1\n");
  // The first of a file that has none is none.
  const std::string still = triangle().text(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)" + mesh_of_triangle);
  for (const char* const name : {"0", "all"}) CHECK(near_to(vertex(still, at(0, name), 1), {1, 0, 0}));
  CHECK(read_bytes("a.gltf", still, at(0, "1")).messages == "a.gltf: error: has no animation '1', nor any other\n");
  CHECK(read_bytes("a.stl", "solid", at(0)).messages == "a.stl: error: has no animation 'walk': it is no glTF\n");
}

TEST_CASE("all animations of a glTF file at once") {
  GltfFile file = triangle();
  file.add(Numbers{0, 1}, "SCALAR", floats, 2).add(Numbers{0, 0, 0, 1, 0, 0}, "VEC3", floats, 2);
  file.add(Numbers{0, 2}, "SCALAR", floats, 2).add(Numbers{0, 0, 0, 0, 4, 0}, "VEC3", floats, 2);
  const auto moving = [](const char* name, int node, int input) {
    return swapped(animation(R"("input":)" + std::to_string(input) + R"(,"output":)" + std::to_string(input + 1),
                             "translation", name),
                   R"("node":0)", R"("node":)" + std::to_string(node));
  };
  const auto with = [&](const std::string& animations) {
    return file.text(R"("scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0},{"mesh":0}],)" + mesh_of_triangle +
                     R"(,"animations":[)" + animations + "]");
  };
  const std::string each = with(moving("ball", 0, 1) + "," + moving("cube", 1, 3));
  const ReadResult all = read_bytes("a.gltf", each, at(1, "all"));
  CHECK(all.messages.empty());
  REQUIRE(all.mesh);
  CHECK(all.mesh->positions[0] == 1);
  CHECK(all.mesh->positions[10] == 2);
  CHECK(all.mesh->animation_end == 2);
  CHECK(read_bytes("a.gltf", each, at(1, "ball")).messages ==
        "a.gltf: warning: animations: the animation 'ball' is played alone; other nodes are moved by 'cube'; the "
        "animation 'all' plays all of them\n");
  CHECK(read_bytes("a.gltf", each).messages.empty());  // at rest

  // Of what two move, the later one says how; they are two movements of that, and no warning.
  const std::string both = with(moving("walk", 0, 1) + "," + moving("run", 0, 3));
  CHECK(near_to(vertex(both, at(1, "all"), 0), {0, 2, 0}));
  CHECK(read_bytes("a.gltf", both, at(1, "walk")).messages.empty());
  CHECK(near_to(vertex(with(moving("all", 0, 1) + "," + moving("cube", 1, 3)), at(1, "all"), 3), {0, 0, 0}));
}

TEST_CASE("a vertex of glTF moves with the joints that it has, by their weights") {
  // Joint 0 is where the scene has it; joint 1 is 1 above it, and turned by a quarter about z. What the mesh's node
  // says of its place does not count.
  GltfFile file = triangle();
  file.add(std::vector<std::uint8_t>{0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4", 5121, 3);
  file.add(Numbers{0.25F, 0.75F, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0}, "VEC4", floats, 3);
  Numbers inverse(32);
  for (std::size_t i = 0; i < 4; ++i) inverse[5 * i] = inverse[16 + 5 * i] = 1;
  inverse[16 + 13] = -1;  // joint 1 was at (0, 1, 0)
  file.add(inverse, "MAT4", floats, 2);
  const std::string members = R"("scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0,"skin":0,"translation":[7,7,7]},
      {"translation":[5,0,0],"children":[2]},{"translation":[0,1,0],"rotation":[0,0,0.70710678,0.70710678]}],
      "skins":[{"joints":[1,2],"inverseBindMatrices":3}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}]}])";
  const std::string bytes = file.text(members);
  // By joint 1, p goes to (5, 1, 0) + turned(p - (0, 1, 0)) = (6 - p.y, 1 + p.x, 0).
  CHECK(near_to(vertex(bytes, {}, 0), Vec3d(5, 0, 0) * 0.25 + Vec3d(6, 1, 0) * 0.75));
  CHECK(near_to(vertex(bytes, {}, 1), {6, 2, 0}));  // weights are relative
  CHECK(near_to(vertex(bytes, {}, 2), {5, 1, 0}));  // no weights: the first joint

  const auto message = [&](const std::string& what, const std::string& by) {
    return read_bytes("a.gltf", swapped(bytes, what, by)).messages;
  };
  CHECK(message(R"("joints":[1,2])", R"("joints":[1])") ==
        "a.gltf: error: accessors[1]: has the joint 1, and skins[0] has 1\n");
  CHECK(contains(message(R"("joints":[1,2])", R"("joints":[])"), "skins[0].joints: has no joints"));
  CHECK(contains(message(R"("joints":[1,2])", R"("joints":[1,3])"), "skins[0].joints[1]: there is no nodes[3]"));
  CHECK(contains(message(R"("joints":[1,2])", R"("joints":[1,2,1])"), "accessors[3] has no MAT4 for each of the 3"));
  CHECK(contains(message(R"("nodes":[0,1]})", R"("nodes":[0]})"), "nodes[1], which is not in the scene"));
  CHECK(contains(message(R"("children":[2])", R"("children":[1])"), "nodes[1], which has a parent already"));
  CHECK(contains(message(R"("skin":0)", R"("skin":1)"), "nodes[0].skin: there is no skins[1]"));
  CHECK(contains(message(R"("JOINTS_0":1)", R"("JOINTS_0":2)"), "is none of whole numbers"));
}

TEST_CASE("a glTF vertex may have eight joints") {
  GltfFile file = triangle();
  std::vector<std::uint8_t> first, second;
  Numbers weights;
  for (int i = 0; i < 3; ++i) {
    first.insert(first.end(), {0, 1, 2, 3});
    second.insert(second.end(), {4, 5, 6, 7});
    weights.insert(weights.end(), 4, 0.125F);
  }
  file.add(first, "VEC4", 5121, 3).add(second, "VEC4", 5121, 3).add(weights, "VEC4", floats, 3);
  std::string nodes = R"({"mesh":0,"skin":0})", numbers = "0", joints;
  for (int i = 0; i < 8; ++i) {
    nodes += R"(,{"translation":[)" + std::to_string(i) + ",0,0]}";
    numbers += ',' + std::to_string(i + 1);
    joints += (i == 0 ? "" : ",") + std::to_string(i + 1);
  }
  const std::string bytes = file.text(
      R"("scenes":[{"nodes":[)" + numbers + R"(]}],"nodes":[)" + nodes + R"(],"skins":[{"joints":[)" + joints +
      R"(]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":3,"JOINTS_1":2,
      "WEIGHTS_1":3}}]}])");
  CHECK(near_to(vertex(bytes, {}, 1), {1 + 3.5, 0, 0}));
}

TEST_CASE("morph targets of glTF are added by their weights") {
  GltfFile file = triangle();
  file.add(Numbers{0, 0, 1, 0, 0, 2, 0, 0, 4}, "VEC3", floats, 3);                                // 1: a target
  file.add(Numbers{8, 0, 0, 8, 0, 0, 8, 0, 0}, "VEC3", floats, 3);                                // 2: another
  file.add(Numbers{0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", floats, 3);                                // 3: normals
  file.add(Numbers{1, 0, -1, 0, 0, 0, 0, 0, 0}, "VEC3", floats, 3);                               // 4: their target
  file.add(Numbers{0, 4}, "SCALAR", floats, 2).add(Numbers{0, 0, 1, 0.5F}, "SCALAR", floats, 4);  // 5, 6
  const std::string members = R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"scale":[1,1,10]}],
      "meshes":[{"weights":[0.5,0],"primitives":[{"attributes":{"POSITION":0,"NORMAL":3},
      "targets":[{"POSITION":1,"NORMAL":4},{"POSITION":2}]}]}],"animations":[)" +
                              animation(R"("input":5,"output":6)", "weights") + "]";
  const std::string bytes = file.text(members);
  CHECK(near_to(vertex(bytes, {}, 1), {1, 0, 10}));
  CHECK(near_to(vertex(bytes, at(3), 1), {1 + 0.375 * 8, 0, 0.75 * 2 * 10}));
  const ReadResult read = read_bytes("a.gltf", swapped(bytes, "[1,1,10]", "[1,1,1]"), at(4));
  REQUIRE(read.mesh);
  CHECK(values(read.mesh->normals) == Numbers{1, 0, 0, 0, 0, 1, 0, 0, 1});
  CHECK(near_to(vertex(swapped(bytes, R"("mesh":0)", R"("mesh":0,"weights":[0,1])"), {}, 0), {8, 0, 0}));
  CHECK(contains(read_bytes("a.gltf", swapped(bytes, "[0.5,0]", "[0.5]")).messages,
                 "nodes[0]: its mesh has 2 morph targets, and 1 weight"));
  CHECK(contains(read_bytes("a.gltf", swapped(bytes, R"("input":5)", R"("input":6)"), at(0)).messages,
                 "accessors[6] has times that do not grow: number 1"));
}

TEST_CASE("EXT_mesh_gpu_instancing puts a mesh to many places") {
  GltfFile file = triangle();
  file.add(Numbers{0, 0, 0, 10, 0, 0}, "VEC3", floats, 2);
  file.add(std::vector<std::int8_t>{0, 0, 0, 127, 0, 0, 127, 0}, "VEC4", 5120, 2, R"(,"normalized":true)");
  file.add(Numbers{1, 1, 1, 2, 3, 1}, "VEC3", floats, 2);
  const std::string members = R"("extensionsRequired":["EXT_mesh_gpu_instancing"],"scenes":[{"nodes":[0]}],
      "nodes":[{"mesh":0,"translation":[0,0,5],"extensions":{"EXT_mesh_gpu_instancing":{"attributes":
      {"TRANSLATION":1,"ROTATION":2,"SCALE":3,"_ID":9}}}}],)" +
                              mesh_of_triangle;
  const std::string bytes = file.text(members);
  const ReadResult read = read_bytes("a.gltf", bytes);
  CHECK(read.messages.empty());
  REQUIRE(read.mesh);
  CHECK(read.mesh->face_count() == 2);
  // The second is stretched, turned by half a turn about z, and moved.
  CHECK(near_to(vertex(bytes, {}, 1), {1, 0, 5}));
  CHECK(near_to(vertex(bytes, {}, 4), {8, 0, 5}));
  CHECK(near_to(vertex(bytes, {}, 5), {10, -3, 5}));
  CHECK(contains(read_bytes("a.gltf", swapped(bytes, R"("SCALE":3)", R"("SCALE":0)")).messages,
                 "accessors[0] has 3 elements, and there are 2 instances"));
  CHECK(contains(read_bytes("a.gltf", swapped(bytes, R"("SCALE":3)", R"("SCALE":2)")).messages,
                 "accessors[2] has elements of 4 numbers, and not of 3"));
}

TEST_CASE("KHR_node_visibility hides a node and all below it") {
  const auto faces = [](const std::string& parent, const std::string& child) {
    const std::string extension = R"("extensions":{"KHR_node_visibility":{"visible":)";
    const ReadResult read = read_bytes(
        "a.gltf",
        triangle().text(R"("extensionsUsed":["KHR_node_visibility"],"scenes":[{"nodes":[0,1]}],"nodes":[{"mesh":0},
        {"mesh":0,)" + extension +
                        parent + R"(}},"children":[2]},{"mesh":0,)" + extension + child + "}}}]," + mesh_of_triangle));
    CHECK(read.messages.empty());
    return read.mesh ? read.mesh->face_count() : 0;
  };
  CHECK(faces("true", "true") == 3);
  CHECK(faces("true", "false") == 2);
  CHECK(faces("false", "true") == 1);
}

TEST_CASE("material variants of glTF") {
  const std::string bytes = triangle().text(R"("extensionsUsed":["KHR_materials_variants"],
      "extensions":{"KHR_materials_variants":{"variants":[{"name":"day"},{"name":"night"}]}},"scenes":[{"nodes":[0]}],
      "nodes":[{"mesh":0}],"materials":[{"name":"white"},{"name":"black"}],"meshes":[{"primitives":[{"attributes":
      {"POSITION":0},"material":0,"extensions":{"KHR_materials_variants":{"mappings":[{"material":1,"variants":[1]}]}}}]}])");
  const auto material = [&](const std::string& variant) {
    MeshReadSettings settings;
    settings.variant = variant;
    const ReadResult read = read_bytes("a.gltf", bytes, settings);
    if (!read.mesh) return read.messages;
    REQUIRE(read.mesh->materials.size() == 1);
    return read.mesh->materials.front().name;
  };
  CHECK(material("") == "white");
  CHECK(material("day") == "white");
  CHECK(material("night") == "black");
  CHECK(material("1") == "black");
  CHECK(material("dusk") == "a.gltf: error: has no material variant 'dusk'; there are 'day', 'night'\n");
}

TEST_CASE("what is wrong in a glTF animation is an error with its place") {
  GltfFile file = triangle();
  file.add(Numbers{0, 1}, "SCALAR", floats, 2).add(Numbers{0, 0, 0, 1, 0, 0}, "VEC3", floats, 2);
  file.add(Numbers{0, std::numeric_limits<float>::quiet_NaN()}, "SCALAR", floats, 2);
  file.add(Numbers{1, 0}, "SCALAR", floats, 2).add(Numbers{}, "SCALAR", floats, 0);
  file.add(Numbers{0, 0, 0, std::numeric_limits<float>::infinity(), 0, 0}, "VEC3", floats, 2);
  const std::string good = file.text(animated(R"("input":1,"output":2)", "translation"));
  CHECK(near_to(vertex(good, at(0.5), 0), {0.5, 0, 0}));
  const auto check = [&](const std::string& what, const std::string& by, const std::string& message) {
    const ReadResult read = read_bytes("a.gltf", swapped(good, what, by), at(0.5));
    CHECK(read.messages == "a.gltf: error: " + message + "\n");
  };
  const std::string input = "animations[0].samplers[0].input: ", output = "animations[0].samplers[0].output: ";
  check(R"("input":1)", R"("input":3)", input + "accessors[3] has times that do not grow: number 1");
  check(R"("input":1)", R"("input":4)", input + "accessors[4] has times that do not grow: number 1");
  check(R"("input":1)", R"("input":5)", input + "accessors[5] has no times");
  check(R"("input":1)", R"("input":2)", input + "accessors[2] is none of times, which are SCALAR and floats");
  check(R"("input":1)", R"("input":9)", input + "there is no accessors[9]");
  check(R"("output":2)", R"("output":0)", output + "accessors[0] has 3 elements, and 2 keys take 2");
  check(R"("output":2)", R"("output":1)", output + "its accessor has other than VEC3");
  check(R"("output":2)", R"("output":6)", output + "accessors[6] has a number that is not finite");
  check(R"("output":2)", R"("output":2,"interpolation":"CUBICSPLINE")",
        output + "accessors[2] has 2 elements, and 2 keys take 6");
  check(R"("output":2)", R"("output":2,"interpolation":"cubic")",
        "animations[0].samplers[0].interpolation: is none of LINEAR, STEP and CUBICSPLINE");
  check(R"("sampler":0)", R"("sampler":1)", "animations[0].channels[0].sampler: there is no such sampler");
  check(R"("node":0,)", R"("node":1,)", "animations[0].channels[0].target.node: there is no nodes[1]");
  check(R"({"mesh":0})", R"({"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]})",
        "nodes[0]: has a matrix, and an animation that would move it");
}

TEST_CASE("a glTF file that names the same keys again and again is refused") {
  constexpr std::size_t keys = 20000, accessors = 500;
  GltfFile file = triangle();
  Numbers times(keys);
  for (std::size_t i = 0; i < keys; ++i) times[i] = static_cast<float>(i);
  file.add(times, "SCALAR", floats, keys);
  std::string samplers, channels;
  for (std::size_t i = 0; i < accessors; ++i) {
    file.add_accessor(R"({"bufferView":1,"type":"SCALAR","componentType":5126,"count":20000})");
    const std::string comma = i == 0 ? "" : ",", number = std::to_string(i + 1);
    samplers += comma + R"({"input":)" + number + R"(,"output":)" + number + "}";
    channels += comma + R"({"sampler":)" + std::to_string(i) + R"(,"target":{"node":0,"path":"weights"}})";
  }
  const ReadResult read =
      read_bytes("a.gltf",
                 file.text(R"("scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],)" + mesh_of_triangle +
                           R"(,"animations":[{"samplers":[)" + samplers + R"(],"channels":[)" + channels + "]}]"),
                 at(0, "0"));
  CHECK_FALSE(read.mesh);
  CHECK(contains(read.messages, "].input: asks for more numbers than the file can have"));
}

TEST_CASE("damaged glTF files with animations, skins and instances are read or refused") {
  GltfFile file = triangle();
  file.add(std::vector<std::uint8_t>{0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0}, "VEC4", 5121, 3);
  file.add(Numbers{0.25F, 0.75F, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", floats, 3);
  Numbers inverse(32);
  for (std::size_t i = 0; i < 4; ++i) inverse[5 * i] = inverse[16 + 5 * i] = 1;
  file.add(inverse, "MAT4", floats, 2).add(Numbers{0, 1}, "SCALAR", floats, 2);
  file.add(Numbers{0, 0, 0, 1, 0, 0, 1, 0}, "VEC4", floats, 2).add(Numbers{0, 0, 0, 1, 0, 0}, "VEC3", floats, 2);
  const std::string members = R"("scenes":[{"nodes":[0,1,3]}],"nodes":[{"mesh":0,"skin":0},{"children":[2]},
      {"translation":[0,1,0]},{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{"attributes":{"TRANSLATION":6}}}}],
      "skins":[{"joints":[1,2],"inverseBindMatrices":3}],"meshes":[{"weights":[0.5],"primitives":[{"attributes":
      {"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2},"targets":[{"POSITION":0}]}]}],"animations":[{"samplers":[
      {"input":4,"output":5},{"input":4,"output":6,"interpolation":"STEP"},{"input":4,"output":4}],"channels":[
      {"sampler":0,"target":{"node":2,"path":"rotation"}},{"sampler":1,"target":{"node":1,"path":"translation"}},
      {"sampler":2,"target":{"node":0,"path":"weights"}}]}])";
  REQUIRE(read_bytes("a.gltf", file.text(members), at(0.5, "0")).messages.empty());
  const TemporaryFolder folder;
  std::mt19937 random(3);
  std::size_t good = 0, refused = 0;
  for (const auto& [name, bytes] : {std::pair("a.gltf", file.text(members)), {"a.glb", file.glb(members)}})
    for (int i = 0; i < 1500; ++i) {
      std::string damaged = bytes;
      for (std::size_t edits = 1 + random() % 3; edits > 0; --edits) {
        const std::size_t place = random() % damaged.size();
        if (random() % 3 == 0)
          damaged.erase(place, 1 + random() % 3);
        else if (const std::size_t digit = damaged.find_first_of("0123456789", place); digit != std::string::npos)
          damaged[digit] = "0123456789-.e}\xff"[random() % 15];
      }
      ++(is_read_or_refused(folder.file(name), damaged, at(0.5, "0")) ? good : refused);
    }
  CHECK(good > 100);
  CHECK(refused > 500);
}
