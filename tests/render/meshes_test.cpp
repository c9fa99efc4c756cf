// Meshes are what they are made of: their pictures are those of single triangles, and smooth ones look round.
#include <cmath>
#include <fstream>
#include <numbers>
#include <random>
#include <sstream>

#include "raytrace/aovs/aov_selection.h"
#include "raytrace/description/check_scene.h"
#include "render/scenes.h"
#include "support/catch.h"
#include "support/temporary_folder.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

const std::string lit_materials =
    "<lights><ambientlight><scaleradiance>0.2</scaleradiance></ambientlight><pointlights><pointlight>"
    "<location x='6' y='9' z='10'/><scaleradiance>2</scaleradiance></pointlight></pointlights></lights>"
    "<materials><phongs><phong><name>red</name><ka>1</ka><kd>0.7</kd><ks>0.3</ks><cd red='1' green='0.3' blue='0.2'/>"
    "<cs red='1' green='1' blue='1'/><exp>20</exp></phong></phongs></materials>";

std::string mesh_scene(const std::string& objects) {
  return scene_text(64, 48, 4, lit_materials + "<objects>" + objects + "</objects>");
}

std::string mesh_element(const std::string& positions, const std::string& faces, const std::string& more = {}) {
  return "<meshes><mesh><positions>" + positions + "</positions><faces>" + faces + "</faces>" + more +
         "<material>red</material></mesh></meshes>";
}

/// A sphere of radius 3 of quads, or of triangles.
struct SphereMesh {
  std::string positions, quads, triangles, normals;

  explicit SphereMesh(int columns) {
    std::ostringstream points, four, three, directions;
    const int rows = columns / 2;
    for (int row = 0; row <= rows; ++row)
      for (int column = 0; column < columns; ++column) {
        const double theta = std::numbers::pi * row / rows, phi = 2 * std::numbers::pi * column / columns;
        const Vec3d n(std::sin(theta) * std::cos(phi), std::cos(theta), -std::sin(theta) * std::sin(phi));
        points << 3 * n.x << ' ' << 3 * n.y << ' ' << 3 * n.z << ", ";
        directions << n.x << ' ' << n.y << ' ' << n.z << ", ";
        if (row == rows) continue;
        const int next = (column + 1) % columns;
        const int a = row * columns + column, b = a + columns, c = (row + 1) * columns + next, d = row * columns + next;
        four << a << ' ' << b << ' ' << c << ' ' << d << ", ";
        three << a << ' ' << b << ' ' << d << ", " << c << ' ' << d << ' ' << b << ", ";
      }
    positions = points.str(), quads = four.str(), triangles = three.str(), normals = directions.str();
  }
};

struct PictureDifference {
  double mean = 0, worst = 0;
};

PictureDifference compared(const FloatPicture& a, const FloatPicture& b) {
  PictureDifference result;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const double d = difference(a.pixels()[i], b.pixels()[i]);
    result.mean += d / static_cast<double>(a.pixels().size());
    result.worst = std::max(result.worst, d);
  }
  return result;
}

}  // namespace

TEST_CASE("a flat mesh of triangles has the picture of single triangles, to the bit") {
  std::mt19937 bits(7);
  const auto coordinate = [&] { return std::to_string(static_cast<double>(bits() % 8000) / 1000 - 4); };
  std::string positions, faces, triangles;
  for (int i = 0; i < 300; ++i) {
    std::string triangle = "<triangle>";
    for (int corner = 0; corner < 3; ++corner) {
      const std::string x = coordinate(), y = coordinate(), z = coordinate(), number = std::to_string(corner + 1);
      positions += x + " " + y + " " + z + ", ";
      faces += std::to_string(3 * i + corner) + " ";
      triangle += "<vertexposition" + number + " x='" + x + "' y='" + y + "' z='" + z + "'/>";
    }
    triangles += triangle + "<material>red</material></triangle>";
  }
  const SceneDescription mesh = parsed_scene(mesh_scene(mesh_element(positions, faces)));
  const SceneDescription single = parsed_scene(mesh_scene("<triangles>" + triangles + "</triangles>"));
  for (const std::string& isa : usable_isas()) {
    INFO(isa);
    CHECK(identical(rendered(mesh, 1, isa), rendered(single, 1, isa)));
  }
}

