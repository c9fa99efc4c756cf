// Finer meshes in scenes, and textures that displace them.
#include <cmath>
#include <cstring>
#include <memory>
#include <set>
#include <sstream>
#include <string>

#include "raytrace/description/check_scene.h"
#include "raytrace/description/load_images.h"
#include "raytrace/description/scene_description.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/gltf_copies.h"
#include "support/mesh_edges.h"
#include "support/temporary_folder.h"

namespace raytrace::test {
namespace {

const std::string textures_of_scene =
    "<textures><checkers><checker><name>squares</name><color1 red='1' green='0' blue='0'/>"
    "<color2 red='0' green='0' blue='1'/><uvscale x='2' y='2'/></checker></checkers>"
    "<noises><noise><name>clouds</name><scale>0.7</scale></noise>"
    "<noise><name>even</name><color1 red='1' green='1' blue='1'/></noise></noises>"
    "<images><image><name>ramp</name><file>ramp.exr</file><wrap>clamp</wrap></image></images>"
    "<vertexcolors><vertexcolor><name>paint</name></vertexcolor></vertexcolors></textures>";

std::string scene_text(const std::string& objects) {
  return "<raytracer><viewplane><hres>8</hres><vres>8</vres></viewplane>\n"
         "<camera><eye x='0' y='0' z='5'/><lookat x='0' y='0' z='0'/><viewdistance>8</viewdistance></camera>\n" +
         textures_of_scene +
         "<materials><mattes><matte><name>clay</name><ka>1</ka><kd>1</kd><cd red='1' green='1' blue='1'/></matte>"
         "</mattes></materials>\n<objects>" +
         objects + "</objects></raytracer>";
}

std::string mesh_text(const std::string& elements) {
  return "<meshes>\n<mesh>" + elements + "<material>clay</material></mesh></meshes>";
}

const std::string square =
    "<positions>0 0 0, 1 0 0, 1 1 0, 0 1 0</positions> <uvs>0 0, 1 0, 1 1, 0 1</uvs> <faces>0 1 2 3,</faces>"
    "<subdivisionscheme>flat</subdivisionscheme>";
const std::string cube =
    "<positions>-1 -1 -1, 1 -1 -1, 1 1 -1, -1 1 -1, -1 -1 1, 1 -1 1, 1 1 1, -1 1 1</positions>"
    "<faces>0 3 2 1, 4 5 6 7, 0 1 5 4, 1 2 6 5, 2 3 7 6, 3 0 4 7</faces>";

/// From 0 at the left to 1 at the right.
std::shared_ptr<const TexelImage> ramp(int width) {
  Picture picture{{width, 1, 1, TexelFormat::floats}, {}};
  picture.pixels = LargeArray<std::byte>::zeros(static_cast<std::size_t>(width) * sizeof(float));
  for (int i = 0; i < width; ++i) {
    const float value = (static_cast<float>(i) + 0.5F) / static_cast<float>(width);
    std::memcpy(picture.pixels.data() + static_cast<std::size_t>(i) * sizeof value, &value, sizeof value);
  }
  return std::make_shared<const TexelImage>(picture, false, 1);
}

struct Loaded {
  std::optional<SceneDescription> scene;
  std::string messages;

