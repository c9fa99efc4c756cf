// Meshes and clouds that a program has made in memory, held against what renders rely on.
#include <cmath>
#include <functional>
#include <limits>
#include <sstream>
#include <string>

#include "raytrace/description/check_scene.h"
#include "support/catch.h"
#include "support/contains.h"

namespace raytrace::test {
namespace {

constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr auto matte_type = static_cast<std::uint32_t>(index_of<Matte>(Materials{}));

template <class T>
MeshBuffer<T> buffer_of(std::initializer_list<T> values) {
  MeshBuffer<T> buffer(values.size());
  std::copy(values.begin(), values.end(), buffer.data());
  return buffer;
}

MeshData triangle_data() {
  MeshData data;
  data.positions = buffer_of<float>({-1, -1, 0, 1, -1, 0, 0, 1, 0});
  data.indices = buffer_of<std::uint32_t>({0, 1, 2});
  return data;
}

SceneDescription scene_in_clay() {
  SceneDescription scene;
  scene.viewplane.hres = scene.viewplane.vres = 4;
  PinholeCamera::Parameters camera;
  camera.eye = {0, 0, 9};
  camera.viewdistance = 4;
  scene.camera = camera;
  std::get<MaterialItems<Matte>>(scene.materials).push_back({{.ka = 1, .kd = 1, .cd = {1, 1, 1}}, "clay", 0});
  return scene;
}

std::string messages_in(const Diagnostics& diagnostics) {
  std::ostringstream text;
  diagnostics.print(text);
  return text.str();
}

std::string errors_in(const SceneDescription& scene) {
  Diagnostics diagnostics("s");
  check_scene(scene, diagnostics);
  return messages_in(diagnostics);
}

/// Of a mesh of two materials.
std::string errors_of_mesh(const std::function<void(MeshData&)>& change) {
  MeshData data = triangle_data();
  change(data);
  SceneDescription scene = scene_in_clay();
  ObjectItem<Mesh> mesh;
  mesh.parameters.file.path = "memory";
  mesh.data = std::make_shared<const MeshData>(std::move(data));
  mesh.materials = {{matte_type, 0}, {matte_type, 0}};
  std::get<ObjectItems<Mesh>>(scene.objects).push_back(mesh);
  return errors_in(scene);
}

std::string errors_of_cloud(double radius, const std::function<void(PointCloud&)>& change) {
  PointCloud data;
  data.positions = buffer_of<float>({0, 0, 0, 1, 0, 0});
  change(data);
  SceneDescription scene = scene_in_clay();
  ObjectItem<SphereCloud> cloud;
  cloud.parameters.file.path = "memory";
  cloud.parameters.radius = radius;
  cloud.data = std::make_shared<const PointCloud>(std::move(data));
  cloud.materials = {{matte_type, 0}};
  std::get<ObjectItems<SphereCloud>>(scene.objects).push_back(cloud);
  return errors_in(scene);
}

/// What load_meshes() says of a mesh of values.
std::string loading_errors(const std::function<void(Mesh::Parameters&)>& change) {
  SceneDescription scene = scene_in_clay();
  ObjectItem<Mesh> mesh;
  mesh.parameters.positions = {{-1, -1, 0, 1, -1, 0, 0, 1, 0}, {3, 6, 9}};
  mesh.parameters.faces = {{0, 1, 2}, {3}};
  change(mesh.parameters);
  std::get<ObjectItems<Mesh>>(scene.objects).push_back(mesh);
  Diagnostics diagnostics("s");
  const bool loaded = load_meshes(scene, diagnostics);
  CHECK(loaded == !diagnostics.has_errors());
  return messages_in(diagnostics);
}

}  // namespace

TEST_CASE("a mesh in memory is held against what renders rely on") {
  using Data = MeshData;
  CHECK(errors_of_mesh([](Data&) {}) == "");
  CHECK(errors_of_mesh([](Data& d) { d.indices[2] = 3; }) ==
        "s: error: <mesh> [0] has data that has a face at vertex 3; vertices are counted from 0, and there are 3\n");
  CHECK(contains(errors_of_mesh([](Data& d) { d.corners = 0; }), "has faces of 0 corners"));
  CHECK(contains(errors_of_mesh([](Data& d) { d.corners = 4; }), "has 3 indices, no multiple of 4"));
  CHECK(contains(errors_of_mesh([](Data& d) { d.indices = {}; }), "has no faces"));
  CHECK(contains(errors_of_mesh([](Data& d) { d.positions = {}; }), "there are 0"));
  CHECK(contains(errors_of_mesh([](Data& d) { d.positions[4] = not_a_number; }), "a position that is not finite"));
  CHECK(contains(errors_of_mesh([](Data& d) { d.positions[4] = -1e30F; }), "a position that is not finite"));
  CHECK(contains(errors_of_mesh([](Data& d) { d.origin.y = std::nan(""); }), "an origin that is not finite"));
  CHECK(contains(errors_of_mesh([](Data& d) { d.normals = buffer_of<float>({0, 0, 1}); }),
                 "has 3 normals; 3 vertices take 9"));
  CHECK(contains(errors_of_mesh([](Data& d) { d.uvs = buffer_of<float>({0}); }), "has 1 uvs; 3 vertices take 6"));
  CHECK(contains(errors_of_mesh([](Data& d) { d.uvs2 = buffer_of<float>({0}); }), "has 1 uvs2"));
  CHECK(contains(errors_of_mesh([](Data& d) { d.colors = buffer_of<float>({0}); }), "has 1 colors"));
  CHECK(contains(errors_of_mesh([](Data& d) { d.tangents = buffer_of<float>({0}); }), "has 1 tangents"));
  CHECK(contains(errors_of_mesh([](Data& d) { d.face_materials = buffer_of<std::uint32_t>({0, 0}); }),
                 "has 2 face_materials; 1 faces take 1"));
  CHECK(contains(errors_of_mesh([](Data& d) { d.face_materials = buffer_of<std::uint32_t>({2}); }),
                 "has a face of material 2; the mesh has 2, counted from 0"));
  CHECK(errors_of_mesh([](Data& d) { d.face_materials = buffer_of({Data::no_material}); }) == "");
  CHECK(contains(errors_of_mesh([](Data& d) { d.parts = {{"a", 1}}; }), "faces before the first of its parts"));
  CHECK(contains(errors_of_mesh([](Data& d) { d.parts = {{"a", 0}, {"b", 9}, {"c", 5}}; }), "not in the order"));
  CHECK(contains(errors_of_mesh([](Data& d) { d.parts = {{"a", 0}, {"b", 9}}; }), "a part from face 9 on; it has 1"));
  CHECK(contains(errors_of_mesh([](Data& d) { d.copies.resize(1); }), "has copies of no mesh"));
  const auto with_copy = [](Data&& copied, const MeshCopies::Place& place) {
    return errors_of_mesh(
        [&](Data& d) { d.copies.push_back({std::make_shared<const MeshData>(std::move(copied)), {place}}); });
  };
  CHECK(with_copy(triangle_data(), {}) == "");
  CHECK(contains(with_copy({}, {}), "has copies of a mesh that has no faces"));
  CHECK(contains(with_copy(triangle_data(), {{}, 2}), "has a copy of part 2; it has 0"));
  CHECK(contains(with_copy(triangle_data(), {{{std::nan(""), 0, 0}, {}, {}, {}}, 0}), "at a place that is not finite"));
}

TEST_CASE("a cloud in memory is held against the same") {
  using Data = PointCloud;
  CHECK(errors_of_cloud(1, [](Data&) {}) == "");
  CHECK(errors_of_cloud(0, [](Data&) {}) == "s: error: <spherecloud> [0] has data without radii; set its <radius>\n");
  CHECK(contains(errors_of_cloud(1, [](Data& d) { d.positions[5] = not_a_number; }), "a position that is not finite"));
  CHECK(contains(errors_of_cloud(0, [](Data& d) { d.radii = buffer_of<float>({1}); }), "has 1 radii; 2 points take 2"));
  CHECK(contains(errors_of_cloud(0, [](Data& d) { d.radii = buffer_of<float>({1, -1}); }), "must be greater than 0"));
  CHECK(contains(errors_of_cloud(1, [](Data& d) { d.colors = buffer_of<float>({1}); }), "has 1 colors"));
}

TEST_CASE("strands in memory are held against the same") {
  const auto errors_of = [](const std::function<void(CurveData&)>& change) {
    CurveData data;
    data.points = buffer_of<float>({0, 0, 0, 1, 1, 0, 0, 0, 2, 0, 0, 1, 2, 1, 0, 1});
    data.along = buffer_of<float>({0, 1, 0, 1});
    change(data);
    SceneDescription scene = scene_in_clay();
    ObjectItem<Curve> curve;
    curve.parameters.file.path = "memory";
    curve.data = std::make_shared<const CurveData>(std::move(data));
    curve.materials = {{matte_type, 0}};
    std::get<ObjectItems<Curve>>(scene.objects).push_back(curve);
    return errors_in(scene);
  };
  using Data = CurveData;
  CHECK(errors_of([](Data&) {}) == "");
  CHECK(errors_of([](Data& d) { d.along = {}; }) == "s: error: <curve> [0] has data that has no points\n");
  CHECK(contains(errors_of([](Data& d) { d.points = buffer_of<float>({0}); }), "4 points take 16"));
  CHECK(contains(errors_of([](Data& d) { d.points[4] = not_a_number; }), "a point that is not finite"));
  CHECK(contains(errors_of([](Data& d) { d.points[4] = 0; }), "where the one before is"));
  CHECK(contains(errors_of([](Data& d) { d.points[3] = -1; }), "a radius that is less than 0"));
  CHECK(contains(errors_of([](Data& d) { d.origin.x = std::nan(""); }), "an origin that is not finite"));
  CHECK(contains(errors_of([](Data& d) { d.colors = buffer_of<float>({1}); }), "has 1 colors"));
  using Along = std::initializer_list<float>;
  for (const Along along : {Along{0, 1, 0, 0.5F}, Along{0, 0, 0, 1}, Along{0, 0.5F, 0, 1}, Along{0.5F, 1, 0, 1},
                            Along{0, 1, 1.5F, 1}, Along{0, 1, 0, not_a_number}})
    CHECK(contains(errors_of([&](Data& d) { d.along = buffer_of<float>(along); }), "do not go from 0 to 1"));
}

TEST_CASE("a mesh whose values a program has set is loaded, or refused before its values are used") {
  using Values = Mesh::Parameters;
  CHECK(loading_errors([](Values&) {}) == "");
  CHECK(loading_errors([](Values& v) { v = {}; }) ==
        "s: error: the mesh: a mesh needs <file>, or <positions> and <faces>\n");
  CHECK(contains(loading_errors([](Values& v) { v.faces.ends = {3, 1000}; }), "<faces> has numbers that are in no"));
  CHECK(contains(loading_errors([](Values& v) { v.faces.ends = {3, 0, 3}; }), "<faces> has groups without numbers"));
  CHECK(contains(loading_errors([](Values& v) { v.faces.numbers[2] = 3; }), "a corner that is no vertex, number 3"));
  CHECK(contains(loading_errors([](Values& v) { v.positions.numbers[2] = std::nan(""); }), "<positions> has a number"));
  CHECK(contains(loading_errors([](Values& v) { v.uvs = {{0, 0}, {2}}; }), "<uvs> has 2 numbers"));

  // Data that a program has made stays.
  SceneDescription scene = scene_in_clay();
  auto& mesh = std::get<ObjectItems<Mesh>>(scene.objects).emplace_back();
  const auto data = mesh.data = std::make_shared<const MeshData>(triangle_data());
  mesh.materials = {{matte_type, 0}};
  Diagnostics diagnostics("s");
  CHECK(load_meshes(scene, diagnostics));
  CHECK(std::get<ObjectItems<Mesh>>(scene.objects)[0].data == data);
  CHECK(std::get<ObjectItems<Mesh>>(scene.objects)[0].materials == std::vector<MaterialReference>{{matte_type, 0}});
}

}  // namespace raytrace::test