TEST_CASE("quads have the picture of their two triangles") {
  const SphereMesh sphere(24);
  for (const char* normals : {"<normals>flat</normals>", "<normals>smooth</normals>"}) {
    const FloatPicture quads = rendered(mesh_scene(mesh_element(sphere.positions, sphere.quads, normals)));
    const FloatPicture triangles = rendered(mesh_scene(mesh_element(sphere.positions, sphere.triangles, normals)));
    INFO(normals);
    CHECK(compared(quads, triangles).mean < 1e-5);
  }
}

TEST_CASE("a smooth mesh of a sphere looks like the sphere") {
  const SphereMesh sphere(96);
  const std::string shape =
      "<spheres><sphere><center x='0' y='0' z='0'/><radius>3</radius><material>red</material>"
      "</sphere></spheres>";
  const FloatPicture wanted = rendered(mesh_scene(shape));
  const std::string own = "<normals>" + sphere.normals + "</normals>";
  const auto difference_of = [&](const std::string& normals) {
    return compared(rendered(mesh_scene(mesh_element(sphere.positions, sphere.triangles, normals))), wanted).mean;
  };
  const double flat = difference_of("<normals>flat</normals>");
  CHECK(flat < 0.002);
  CHECK(difference_of("<normals>smooth</normals>") < flat / 2);
  CHECK(difference_of(own) < flat / 2);
}

TEST_CASE("a coarse smooth mesh has no edges of its faces where the shadow begins") {
  // Alone, and convex: where its normals face the light, nothing lies between.
  const SphereMesh sphere(12);
  const std::string text =
      mesh_scene(mesh_element(sphere.positions, sphere.triangles, "<normals>" + sphere.normals + "</normals>"));
  std::string without_shadows = text;
  const std::string place = "</scaleradiance></pointlight>";
  without_shadows.insert(without_shadows.find(place) + place.find("</pointlight>"), "<shadows>false</shadows>");
  CHECK(compared(rendered(text), rendered(without_shadows)).worst < 0.02);
}

TEST_CASE("smooth normals do not depend on the threads, nor on vertices that were split for uvs") {
  const SphereMesh sphere(48);
  const SceneDescription scene =
      parsed_scene(mesh_scene(mesh_element(sphere.positions, sphere.quads, "<normals>smooth</normals>")));
  CHECK(identical(rendered(scene, 1), rendered(scene, 3)));
  // The first column's vertices at the poles are all one position: were they not one vertex, the pole would have
  // facets.
  const std::string above = "<eye x='0' y='12' z='0.1'/><lookat x='0' y='0' z='0'/>";
  const auto from_above = [&](const std::string& objects) {
    return rendered(scene_text(64, 48, 4, lit_materials + "<objects>" + objects + "</objects>", above));
  };
  const std::string ball =
      "<spheres><sphere><center x='0' y='0' z='0'/><radius>3</radius><material>red</material>"
      "</sphere></spheres>";
  CHECK(
      compared(from_above(mesh_element(sphere.positions, sphere.quads, "<normals>smooth</normals>")), from_above(ball))
          .mean < 0.004);
}

TEST_CASE("the normals that stand in the scene turn to the viewer with the faces") {
  // A square across the view, shaded by a normal that leans; it is the same from behind.
  const std::string square = "-2 -2 0, 2 -2 0, 2 2 0, -2 2 0", faces = "0 1 2 3,";
  const auto mean_of = [&](const std::string& corners, const std::string& normal) {
    const FloatPicture picture = rendered(mesh_scene(mesh_element(
        square, corners, "<normals>" + normal + "," + normal + "," + normal + "," + normal + "</normals>")));
    return picture.pixels()[64 * 24 + 32];
  };
  const Pixel front = mean_of(faces, "0 0.6 0.8"), reversed = mean_of("3 2 1 0,", "0 -0.6 -0.8");
  CHECK(difference(front, reversed) < 1e-5);
  CHECK(difference(front, mean_of(faces, "0 0 1")) > 0.01);
}