  const ObjectItem<Mesh>& item(std::size_t i = 0) const {
    INFO(messages);
    REQUIRE(scene);
    return std::get<ObjectItems<Mesh>>(scene->objects).at(i);
  }
  const MeshData& mesh(std::size_t i = 0) const { return *item(i).data; }
};

Loaded loaded(const std::string& objects, int threads = 0) {
  Diagnostics diagnostics("s");
  Loaded result;
  result.scene = parse_scene(scene_text(objects), diagnostics);
  if (result.scene) {
    auto& image = std::get<TextureItems<Image>>(result.scene->textures).at(0).image;
    image = {"hash", ramp(256), ramp(256)};
    if (!load_meshes(*result.scene, diagnostics, threads)) result.scene.reset();
  }
  std::ostringstream out;
  diagnostics.print(out);
  result.messages = out.str();
  return result;
}

Vec3d place(const MeshData& mesh, std::size_t vertex) {
  return {mesh.positions[3 * vertex], mesh.positions[3 * vertex + 1], mesh.positions[3 * vertex + 2]};
}
Vec3d normal(const MeshData& mesh, std::size_t vertex) {
  return {mesh.normals[3 * vertex], mesh.normals[3 * vertex + 1], mesh.normals[3 * vertex + 2]};
}

/// A ball of radius 2 in so many rings, closed, as the text of positions and faces.
std::string ball(int rings) {
  std::ostringstream positions, faces;
  const int around = 2 * rings;
  positions << "0 0 2, 0 0 -2";
  for (int ring = 1; ring < rings; ++ring)
    for (int i = 0; i < around; ++i) {
      const double a = 3.14159265358979 * ring / rings, b = 2 * 3.14159265358979 * i / around;
      positions << ", " << 2 * std::sin(a) * std::cos(b) << ' ' << 2 * std::sin(a) * std::sin(b) << ' '
                << 2 * std::cos(a);
    }
  const auto at = [&](int ring, int i) {
    return ring == 0 ? 0 : ring == rings ? 1 : 2 + (ring - 1) * around + i % around;
  };
  for (int ring = 0; ring < rings; ++ring)
    for (int i = 0; i < around; ++i) {
      faces << at(ring, i) << ' ' << at(ring + 1, i);
      if (ring + 1 < rings) faces << ' ' << at(ring + 1, i + 1);
      if (ring > 0) faces << ' ' << at(ring, i + 1);
      faces << ", ";
    }
  return "<positions>" + positions.str() + "</positions><faces>" + faces.str() + "</faces>";
}

}  // namespace

TEST_CASE("a constant texture makes a ball larger, by its height times what it has beyond the middle") {
  const Loaded scene =
      loaded(mesh_text(ball(40) + "<displacement texture='even' height='0.5'/> <midlevel>-1</midlevel>"));
  const MeshData& mesh = scene.mesh();
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    CHECK(length(place(mesh, i)) == Approx(3).epsilon(1e-3));
    CHECK(dot(normal(mesh, i), place(mesh, i)) == Approx(3).epsilon(1e-3));
  }
}

TEST_CASE("a square rises by a checker where that has its first colour, and half way at the edges between") {
  const Loaded scene =
      loaded(mesh_text(square + "<subdivision>4</subdivision> <displacement texture='squares' height='0.2'/>"
                                "<midlevel>0.5</midlevel>"));
  const MeshData& mesh = scene.mesh();
  REQUIRE(mesh.vertex_count() == 17 * 17);
  int edges = 0;
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    const Vec3d p = place(mesh, i);
    const double u = double{mesh.uvs[2 * i]}, v = double{mesh.uvs[2 * i + 1]};
    CHECK((p.x == u && p.y == v));
    const bool on_edge = std::fmod(2 * u, 1) == 0 || std::fmod(2 * v, 1) == 0;
    const double wanted = on_edge ? 0 : ((u < 0.5) == (v < 0.5) ? 0.1 : -0.1);
    edges += on_edge ? 1 : 0;
    CHECK(p.z == Approx(wanted).margin(1e-7));
  }
  CHECK(edges == 3 * 17 + 3 * 14);
  // By blue it is the other way round.
  const Loaded blue = loaded(
      mesh_text(square + "<subdivision>4</subdivision> <displacement texture='squares' channel='blue' height='0.2'/>"
                         "<midlevel>0.5</midlevel>"));
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i)
    CHECK(place(blue.mesh(), i).z == Approx(-place(mesh, i).z).margin(1e-7));
}

TEST_CASE("a square displaced by a ramp slants, with the normals of what it has become") {
  const MeshData mesh = std::move(const_cast<MeshData&>(
      loaded(mesh_text(square + "<subdivision>5</subdivision> <displacement texture='ramp' height='0.5'/>")).mesh()));
  for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
    const Vec3d p = place(mesh, i);
    if (p.x < 0.1 || p.x > 0.9) continue;  // texels end half a texel before the edge
    CHECK(p.z == Approx(0.5 * p.x).margin(1e-5));
    CHECK(normal(mesh, i).x == Approx(-1 / std::sqrt(5)).margin(1e-4));
    CHECK(normal(mesh, i).z == Approx(2 / std::sqrt(5)).margin(1e-4));
  }
}

TEST_CASE("textures have no more detail than vertices can show") {
  // Four squares between two vertices: their mean, everywhere.
  const Loaded scene =
      loaded(mesh_text("<positions>0 0 0, 1 0 0, 1 1 0, 0 1 0</positions> <uvs>0.3 0.2, 8.3 0.2, 8.3 8.2, 0.3 "
                       "8.2</uvs> <faces>0 1 2 3,</faces>"
                       "<subdivisionscheme>flat</subdivisionscheme> <subdivision>1</subdivision>"
                       "<displacement texture='squares' height='1'/>"));
  for (std::size_t i = 0; i < scene.mesh().vertex_count(); ++i) CHECK(place(scene.mesh(), i).z == Approx(0.5));
}

