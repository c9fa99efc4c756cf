// Coarse meshes with normals at vertices look like the smooth surfaces that they stand for: under lamps that have a
// size, with relief, and where metal is brushed.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include "raytrace/import/vertex_tangents.h"
#include "render/scenes.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

double share(std::uint32_t part, std::uint32_t whole) { return static_cast<double>(part) / static_cast<double>(whole); }

/// A sphere of radius 1 about the origin, of triangles along its texture coordinates. Where u begins is behind, since
/// tangents there have faces on one side only.
struct CutSphere {
  std::vector<Vec3d> normals;
  std::vector<std::pair<double, double>> uvs;
  std::vector<std::uint32_t> corners;

  /// mirrored: its coordinates run the other way on the half where x is below 0.
  explicit CutSphere(std::uint32_t around, bool mirrored = false) {
    const std::uint32_t rows = around / 2;
    for (std::uint32_t row = 0; row <= rows; ++row)
      for (std::uint32_t i = 0; i <= around; ++i) {
        const double theta = std::numbers::pi * (1 - share(row, rows));
        const double phi = 2 * std::numbers::pi * (share(i % around, around) + 0.5);
        normals.emplace_back(std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi));
        const double u = share(i, around);
        uvs.emplace_back(mirrored && u > 0.5 ? 1 - u : u, share(row, rows));
      }
    for (std::uint32_t row = 0; row < rows; ++row)
      for (std::uint32_t i = 0; i < around; ++i) {
        const std::uint32_t a = row * (around + 1) + i, above = a + around + 1;
        if (row > 0) corners.insert(corners.end(), {a, a + 1, above + 1});
        if (row + 1 < rows) corners.insert(corners.end(), {a, above + 1, above});
      }
  }

  std::string element(const std::string& more = "") const {
    std::ostringstream positions, texture, faces;
    for (const Vec3d& n : normals) positions << n.x << ' ' << n.y << ' ' << n.z << ", ";
    for (const auto& [u, v] : uvs) texture << u << ' ' << v << ", ";
    for (const std::uint32_t corner : corners) faces << corner << ' ';
    return "<meshes><mesh><positions>" + positions.str() + "</positions><faces>" + faces.str() + "</faces><normals>" +
           positions.str() + "</normals><uvs>" + texture.str() + "</uvs><material>m</material>" + more +
           "</mesh></meshes>";
  }
};

const std::string true_sphere =
    "<spheres><sphere><center x='0' y='0' z='0'/><radius>1</radius><material>m</material></sphere></spheres>";

/// The middle of the sphere, in which the mesh has no outline.
std::string sphere_scene(const std::string& object, const std::string& material, const std::string& lights,
                         const std::string& lamps = "", int samples = 16) {
  const std::string map =
      "<textures><noises><noise><name>hills</name><scale>0.7</scale><octaves>1</octaves></noise></noises>"
      "<checkers><checker><name>leaning</name><color1 red='0.7' green='0.35' blue='0.9'/>"
      "<color2 red='0.7' green='0.35' blue='0.9'/></checker></checkers></textures>";
  return "<raytracer><viewplane><hres>48</hres><vres>48</vres><pixelsize>0.03</pixelsize><samples>" +
         std::to_string(samples) +
         "</samples></viewplane><orthographiccamera><eye x='0' y='0' z='5'/><lookat x='0' y='0' z='0'/>"
         "</orthographiccamera><integrator><path><maxdepth>2</maxdepth></path></integrator><lights>" +
         lights + "</lights>" + map +
         "<materials><emissives><emissive><name>lamp</name><ce red='1' green='1' blue='1'/><scaleradiance>300"
         "</scaleradiance></emissive></emissives>" +
         material + "</materials><objects>" + object + lamps + "</objects></raytracer>";
}

const std::string lamp_at_the_side =
    "<disks><disk><center x='8' y='3' z='0.5'/><normal x='-8' y='-3' z='-0.5'/><radius>0.7</radius>"
    "<material>lamp</material></disk></disks>";
const std::string sun_in_front =
    "<directionallights><directionallight><direction x='0.5' y='1' z='1'/><scaleradiance>2</scaleradiance>"
    "</directionallight></directionallights>";

std::string matte(const std::string& detail = "") {
  return "<mattes><matte><name>m</name><ka>0</ka><kd>1</kd><cd red='0.8' green='0.8' blue='0.8'/>" + detail +
         "</matte></mattes>";
}
const std::string brushed =
    "<conductors><conductor><name>m</name><cr red='0.9' green='0.8' blue='0.7'/><roughness>0.4</roughness>"
    "<anisotropy>0.8</anisotropy></conductor></conductors>";

/// The largest difference of the means of 3 x 3 pixels, whose noise is small, over the brightest of them.
double worst_block(const FloatPicture& picture, const FloatPicture& wanted) {
  const auto mean = [](const FloatPicture& of, std::size_t x, std::size_t y) {
    double sum = 0;
    for (std::size_t i = 0; i < 9; ++i) sum += double{of.pixels()[48 * (y + i / 3) + x + i % 3].green};
    return sum / 9;
  };
  double worst = 0, brightest = 0;
  for (std::size_t y = 0; y + 3 <= 48; y += 3)
    for (std::size_t x = 0; x + 3 <= 48; x += 3) {
      worst = std::max(worst, std::abs(mean(picture, x, y) - mean(wanted, x, y)));
      brightest = std::max(brightest, mean(wanted, x, y));
    }
  REQUIRE(brightest > 0.1);
  return worst / brightest;
}