TEST_CASE("a file's materials are the mesh's where the scene gives none, and grey is for the rest") {
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "two.mtl") << "newmtl green\nKd 0 1 0\nnewmtl shiny blue\nKd 0 0 1\nKs 1 1 1\nNs 10\n";
  std::ofstream(folder.path() / "two.obj")
      << "mtllib two.mtl\nv -3 -3 0\nv -1 -3 0\nv -1 3 0\nv 1 -3 0\nv 3 -3 0\nv 3 3 0\nv -1 -3 0\nv 1 -3 0\nv 0 3 0\n"
         "f 7 8 9\nusemtl green\nf 1 2 3\nusemtl shiny blue\nf 4 5 6\n";
  const auto scene = [&](const std::string& material) {
    return parsed_scene(mesh_scene("<meshes><mesh><file>" + (folder.path() / "two.obj").string() + "</file>" +
                                   material + "</mesh></meshes>"));
  };
  const SceneDescription own = scene("");
  CHECK(material_names(own) == std::vector<std::string>{"green", "grey", "red", "shiny blue"});
  const auto built = build_scene(own, {1, {}});
  RayCounts rays;
  RenderSettings settings{1, 0, whole(own)};
  settings.aovs = aov_set({"material_id"});
  const FloatPicture picture = render(*built, own, settings, rays);
  const auto color = [&](std::size_t column) { return picture.pixels()[64 * 34 + column]; };
  const Pixel left = color(24), middle = color(32), right = color(41);
  CHECK((left.green > 0.1 && left.red == 0 && left.blue == 0));
  CHECK((middle.green > 0.1 && middle.red == middle.green && middle.blue == middle.green));
  CHECK((right.blue > 0.1 && right.blue > right.red));
  const FloatPicture red = rendered(scene("<material>red</material>"));
  for (const std::size_t column : {24U, 32U, 41U}) {
    const Pixel pixel = red.pixels()[64 * 34 + column];
    CHECK(pixel.red > 2 * pixel.green);
  }
}

TEST_CASE("a mesh far from the origin is as precise as near it") {
  const SphereMesh sphere(24);
  const TemporaryFolder folder;
  const auto write = [&](const char* name, double offset, double size) {
    std::ofstream file(folder.path() / name);
    file.precision(17);
    std::istringstream numbers(sphere.positions);
    std::string point;
    while (std::getline(numbers, point, ',')) {
      double x = 0, y = 0, z = 0;
      if (std::istringstream(point) >> x >> y >> z)
        file << "v " << size * x + offset << ' ' << size * y << ' ' << size * z - offset << '\n';
    }
    std::istringstream faces(sphere.triangles);
    std::string face;
    while (std::getline(faces, face, ',')) {
      int a = 0, b = 0, c = 0;
      if (std::istringstream(face) >> a >> b >> c) file << "f " << a + 1 << ' ' << b + 1 << ' ' << c + 1 << '\n';
    }
  };
  const double away = 16777216;
  write("near.obj", 0, 1);
  write("far.obj", away, 1);
  write("small.obj", 2000, 0.001);
  const auto picture = [&](const char* name, double offset, double size) {
    const std::string camera =
        vector_text("eye", offset, 2 * size, 12 * size - offset) + vector_text("lookat", offset, 0, -offset);
    return rendered(scene_text(64, 48, 4,
                               "<lights><directionallights><directionallight><direction x='1' y='2' z='3'/>"
                               "</directionallight></directionallights></lights><objects><meshes><mesh><file>" +
                                   (folder.path() / name).string() + "</file></mesh></meshes></objects>",
                               camera));
  };
  const FloatPicture near = picture("near.obj", 0, 1);
  CHECK(compared(near, picture("far.obj", away, 1)).mean < 1e-3);
  CHECK(compared(near, picture("small.obj", 2000, 0.001)).mean < 1e-3);
}

TEST_CASE("a mesh that was not loaded is refused") {
  Diagnostics diagnostics("s");
  const auto scene = parse_scene(mesh_scene("<meshes><mesh><file>none.ply</file></mesh></meshes>"), diagnostics);
  REQUIRE(scene);
  CHECK_THROWS_AS(build_scene(*scene, {1, {}}), SceneError);
}

}  // namespace raytrace::test