TEST_CASE("a box with hard edges and seams of its texture coordinates stays closed when it is displaced") {
  // Its faces share no vertex, and each has all of the texture.
  std::string positions, uvs, faces;
  const char* const corners[] = {"-1 -1 -1", "1 -1 -1", "1 1 -1", "-1 1 -1", "-1 -1 1", "1 -1 1", "1 1 1", "-1 1 1"};
  const int sides[][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  int vertex = 0;
  for (const auto& side : sides) {
    for (const int corner : side) positions += std::string(corners[corner]) + ", ";
    uvs += "0.1 0.2, 0.9 0.1, 1 0.8, 0 0.7, ";
    for (int k = 0; k < 4; ++k) faces += std::to_string(vertex++) + (k < 3 ? " " : ", ");
  }
  for (const std::string texture : {"ramp", "squares", "clouds"}) {
    for (const std::string scheme : {"flat", "smooth"}) {
      const Loaded scene =
          loaded(mesh_text("<positions>" + positions + "</positions><uvs>" + uvs + "</uvs><faces>" + faces +
                           "</faces><subdivision>4</subdivision><subdivisionscheme>" + scheme +
                           "</subdivisionscheme><displacement texture='" + texture + "' height='0.3'/>"));
      const MeshData& mesh = scene.mesh();
      INFO(texture << ' ' << scheme);
      CHECK(mesh.vertex_count() > 6 * 16 * 17);  // but for those that are alike by chance
      CHECK(edges_by_faces(mesh) == std::map<int, int>{{2, 6 * 16 * 16 * 2}});
    }
  }
}

TEST_CASE("what is displaced has the same bits with any number of threads, and meshes that are alike are made once") {
  const std::string objects = "<meshes><mesh>" + cube +
                              "<subdivision>7</subdivision><displacement texture='clouds' "
                              "height='0.3'/><material>clay</material></mesh></meshes>";
  const Loaded one = loaded(objects, 1), many = loaded(objects, 7);
  CHECK(one.mesh().face_count() == 6 * 16384);
  CHECK(scene_hash(*one.scene) == scene_hash(*many.scene));
  CHECK(std::memcmp(one.mesh().positions.data(), many.mesh().positions.data(), 4 * one.mesh().positions.size()) == 0);

  const TemporaryFolder folder;
  write_text(folder.file("t.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string file = "<file>" + folder.file("t.obj") + "</file>";
  const Loaded pair = loaded("<meshes><mesh>" + file + "<subdivision>2</subdivision></mesh><mesh>" + file +
                             "<subdivision>2</subdivision></mesh><mesh>" + file +
                             "<subdivision>3</subdivision></mesh><mesh>" + file + "</mesh></meshes>");
  CHECK(pair.item(0).data == pair.item(1).data);
  CHECK(pair.mesh(0).face_count() == 16);
  CHECK(pair.mesh(2).face_count() == 64);
  CHECK(pair.mesh(3).face_count() == 1);
}

TEST_CASE("finer meshes have smooth normals; flat faces keep those of the file, and flat is flat") {
  const std::string bent =
      "<positions>0 0 0, 1 0 0, 1 1 0, 0 1 0</positions> <faces>0 1 2 3,</faces>"
      "<normals>-1 0 1, 1 0 1, 1 0 1, -1 0 1</normals> <subdivision>1</subdivision>";
  const Loaded flat = loaded(mesh_text(bent + "<subdivisionscheme>flat</subdivisionscheme>"));
  REQUIRE(flat.mesh().normals.size() == 27);
  for (std::size_t i = 0; i < 9; ++i)
    CHECK(normal(flat.mesh(), i).x == Approx(2 * place(flat.mesh(), i).x - 1).margin(1e-6));
  const Loaded smooth = loaded(mesh_text(bent));
  for (std::size_t i = 0; i < 9; ++i) CHECK(normal(smooth.mesh(), i).z == 1);
  CHECK(loaded(mesh_text(cube + "<subdivision>2</subdivision> <normals>flat</normals>")).mesh().normals.empty());
  CHECK(loaded(mesh_text(cube + "<subdivision>2</subdivision>")).mesh().normals.size() > 0);
}

TEST_CASE("models have finer faces and displacement, and are printed as the meshes that they become") {
  const TemporaryFolder folder;
  write_text(folder.file("q.obj"),
             "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
             "f 1/1 2/2 3/3 4/4\n");
  const Loaded scene = loaded("<models><model><file>" + folder.file("q.obj") +
                              "</file><subdivision>3</subdivision><subdivisionscheme>flat</subdivisionscheme>"
                              "<displacement texture='ramp' height='0.5'/><midlevel>0.25</midlevel></model></models>");
  CHECK(scene.mesh().face_count() == 64);
  double highest = 0;
  for (std::size_t i = 0; i < scene.mesh().vertex_count(); ++i) highest = std::max(highest, place(scene.mesh(), i).z);
  CHECK(highest == Approx(0.375).epsilon(0.1));
  const std::string printed = print_scene(*scene.scene);
  CHECK(contains(printed, "<displacement texture=\"ramp\" height=\"0.5\"/>"));
  CHECK(contains(printed, "<subdivisionscheme>flat</subdivisionscheme>"));
  CHECK(contains(printed, "<midlevel>0.25</midlevel>"));
}

TEST_CASE("data that a program has made become finer once, with their copies") {
  Loaded scene = loaded(mesh_text(square));
  auto& meshes = std::get<ObjectItems<Mesh>>(scene.scene->objects);
  MeshData made = std::move(const_cast<MeshData&>(*meshes[0].data));
  auto copy = std::make_shared<MeshData>();
  copy->positions = MeshBuffer<float>(9);
  for (std::size_t i = 0; i < 9; ++i) copy->positions[i] = i == 3 || i == 7 ? 1.0F : 0.0F;
  copy->indices = MeshBuffer<std::uint32_t>(3);
  for (std::uint32_t i = 0; i < 3; ++i) copy->indices[i] = i;
  made.copies.push_back({copy, {{}, {}}});
  ObjectItem<Mesh> item;
  item.data = std::make_shared<const MeshData>(std::move(made));
  item.material = meshes[0].material;
  item.parameters.subdivision = 2;
  meshes = {item};
  Diagnostics diagnostics("s");
  for (int i = 0; i < 2; ++i) {
    REQUIRE(load_meshes(*scene.scene, diagnostics));
    CHECK(scene.mesh().face_count() == 16);
    REQUIRE(scene.mesh().copies.size() == 1);
    CHECK(scene.mesh().copies[0].mesh->face_count() == 16);
    CHECK(scene.mesh().copies[0].places.size() == 2);
  }
  CHECK_FALSE(diagnostics.has_errors());
}

TEST_CASE("heights have one measure in all of a glTF file, however often it has a mesh") {
  GltfCopies strips;
  for (std::size_t i = 0; i < GltfCopies::enough; ++i) strips.add(static_cast<float>(i), 0, 5, 0.5, 0.5, 0.5);
  const TemporaryFolder folder;
  write_text(folder.file("strips.gltf"), strips.text());
  const Loaded scene = loaded("<models><model><file>" + folder.file("strips.gltf") +
                              "</file><displacement texture='even' height='2'/></model></models>");
  CHECK(scene.mesh().copies.empty());
  CHECK(scene.mesh().face_count() == 64 * GltfCopies::enough);
  std::size_t risen = 0;  // the strips face away from z
  for (std::size_t i = 0; i < scene.mesh().vertex_count(); ++i)
    risen += std::abs(place(scene.mesh(), i).z - 3) < 1e-5 ? 1 : 0;
  CHECK(risen == scene.mesh().vertex_count());
}

TEST_CASE("a file has its materials once, whatever is done to its faces") {
  const TemporaryFolder folder;
  write_text(folder.file("t.mtl"), "newmtl red\nKd 1 0 0\nnewmtl glow\nKe 1 1 1\n");
  write_text(folder.file("t.obj"),
             "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl red\nf 1 2 3\nusemtl glow\nf 1 3 4\n");
  const std::string file = "<model><file>" + folder.file("t.obj") + "</file>";
  const auto models = [&](const std::string& last) {
    return loaded("<models>" + file + "</model>" + file + "<subdivision>2</subdivision></model>" + file +
                  "<displacement texture='even'/></model>" + last + "</models>");
  };
  const Loaded scene = models("");
  REQUIRE(scene.item(0).materials.size() == 2);
  CHECK(scene.item(0).materials[0] != scene.item(0).materials[1]);
  CHECK(scene.item(1).materials == scene.item(0).materials);
  CHECK(scene.item(2).materials == scene.item(0).materials);
  // Overridden ones, too, are those of the scene alone.
  write_text(folder.file("t.mtl"), "newmtl clay\nKd 1 0 0\nnewmtl glow\nKe 1 1 1\n");
  write_text(folder.file("t.obj"),
             "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl clay\nf 1 2 3\nusemtl glow\nf 1 3 4\n");
  const Loaded overridden = models(file + "<overridematerials>true</overridematerials></model>");
  CHECK(overridden.item(3).materials.at(0) != overridden.item(0).materials.at(0));
  CHECK(overridden.item(3).materials.at(1) == overridden.item(0).materials.at(1));
}

TEST_CASE("a texture that cannot be read moves nothing, nor does a tile that is missing") {
  std::string text =
      scene_text(mesh_text(square + "<subdivision>3</subdivision><displacement texture='ramp' height='2'/>"
                                    "<midlevel>0.25</midlevel>"));
  Diagnostics diagnostics("s");
  std::optional<SceneDescription> scene = parse_scene(text, diagnostics);
  REQUIRE(scene);
  const SceneDescription unread = *scene;
  TextureSettings settings;
  settings.missing = MissingTexture::warn;
  REQUIRE(load_images(*scene, diagnostics, 1, settings));
  REQUIRE(load_meshes(*scene, diagnostics));
  std::ostringstream out;
  diagnostics.print(out);
  CHECK(out.str() ==
        "s:3:340: warning: the texture 'ramp.exr' cannot be used: there is no such file; it moves nothing\n");
  const auto z_where = [](const SceneDescription& of, const auto& is_there) {
    std::set<float> heights;
    const MeshData& mesh = *std::get<ObjectItems<Mesh>>(of.objects).at(0).data;
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i)
      if (is_there(mesh.uvs[2 * i])) heights.insert(mesh.positions[3 * i + 2]);
    return heights;
  };
  CHECK(z_where(*scene, [](float) { return true; }) == std::set<float>{0});

  // Seen as a colour elsewhere, it is magenta there.
  text.insert(text.find("<cd red"), "<kd texture='ramp'/>");
  text.erase(text.find("<kd>1</kd>"), 10);
  Diagnostics of_both("s");
  scene = parse_scene(text, of_both);
  REQUIRE(scene);
  REQUIRE(load_images(*scene, of_both, 1, settings));
  std::ostringstream both;
  of_both.print(both);
  CHECK(contains(both.str(), "there is no such file; it is magenta, and moves nothing\n"));

  // One tile of 0.75 on the left half of what coordinates reach; its far edge is its own.
  scene = unread;
  auto& image = std::get<TextureItems<Image>>(scene->textures).at(0);
  image.parameters.uvscale = {2, 1};
  Picture picture{{1, 1, 1, TexelFormat::floats}, {}};
  picture.pixels = LargeArray<std::byte>::zeros(sizeof(float));
  constexpr float value = 0.75F;
  std::memcpy(picture.pixels.data(), &value, sizeof value);
  std::vector<TexelImage::Tile> tiles;
  tiles.push_back({0, 0, TexelImage(picture, false, 1)});
  const auto texels = std::make_shared<const TexelImage>(TexelImage::of_tiles(std::move(tiles)));
  image.image = {"hash", texels, texels};
  REQUIRE(load_meshes(*scene, diagnostics));
  CHECK(z_where(*scene, [](float u) { return u <= 0.5F; }) == std::set<float>{1});
  CHECK(z_where(*scene, [](float u) { return u > 0.5F; }) == std::set<float>{0});
}

TEST_CASE("what cannot be finer or displaced is an error where the mesh stands") {
  const auto said = [](const std::string& elements) { return loaded(mesh_text(elements)).messages; };
  CHECK(
      said(cube + "<displacement texture='squares'/>") ==
      "s:5:1: error: the mesh has no texture coordinates, by which its displacement looks up the texture 'squares'\n");
  CHECK(said(cube + "<displacement texture='ramp'/> <subdivision>2</subdivision>") ==
        "s:5:1: error: the mesh has no texture coordinates, by which its displacement looks up the texture 'ramp'\n");
  CHECK(said(square + "<displacement texture='ramp' height='1e17'/> <midlevel>-1e17</midlevel>"
                      "<subdivision>1</subdivision>") == "s:5:1: error: the mesh would be displaced beyond 1e18\n");
  CHECK(said(ball(60) + "<subdivision>9</subdivision>") ==
        "s:5:1: error: the mesh would have 1871708160 faces after 9 subdivisions; at most 268435456 are possible\n");
  // Corners in one place, whatever their numbers.
  CHECK(said("<positions>0 0 0, 0 0 0, 1 0 0</positions><faces>0 1 2,</faces><subdivision>1</subdivision>") ==
        "s:5:1: error: the mesh has no face to subdivide: none has corners in three different places\n");
  CHECK(contains(said(square + "<midlevel>0.5</midlevel>"),
                 "warning: <midlevel> changes nothing without a <displacement>"));
  CHECK(contains(said(square), "warning: <subdivisionscheme> changes nothing without a <subdivision>"));
  CHECK(said(cube + "<displacement texture='paint'/>").empty());
}

}  // namespace raytrace::test
