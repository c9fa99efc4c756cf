#include <algorithm>
#include <cmath>

#include "import/support.h"
#include "support/catch.h"
#include "support/contains.h"

using namespace raytrace;
using namespace raytrace::test;

namespace {

using Indices = std::vector<std::uint32_t>;
using Floats = std::vector<float>;

}  // namespace

TEST_CASE("an OBJ vertex is a combination of v, vt and vn") {
  const ReadResult read = read_bytes("a.obj",
                                     "# a comment \\\no thing\r\nv 0 0 0\r\nv 1 0 \\\r\n 0\nv 1 1 0\nv 0 1 0\n"
                                     "vt 0 0\nvt 0.5 1 0\nvn 0 0 1\ng a b\ns off\n"
                                     "f 1/1/1 2/2/1 3/1/1 # inline\nf -4/1/1 -2/2/-1 -1//1\n");
  INFO(read.messages);
  REQUIRE(read.mesh);
  CHECK(read.messages.empty());
  CHECK(values(read.mesh->indices) == Indices{0, 1, 2, 0, 3, 4});
  CHECK(values(read.mesh->positions) == Floats{0, 0, 0, 1, 0, 0, 1, 1, 0, 1, 1, 0, 0, 1, 0});
  CHECK(values(read.mesh->uvs) == Floats{0, 0, 0.5F, 1, 0, 0, 0.5F, 1, 0, 0});
  CHECK(values(read.mesh->normals) == Floats{0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
}

TEST_CASE("an OBJ file of equal indices keeps its vertices, with colours") {
  const ReadResult read =
      read_bytes("a.obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0.04\nv 1 1 0 0.5 0 2\nvt 0 0\nvt 1 0\nvt 1 1\nf 3/3 1/1 2/2\n");
  REQUIRE(read.mesh);
  CHECK(values(read.mesh->indices) == Indices{2, 0, 1});
  CHECK(values(read.mesh->uvs) == Floats{0, 0, 1, 0, 1, 1});
  // Colours are sRGB's, and may be brighter than white.
  const auto dark = static_cast<float>(0.04 / 12.92), bright = static_cast<float>(4.953845751592042);
  CHECK(values(read.mesh->colors) == Floats{1, 0, 0, 0, 1, dark, 0.21404114F, 0, bright});
}

TEST_CASE("an OBJ file's materials come from its MTL files") {
  const TemporaryFolder folder;
  write_text(
      folder.file("my materials.mtl"),
      "newmtl dark red\nKa 0.1\nKd 0.5 0 0\nKs 1 1 1\nNs 30\nTr 0.25\nillum 2\n"
      "map_Kd -s 2 3 1 -o 0.5 -clamp on textures\\a wood.png\nmap_Ks -bm 0.5 gloss.png\nmap_Bump bump.png\nKs red\n"
      "newmtl other\nKd 1 1 1\n");
  write_text(folder.file("a.obj"),
             "mtllib my materials.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nusemtl dark red\nf 1 2 3\nf 3 2 1\n"
             "usemtl missing\nf 2 3 1\n");
  Diagnostics diagnostics(folder.file("a.obj"));
  const auto mesh = read_mesh(folder.file("a.obj"), {}, diagnostics);
  REQUIRE(mesh);
  CHECK(values(mesh->face_materials) == Indices{MeshData::no_material, 0, 0, 1});
  REQUIRE(mesh->materials.size() == 2);
  const MeshMaterial& red = mesh->materials[0];
  CHECK(red.name == "dark red");
  CHECK(red.kd->red == 0.5);
  CHECK(red.kd->blue == 0);
  CHECK(red.ns == 30);
  CHECK(red.d == 0.75);
  CHECK(red.illum == 2);
  CHECK(red.map_kd.file == "textures/a wood.png");
  CHECK(red.map_kd.scale == std::array<double, 2>{2, 3});
  CHECK(red.map_kd.offset == std::array<double, 2>{0.5, 0});
  CHECK(red.map_bump.file == "bump.png");
  CHECK(red.map_kd.edge_u == MeshTexture::Edge::clamp);
  CHECK(red.map_kd.edge_v == MeshTexture::Edge::clamp);
  CHECK(red.openpbr.empty());
  CHECK(mesh->materials[1].name == "missing");
  CHECK(printed(diagnostics, folder.path().string()) ==
        "a.obj:1: warning: my materials.mtl:9: 'map_ks' is left out, here and in the rest of the file\n"
        "a.obj:1: warning: my materials.mtl:11: 'ks' needs one or three numbers\n"
        "a.obj:9: warning: no material 'missing' in the material libraries\n");
}

TEST_CASE("nothing is said of an OBJ file's materials that are overridden") {
  const TemporaryFolder folder;
  write_text(folder.file("a.mtl"),
             "newmtl red\nKd 1 0 0\nd 0\nKs red\nmap_Ks gloss.png\nnewmtl blue\nd 0\nmap_Ks gloss.png\n");
  write_text(folder.file("a.obj"),
             "mtllib a.mtl\nmtllib b.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl red\nf 1 2 3\nusemtl blue\nf 1 2 3\n"
             "usemtl lost\nf 1 2 3\n");
  const auto told = [&](const std::function<bool(std::string_view)>& is_overridden) {
    Diagnostics diagnostics(folder.file("a.obj"));
    CHECK(read_mesh(folder.file("a.obj"), {.is_overridden = is_overridden}, diagnostics));
    return printed(diagnostics, folder.path().string());
  };
  const std::string no_library = "a.obj:2: warning: 'b.mtl': ";
  const std::string all = told(nullptr);
  for (const std::string& part :
       {no_library, std::string("'red', 'blue'"), std::string("'ks' needs"), std::string("'lost'")})
    CHECK(contains(all, part));
  const std::string of_others = told([](std::string_view name) { return name == "red" || name == "lost"; });
  CHECK(contains(
      of_others,
      "a.obj: warning: an opacity of 0, which would show nothing, is taken as opaque, of the material 'blue'\n"));
  CHECK(contains(of_others, "a.mtl:8: 'map_ks' is left out"));
  CHECK(contains(of_others, no_library));
  CHECK_FALSE(contains(of_others, "'ks' needs"));
  CHECK_FALSE(contains(of_others, "'lost'"));
  CHECK(told([](std::string_view) { return true; }).empty());
}

TEST_CASE("an MTL's material of opacity 0 is opaque, and a warning names it") {
  const TemporaryFolder folder;
  write_text(folder.file("a.mtl"),
             "newmtl lab\nKd 1 0 0\nTr 1.0\nnewmtl leaf\nd 0\nmap_d leaf.png\nnewmtl pane\nd 0.25\n"
             "newmtl spare\nd 0\nnewmtl glass\nTr 1\nillum 4\nnewmtl hidden\nd 0\nillum 9\n");
  write_text(folder.file("a.obj"),
             "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl pane\nf 1 2 3\nusemtl lab\nf 1 2 3\nusemtl leaf\n"
             "f 1 2 3\nusemtl glass\nf 1 2 3\nusemtl spare\nusemtl hidden\nf 1 2 3\n");
  Diagnostics diagnostics(folder.file("a.obj"));
  const auto mesh = read_mesh(folder.file("a.obj"), {}, diagnostics);
  REQUIRE(mesh);
  REQUIRE(mesh->materials.size() == 6);
  for (const MeshMaterial& material : mesh->materials)
    CHECK(material.d.value_or(1) == (material.name == "pane" ? 0.25 : material.name == "hidden" ? 0 : 1));
  CHECK(printed(diagnostics, folder.path().string()) ==
        "a.obj: warning: an opacity of 0, which would show nothing, is taken as opaque, of the materials 'lab', "
        "'leaf'\n");
}

TEST_CASE("an MTL's metals, glass and lamps are OpenPBR's") {
  const TemporaryFolder folder;
  write_text(folder.file("a.mtl"),
             "newmtl plain\nKd 0.5 0.5 0.5\nKs 0 0 0\nKe 0 0 0\nNi 1.45\nd 1\nillum 2\n"
             "newmtl gold\nKd 1 0.7 0.3\nPm 1\nPr 0.2\nmap_Pr rough.png\nPc 0.5\nPcr 0.1\nPs 0.25\naniso 0.75\n"
             "newmtl glass\nKd 0 0 0\nNi 1.6\nTf 0.9 1 0.9\nd 0.3\nillum 7\n"
             "newmtl opaque\nTf 0 0 0\nillum 4\n"
             "newmtl mirror\nKd 0 0 0\nKs 0.9 0.8 0.7\nillum 3\n"
             "newmtl lamp\nKd 0 0 0\nKs 0 0 0\nKe 5 4 3\n"
             "newmtl screen\nmap_Ke film.png\nKs 1 1 1\nNs 98\n");
  write_text(folder.file("a.obj"),
             "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl plain\nf 1 2 3\nusemtl gold\nf 1 2 3\nusemtl glass\n"
             "f 1 2 3\nusemtl opaque\nf 1 2 3\nusemtl mirror\nf 1 2 3\nusemtl lamp\nf 1 2 3\nusemtl screen\nf 1 2 3\n");
  Diagnostics diagnostics(folder.file("a.obj"));
  const auto mesh = read_mesh(folder.file("a.obj"), {}, diagnostics);
  REQUIRE(mesh);
  CHECK(diagnostics.kept().empty());
  const auto parameter = [&](std::string_view material, std::string_view name) -> MeshParameter {
    for (const MeshMaterial& one : mesh->materials)
      if (one.name == material)
        for (const MeshParameter& parameter : one.openpbr)
          if (parameter.name == name) return parameter;
    return {"none", {-1, -1, -1}};
  };
  const auto number = [&](std::string_view material, std::string_view name) {
    return parameter(material, name).value.red;
  };
  CHECK(number("plain", "base_color") == -1);
  CHECK(number("opaque", "base_color") == -1);
  CHECK(parameter("gold", "base_color").value.blue == 0.3);
  CHECK(number("gold", "base_metalness") == 1);
  CHECK(number("gold", "specular_roughness") == 0.2);
  CHECK(parameter("gold", "specular_roughness").texture.file == "rough.png");
  CHECK(number("gold", "coat_weight") == 0.5);
  CHECK(number("gold", "coat_roughness") == 0.1);
  CHECK(number("gold", "fuzz_weight") == 0.25);
  CHECK(number("gold", "specular_roughness_anisotropy") == 0.75);
  CHECK(number("glass", "transmission_weight") == 1);
  CHECK(number("glass", "transmission_color") == Approx(std::sqrt(0.9)));  // of each of its two faces
  CHECK(number("glass", "specular_ior") == 1.6);
  CHECK(number("glass", "specular_roughness") == 0);
  CHECK(number("mirror", "base_metalness") == 1);
  CHECK(parameter("mirror", "base_color").value.green == 0.8);
  CHECK(parameter("lamp", "emission_color").value.blue == 3);
  CHECK(number("lamp", "specular_weight") == 0);
  CHECK(parameter("screen", "emission_color").texture.file == "film.png");
  CHECK(number("screen", "specular_roughness") == Approx(std::pow(0.02, 0.25)));
}

TEST_CASE("an MTL's alpha is no glass, whatever its illum says, unless it says what passes") {
  const auto material = [](const std::string& statements) {
    const TemporaryFolder folder;
    write_text(folder.file("a.mtl"), "newmtl a\nKd 0.9 0.4 0.1\nKs 0.5 0.5 0.5\nNi 1.5\n" + statements);
    write_text(folder.file("a.obj"), "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl a\nf 1 2 3\n");
    Diagnostics diagnostics(folder.file("a.obj"));
    const auto mesh = read_mesh(folder.file("a.obj"), {}, diagnostics);
    REQUIRE(mesh);
    CHECK(diagnostics.kept().empty());
    return mesh->materials.at(0);
  };
  const auto is_glass = [](const MeshMaterial& of) {
    return std::any_of(of.openpbr.begin(), of.openpbr.end(),
                       [](const MeshParameter& parameter) { return parameter.name == "transmission_weight"; });
  };
  for (const std::string illum : {"4", "6", "7", "9"}) {
    INFO(illum);
    const MeshMaterial veil = material("d 0.4\nillum " + illum + '\n'),
                       leaf = material("map_d leaf.png\nd 1\nillum " + illum + '\n'),
                       glass = material("d 1\nillum " + illum + '\n'),
                       tinted = material("d 0.4\nTf 1 1 1\nillum " + illum + '\n');
    CHECK_FALSE(is_glass(veil));
    CHECK(veil.d == 0.4);
    CHECK_FALSE(is_glass(leaf));
    CHECK(is_glass(glass));
    CHECK(is_glass(tinted));
    CHECK_FALSE(tinted.d);
  }
  // As glTF's.
  const MeshMaterial coated = material("Pr 0.5\nPc 0.5\n");
  const auto number = [&](std::string_view name) {
    for (const MeshParameter& parameter : coated.openpbr)
      if (parameter.name == name) return parameter.value.red;
    return -1.0;
  };
  CHECK(number("coat_ior") == 1.5);
  CHECK(number("coat_darkening") == 0);
}

TEST_CASE("the colours of an OBJ's vertices are those of its materials without a texture") {
  const TemporaryFolder folder;
  write_text(folder.file("a.mtl"),
             "newmtl plain\nKd 1 1 1\nnewmtl rough\nPr 0.5\nnewmtl painted\nmap_Kd a.png\nPr 0.5\n");
  const auto read = [&](const std::string& color) {
    write_text(folder.file("a.obj"), "mtllib a.mtl\nv 0 0 0" + color + "\nv 1 0 0\nv 1 1 0\nusemtl plain\nf 1 2 3\n" +
                                         "usemtl rough\nf 1 2 3\nusemtl painted\nf 1 2 3\n");
    Diagnostics diagnostics(folder.file("a.obj"));
    return read_mesh(folder.file("a.obj"), {}, diagnostics)->materials;
  };
  const std::vector<MeshMaterial> colored = read(" 1 0.5 0"), plain = read("");
  REQUIRE(colored.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(colored[i].vertex_colors);
    CHECK_FALSE(plain[i].vertex_colors);
  }
  CHECK(colored[1].openpbr.at(0).of_vertices);
  CHECK_FALSE(colored[2].openpbr.at(0).of_vertices);
}

TEST_CASE("what is wrong in an OBJ file is an error in its line") {
  CHECK(read_bytes("a.obj", "v 0 0 0\nv 1 0\nv 1 x 0\nvt\nf 1 2 3\n").messages ==
        "a.obj:2: error: needs at least 3 numbers\na.obj:3: error: 'x' is no number\n"
        "a.obj:4: error: needs at least 1 numbers\n");
  CHECK(read_bytes("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 4\nf 1 -4 2\nf 1 0 2\nf 1/1 2 3\nf a b c\n").messages ==
        "a.obj:4: error: '4' is not one of the 3 vertices\na.obj:5: error: '-4' is not one of the 3 vertices\n"
        "a.obj:6: error: '0' is not one of the 3 vertices\na.obj:7: error: '1/1' is not one of the 0 texture "
        "coordinates\n"
        "a.obj:8: error: 'a' is no corner of a face, which is v, v/vt, v//vn or v/vt/vn\n");
  CHECK(read_bytes("a.obj", "").messages == "a.obj: error: is empty\n");
  CHECK(contains(read_bytes("a.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2\nf 1 2 3\n").messages,
                 "a.obj:4: warning: 1 statements are skipped, the first of which is 'l'"));
}

TEST_CASE("what an OBJ file has as objects are parts of the mesh") {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const auto parts = [&](const std::string& text, int corners) {
    const ReadResult read = read_bytes("a.obj", vertices + text);
    INFO(read.messages);
    REQUIRE(read.mesh);
    CHECK(read.mesh->corners == corners);
    std::string found;
    for (const MeshPart& part : read.mesh->parts) found += part.name + ":" + std::to_string(part.first_face) + " ";
    return found;
  };
  // Objects without faces are none, those of one name that follow each other are one, and groups are none.
  const std::string triangle = "f 1 2 3\n", quad = "f 1 2 3 4\n";
  CHECK(parts(triangle + "o  a wheel \n" + triangle + "g left\n" + quad + "o curve\nl 1 2\no door\n" + triangle +
                  "s off\no door\ng x\n" + triangle + "o a wheel\n" + triangle,
              3) == "default:0 a wheel:1 door:4 a wheel:6 ");
  CHECK(parts("o a\n" + quad + quad + "o b\n" + quad + triangle + "o\n" + quad, 4) == "a:0 b:2 default:4 ");
  CHECK(parts("o a\n" + quad + "g b\n" + quad, 4).empty());
  CHECK(parts("g a\n" + quad + "g b\n" + quad, 4).empty());
  // Faces that are left out move the parts behind them.
  CHECK(parts("o a\nf 1 2 2\n" + triangle + "o b\nf 1 1 2\n" + triangle + triangle, 3) == "a:0 b:1 ");
}

TEST_CASE("the parts of an OBJ file of many chunks begin where its objects do") {
  std::string text = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  constexpr std::size_t objects = 3000, faces = 40;
  for (std::size_t i = 0; i < objects; ++i) {
    text += "o part " + std::to_string(i) + "\ng group " + std::to_string(i) + "\n";
    for (std::size_t k = 0; k < faces; ++k) text += "f 1 2 3\n";
  }
  const ReadResult read = read_bytes("a.obj", text);
  REQUIRE(read.mesh);
  REQUIRE(read.mesh->parts.size() == objects);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < objects; ++i) {
    const MeshPart& part = read.mesh->parts[i];
    wrong += part.name != "part " + std::to_string(i) || part.first_face != faces * i ? 1 : 0;
  }
  CHECK(wrong == 0);
}
