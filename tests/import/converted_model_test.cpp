// Models of other formats: what Assimp makes of them, in a program of its own.
#include "raytrace/import/converted_model.h"

#include <zlib.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "import/support.h"
#include "support/catch.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

namespace {

/// Collada: a square in z = 2, from (0, 0) to (3, 3), whose material has this colour or texture.
std::string square(const std::string& diffuse, const std::string& images = "", const std::string& rest = "") {
  return R"(<?xml version="1.0"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
  <asset><unit meter="1"/><up_axis>Y_UP</up_axis></asset>
  <library_images>)" +
         images + R"(</library_images>
  <library_effects><effect id="e"><profile_COMMON>
    <newparam sid="s"><surface type="2D"><init_from>i</init_from></surface></newparam>
    <newparam sid="t"><sampler2D><source>s</source></sampler2D></newparam>
    <technique sid="c"><lambert><diffuse>)" +
         diffuse + "</diffuse>" + rest + R"(</lambert></technique></profile_COMMON></effect></library_effects>
  <library_materials><material id="m" name="paint"><instance_effect url="#e"/></material></library_materials>
  <library_geometries><geometry id="g"><mesh>
    <source id="p"><float_array id="pa" count="12">0 0 2 3 0 2 3 3 2 0 3 2</float_array><technique_common>
      <accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>
      <param name="Z" type="float"/></accessor></technique_common></source>
    <source id="u"><float_array id="ua" count="8">0 0 1 0 1 1 0 1</float_array><technique_common>
      <accessor source="#ua" count="4" stride="2"><param name="S" type="float"/><param name="T" type="float"/></accessor>
      </technique_common></source>
    <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
    <polylist count="1" material="m"><input semantic="VERTEX" source="#v" offset="0"/>
      <input semantic="TEXCOORD" source="#u" offset="1"/><vcount>4</vcount><p>0 0 1 1 2 2 3 3</p></polylist>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="w"><node id="n"><instance_geometry url="#g"><bind_material><technique_common>
    <instance_material symbol="m" target="#m"/></technique_common></bind_material></instance_geometry></node></visual_scene>
  </library_visual_scenes>
  <scene><instance_visual_scene url="#w"/></scene>
</COLLADA>
)";
}

/// A ZIP archive of files that are stored as they are.
std::string zip(const std::vector<std::pair<std::string, std::string>>& files) {
  const auto two = [](std::size_t value) { return bytes_of_value(static_cast<std::uint16_t>(value)); };
  const auto four = [](std::size_t value) { return bytes_of_value(static_cast<std::uint32_t>(value)); };
  std::string archive, list;
  for (const auto& [name, bytes] : files) {
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size()));
    const std::string common = two(20) + two(0) + two(0) + four(0) + four(sum) + four(bytes.size()) +
                               four(bytes.size()) + two(name.size()) + two(0);
    list += "PK\1\2" + two(20) + common + two(0) + two(0) + two(0) + four(0) + four(archive.size()) + name;
    archive += "PK\3\4" + common + name + bytes;
  }
  const std::string end =
      "PK\5\6" + four(0) + two(files.size()) + two(files.size()) + four(list.size()) + four(archive.size()) + two(0);
  return archive + list + end;
}

const std::string red = "<color>0.5 0.25 0.125 1</color>";
const std::string textured = R"(<texture texture="t" texcoord="UV"/>)";

/// What its material says of the base colour.
MeshParameter base_color(const MeshData& mesh) {
  for (const MeshParameter& parameter : mesh.materials.at(0).openpbr)
    if (parameter.name == "base_color") return parameter;
  return {};
}

std::string texture_of(const std::string& name_in_file, const std::string& file) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(std::filesystem::path(folder.file(file)).parent_path());
  write_text(folder.file(file), "of which nobody reads a byte");
  write_text(folder.file("square.dae"),
             square(textured, R"(<image id="i"><init_from>)" + name_in_file + "</init_from></image>"));
  Diagnostics diagnostics(folder.file("square.dae"));
  const auto mesh = read_mesh(folder.file("square.dae"), {}, diagnostics);
  INFO(printed(diagnostics, folder.path().string()));
  REQUIRE(mesh.has_value());
  std::string found = base_color(*mesh).texture.file;
  return found.starts_with("./") ? found.substr(2) : found;
}