/// By how much the difference of both pictures changes most from one pixel to the next, over the brightest pixel: at
/// edges of faces it jumps.
double worst_edge(const FloatPicture& picture, const FloatPicture& wanted) {
  const auto difference_at = [&](std::size_t i) {
    return double{picture.pixels()[i].green} - double{wanted.pixels()[i].green};
  };
  double worst = 0, brightest = 0;
  for (std::size_t i = 0; i < wanted.pixels().size(); ++i) {
    brightest = std::max(brightest, double{wanted.pixels()[i].green});
    if (i % 48 != 0) worst = std::max(worst, std::abs(difference_at(i) - difference_at(i - 1)));
  }
  REQUIRE(brightest > 0.1);
  return worst / brightest;
}

/// Of a vertex.
Vec3d tangent_at(const MeshBuffer<float>& tangents, std::size_t i) {
  return {tangents[4 * i], tangents[4 * i + 1], tangents[4 * i + 2]};
}

}  // namespace

TEST_CASE("a coarse smooth mesh has no edges of its faces where the light of a lamp ends") {
  for (const std::string& material : {matte(), matte("<bump texture='hills' height='0.15'/>")}) {
    const FloatPicture wanted = rendered(sphere_scene(true_sphere, material, "", lamp_at_the_side, 64));
    const FloatPicture mesh = rendered(sphere_scene(CutSphere(24).element(), material, "", lamp_at_the_side, 64));
    INFO(material);
    CHECK(worst_block(mesh, wanted) < 0.02);
  }
}

TEST_CASE("normal maps have no edges of the faces on a coarse smooth mesh, nor has brushed metal") {
  const std::string mesh = CutSphere(24).element();
  for (const std::string& material : {matte("<normalmap texture='leaning'/>"), brushed}) {
    const FloatPicture wanted = rendered(sphere_scene(true_sphere, material, sun_in_front));
    INFO(material);
    for (const bool instance : {false, true}) {
      INFO("an instance: " << instance);
      const std::string turned =
          "<instances><instance><group>g</group><transform><rotate x='0' y='1' z='0' "
          "angle='75'/></transform></instance>"
          "</instances>";
      std::string scene = sphere_scene(instance ? turned : mesh, material, sun_in_front);
      if (instance)
        scene.insert(scene.find("<objects>"),
                     "<groups><group><name>g</name><objects>" + mesh + "</objects></group></groups>");
      CHECK(worst_edge(rendered(scene), wanted) < 0.07);
    }
  }
}

TEST_CASE("tangents of vertices are where u grows, for the faces that a texture mirrors and for the others") {
  const CutSphere sphere(24, true);
  MeshData mesh;
  mesh.positions = MeshBuffer<float>(3 * sphere.normals.size());
  mesh.uvs = MeshBuffer<float>(2 * sphere.normals.size());
  for (std::size_t i = 0; i < sphere.normals.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      mesh.positions[3 * i + axis] = static_cast<float>(component(sphere.normals[i], static_cast<int>(axis)));
    mesh.uvs[2 * i] = static_cast<float>(sphere.uvs[i].first);
    mesh.uvs[2 * i + 1] = static_cast<float>(sphere.uvs[i].second);
  }
  mesh.indices = MeshBuffer<std::uint32_t>(sphere.corners.size());
  std::copy(sphere.corners.begin(), sphere.corners.end(), mesh.indices.data());
  const TangentSource source{mesh, mesh.positions.data(), mesh.indices.data(), mesh.positions.data(), mesh.uvs.data()};
  const VertexTangents tangents = vertex_tangents(source, 1), by_two = vertex_tangents(source, 2);
  for (const std::size_t mirrored : {0U, 1U}) {
    REQUIRE(tangents[mirrored].size() == 4 * sphere.normals.size());
    std::size_t found = 0;
    for (std::size_t i = 0; i < sphere.normals.size(); ++i) {
      for (std::size_t k = 4 * i; k < 4 * i + 4; ++k) REQUIRE(tangents[mirrored][k] == by_two[mirrored][k]);
      const float sign = tangents[mirrored][4 * i + 3];
      if (sign == 0) continue;  // no such face is at it
      ++found;
      CHECK(sign == (mirrored == 1 ? -1 : 1));
      const Vec3d& n = sphere.normals[i];
      if (std::abs(n.y) > 0.99) continue;
      const Vec3d along = normalize(Vec3d(n.z, 0, -n.x)) * (mirrored == 1 ? -1.0 : 1.0);
      // Half of the faces at a seam are on its other side.
      CHECK(dot(tangent_at(tangents[mirrored], i), along) > 0.98);
    }
    CHECK(found > sphere.normals.size() / 2);
  }
}

}  // namespace raytrace::test