/// What is said of a program with these commands, in the place of raytrace-convert.
std::string refusal_by(const std::string& commands, const std::string& name = "a.fbx") {
  const TemporaryFolder folder;
  const std::string program = folder.file("program"), file = folder.file(name);
  write_text(program, "#!/bin/sh\n" + commands + "\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  write_text(file, "a model");
  Diagnostics diagnostics(file);
  CHECK_FALSE(convert_model_by(program, file, diagnostics).has_value());
  return printed(diagnostics, folder.path().string());
}

}  // namespace

TEST_CASE("converted types are recognized by the file's name") {
  for (const char* const name : {"a.fbx", "a/b.FBX", "a.dae", "a.3ds", "a.blend", "a.x"})
    CHECK(is_converted_model(name));
  for (const char* const name : {"a.obj", "a.glb", "fbx", "a.fbx.gz", "a.xml"}) CHECK_FALSE(is_converted_model(name));
  CHECK(is_mesh_file("a.fbx"));
  CHECK_FALSE(is_mesh_file("a.fbx.gz"));
}

TEST_CASE("a program that fails, crashes or says nothing is an error of the file") {
  CHECK(refusal_by("echo 'no such block' >&2; echo more >&2; exit 1") ==
        "a.fbx: error: cannot be converted to glTF: no such block\n");
  CHECK(refusal_by("exit 0") == "a.fbx: error: cannot be converted to glTF: Assimp does not say why\n");
  CHECK(refusal_by("kill -SEGV $$")
            .starts_with("a.fbx: error: cannot be converted to glTF: Assimp ended by signal 11 ("));
  CHECK(refusal_by("printf '\\033[1mbold\\n' >&2; exit 3") ==
        "a.fbx: error: cannot be converted to glTF: \\x1b[1mbold\n");
  CHECK(refusal_by("echo 'no magic bytes' >&2; exit 1", "a.blend") ==
        "a.blend: error: cannot be converted to glTF: no magic bytes; only files of Blender before 2.8 can be: in "
        "Blender, export as glTF 2.0 (.glb)\n");
  const TemporaryFolder folder;
  Diagnostics diagnostics(folder.file("a.fbx"));
  CHECK_FALSE(convert_model_by(folder.file("none"), folder.file("a.fbx"), diagnostics).has_value());
  CHECK(printed(diagnostics, folder.path().string()) ==
        "a.fbx: error: cannot be converted to glTF: there is no raytrace-convert, which is built where Assimp "
        "(libassimp-dev) is installed\n");
}

TEST_CASE("the program gets the file and a limit, and its output is the model") {
  const TemporaryFolder folder;
  const std::string program = folder.file("program"), file = folder.file("a.fbx");
  write_text(program, "#!/bin/sh\n[ \"$2\" -gt 1000000 ] && cat \"$1\"; cat\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  write_text(file, "a model");
  Diagnostics diagnostics(file);
  const auto model = convert_model_by(program, file, diagnostics);
  REQUIRE(model.has_value());
  CHECK(std::string(model->glb.data(), model->size) == "a model");
}

#if defined(RAYTRACE_ASSIMP)

TEST_CASE("Collada becomes a mesh with its material") {
  const ReadResult read = read_bytes("square.dae", square(red));
  CHECK(read.messages.empty());
  REQUIRE(read.mesh.has_value());
  const MeshData& mesh = *read.mesh;
  CHECK(mesh.face_count() == 2);
  CHECK(mesh.vertex_count() >= 4);
  float most = 0;
  for (std::size_t i = 0; i < mesh.positions.size(); i += 3) {
    most = std::max({most, mesh.positions[i], mesh.positions[i + 1]});
    CHECK(mesh.positions[i + 2] == 2);
  }
  CHECK(most == 3);
  CHECK(mesh.uvs.size() == 2 * mesh.vertex_count());
  CHECK(mesh.normals.size() == 3 * mesh.vertex_count());
  const Rgb<double> color = base_color(mesh).value;
  CHECK(color.red == Approx(0.5));
  CHECK(color.green == Approx(0.25));
  CHECK(color.blue == Approx(0.125));
}

TEST_CASE("Collada's transparency of 0, which would show nothing, is taken as opaque") {
  const std::string none =
      "<transparent opaque='A_ONE'><color>1 1 1 1</color></transparent>"
      "<transparency><float>0</float></transparency>";
  const ReadResult read = read_bytes("square.dae", square(red, "", none));
  REQUIRE(read.mesh.has_value());
  CHECK(read.mesh->materials.at(0).d == 1);
  CHECK(read.messages ==
        "square.dae: warning: an opacity of 0, which would show nothing, is taken as opaque, of the material "
        "'paint'\n");
}

TEST_CASE("textures are found where they are, whatever the machine was that the model was made on") {
  CHECK(texture_of("paint.png", "paint.png") == "paint.png");
  CHECK(texture_of("PAINT.PNG", "paint.png") == "paint.png");
  CHECK(texture_of("C:\\work\\paint.png", "textures/paint.png") == "textures/paint.png");
  CHECK(texture_of("/home/me/paint.png", "square.fbm/Paint.png") == "square.fbm/Paint.png");
  CHECK(texture_of("elsewhere.png", "paint.png") == "elsewhere.png");
}

TEST_CASE("faces that share vertices without normals are smooth but for sharp edges") {
  // A cube.
  const ReadResult cube = read_bytes("cube.off",
                                     "OFF\n8 6 12\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
                                     "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
  REQUIRE(cube.mesh.has_value());
  CHECK(cube.mesh->vertex_count() == 24);
  const auto vector = [](const MeshBuffer<float>& values, std::uint32_t i) {
    return Vec3d(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  };
  const auto each_corner = [&](const MeshData& mesh, const auto& check) {
    REQUIRE(mesh.normals.size() == mesh.positions.size());
    const auto corners = static_cast<std::size_t>(mesh.corners);
    for (std::size_t face = 0; face < mesh.face_count(); ++face) {
      const std::uint32_t* const of = &mesh.indices[corners * face];
      const Vec3d a = vector(mesh.positions, of[0]), b = vector(mesh.positions, of[1]),
                  c = vector(mesh.positions, of[2]), normal = normalize(cross(b - a, c - a));
      for (std::size_t k = 0; k < corners; ++k)
        check(normal, vector(mesh.positions, of[k]), vector(mesh.normals, of[k]));
    }
  };
  each_corner(*cube.mesh, [](const Vec3d& of_face, const Vec3d&, const Vec3d& normal) {
    CHECK(dot(of_face, normal) == Approx(1));
  });
  // A flat roof, whose ridge is round.
  const ReadResult roof =
      read_bytes("roof.off", "OFF\n6 2 7\n-1 0 0\n-1 0 -1\n0 0.1 0\n0 0.1 -1\n1 0 0\n1 0 -1\n4 0 2 3 1\n4 2 4 5 3\n");
  REQUIRE(roof.mesh.has_value());
  each_corner(*roof.mesh, [](const Vec3d& of_face, const Vec3d& position, const Vec3d& normal) {
    if (position.x == 0)
      CHECK(std::abs(normal.x) < 0.05);  // one side's diagonal ends there
    else
      CHECK(dot(of_face, normal) == Approx(1));
  });
}

TEST_CASE("tangents of faces that share vertices without normals go with their corners") {
  // Corners of triangles are more than those of quads. What is read behind an array shows in the sanitizers' build.
  const auto source = [](const std::string& id, const std::string& numbers) {
    return "<source id='" + id + "'><float_array id='" + id + "a' count='12'>" + numbers +
           "</float_array><technique_common><accessor source='#" + id +
           "a' count='4' stride='3'><param name='X' type='float'/><param name='Y' type='float'/><param name='Z' "
           "type='float'/></accessor></technique_common></source>";
  };
  const std::string ways = "1 0 0 1 0 0 1 0 0 1 0 0";
  const ReadResult read = read_bytes(
      "quad.dae",
      "<?xml version='1.0'?><COLLADA xmlns='http://www.collada.org/2005/11/COLLADASchema' version='1.4.1'><asset>"
      "<unit meter='1'/><up_axis>Y_UP</up_axis></asset><library_geometries><geometry id='g'><mesh>" +
          source("p", "0 0 0 1 0 0 1 1 0 0 1 0") + source("t", ways) + source("b", ways) +
          "<vertices id='v'><input semantic='POSITION' source='#p'/></vertices><polylist count='1'><input "
          "semantic='VERTEX' source='#v' offset='0'/><input semantic='TEXTANGENT' source='#t' offset='1'/><input "
          "semantic='TEXBINORMAL' source='#b' offset='2'/><vcount>4</vcount><p>0 0 0 1 1 1 2 2 2 3 3 3</p></polylist>"
          "</mesh></geometry></library_geometries><library_visual_scenes><visual_scene id='s'><node><instance_geometry "
          "url='#g'/></node></visual_scene></library_visual_scenes><scene><instance_visual_scene url='#s'/></scene>"
          "</COLLADA>");
  INFO(read.messages);
  REQUIRE(read.mesh);
  CHECK(read.mesh->face_count() == 2);
}

TEST_CASE("3MF, whose z is up, is turned so that y is up") {
  const std::string model =
      R"(<?xml version="1.0"?><model unit="millimeter" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02">
      <resources><object id="1" type="model"><mesh><vertices><vertex x="0" y="0" z="0"/><vertex x="1" y="0" z="0"/>
      <vertex x="0" y="2" z="0"/><vertex x="0" y="0" z="3"/></vertices><triangles><triangle v1="0" v2="2" v3="1"/>
      <triangle v1="0" v2="1" v3="3"/><triangle v1="1" v2="2" v3="3"/><triangle v1="2" v2="0" v3="3"/></triangles></mesh>
      </object></resources><build><item objectid="1"/></build></model>)";
  const std::string relations =
      R"(<?xml version="1.0"?><Relationships xmlns="http://schemas.openxmlformats.org/package/2006/relationships">
      <Relationship Target="/3D/a.model" Id="r" Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/>
      </Relationships>)";
  const ReadResult read = read_bytes("a.3mf", zip({{"_rels/.rels", relations}, {"3D/a.model", model}}));
  INFO(read.messages);
  REQUIRE(read.mesh.has_value());
  Vec3d least(9, 9, 9), most(-9, -9, -9);
  for (std::size_t i = 0; i < read.mesh->positions.size(); i += 3) {
    const float* const p = &read.mesh->positions[i];
    least = {std::min<double>(least.x, p[0]), std::min<double>(least.y, p[1]), std::min<double>(least.z, p[2])};
    most = {std::max<double>(most.x, p[0]), std::max<double>(most.y, p[1]), std::max<double>(most.z, p[2])};
  }
  CHECK(most.x == Approx(1));
  CHECK(most.y == Approx(3));
  CHECK(least.z == Approx(-2));
  CHECK(std::abs(least.y) < 1e-6);
  CHECK(std::abs(most.z) < 1e-6);
}

TEST_CASE("what is no model is refused with Assimp's reason") {
  for (const std::string& name : {std::string("a.fbx"), std::string("a.dae"), std::string("a.blend")}) {
    const ReadResult read = read_bytes(name, "hello");
    CHECK_FALSE(read.mesh.has_value());
    INFO(read.messages);
    CHECK(read.messages.starts_with(name + ": error: cannot be converted to glTF: "));
    CHECK(read.messages.find("does not say why") == std::string::npos);
  }
  CHECK(read_bytes("a.fbx", "").messages == "a.fbx: error: is empty\n");
}

#endif

}  // namespace raytrace::test
