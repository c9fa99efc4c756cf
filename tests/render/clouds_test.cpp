// A cloud of spheres is what its spheres are: its pictures are those of single ones.
#include <algorithm>
#include <fstream>
#include <random>
#include <set>
#include <sstream>

#include "raytrace/description/check_scene.h"
#include "render/scenes.h"
#include "support/catch.h"
#include "support/temporary_folder.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

const std::string cloud_materials =
    "<lights><ambientlight><scaleradiance>0.2</scaleradiance></ambientlight><pointlights><pointlight>"
    "<location x='6' y='9' z='10'/><scaleradiance>2</scaleradiance></pointlight></pointlights></lights>"
    "<materials><mattes><matte><name>red</name><ka>1</ka><kd>1</kd><cd red='1' green='0.25' blue='0.125'/></matte>"
    "<matte><name>floor</name><ka>1</ka><kd>1</kd><cd red='0.5' green='0.5' blue='0.5'/></matte></mattes></materials>";

/// Spheres about the origin, as the points of a file and as elements. Their numbers are those of both.
struct Points {
  std::string rows, elements;
  int count = 0;

  void add(std::mt19937& bits, const std::string& radius, bool in_file, const std::string& material = "red") {
    const auto coordinate = [&] { return std::to_string(static_cast<double>(bits() % 512) / 64 - 4); };
    const std::string x = coordinate(), y = coordinate(), z = coordinate();
    rows += x + " " + y + " " + z + (in_file ? " " + radius : "") + "\n";
    elements += "<sphere><center x='" + x + "' y='" + y + "' z='" + z + "'/><radius>" + radius + "</radius><material>" +
                material + "</material></sphere>";
    ++count;
  }
};

std::string ply_text(int count, const std::string& properties, const std::string& rows) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(count) + "\n";
  std::istringstream names("x y z " + properties);
  for (std::string name; names >> name;) text += "property float " + name + "\n";
  return text + "end_header\n" + rows;
}

/// Of a file that the folder gets.
std::string cloud_element(const TemporaryFolder& folder, const std::string& name, const std::string& bytes,
                          const std::string& more) {
  const std::string file = folder.file(name);
  std::ofstream(file, std::ios::binary) << bytes;
  return "<sphereclouds><spherecloud><file>" + file + "</file>" + more + "</spherecloud></sphereclouds>";
}

/// Some of the scene's own spheres come first, and a floor: a plane and a rectangle.
std::string cloud_scene(const std::string& objects, const std::string& integrator = "raycast",
                        const std::string& groups = {}) {
  return scene_text(
      64, 48, 4,
      "<integrator><" + integrator + "/></integrator>" + cloud_materials +
          "<objects><planes><plane><point x='0' y='-4' z='0'/><normal x='0' y='1' z='0'/><material>floor</material>"
          "</plane></planes><spheres><sphere><center x='1' y='0' z='1'/><radius>1</radius><material>floor</material>"
          "</sphere></spheres>" +
          objects + "</objects>" + groups);
}

std::string errors_of(const std::string& scene) {
  Diagnostics diagnostics("scene.xml");
  auto description = parse_scene(scene, diagnostics);
  REQUIRE(description);
  CHECK_FALSE(load_meshes(*description, diagnostics));
  std::ostringstream printed;
  diagnostics.print(printed);
  return printed.str();
}

}  // namespace

TEST_CASE("a cloud has the picture of single spheres, to the bit") {
  std::mt19937 bits(11);
  Points small, large;
  for (int i = 0; i < 400; ++i) small.add(bits, i % 2 == 0 ? "0.25" : "0.125", true);
  for (int i = 0; i < 20; ++i) large.add(bits, "0.5", false);
  const TemporaryFolder folder;
  const std::string clouds =
      cloud_element(folder, "small.ply", ply_text(small.count, "radius", small.rows), "<material>red</material>") +
      cloud_element(folder, "large.ply", ply_text(large.count, "", large.rows),
                    "<radius>0.5</radius><material>red</material>");
  const std::string spheres = "<spheres>" + small.elements + large.elements + "</spheres>";
  for (const std::string integrator : {"raycast", "normals"})
    for (const std::string& isa : usable_isas()) {
      INFO(integrator << ' ' << isa);
      CHECK(identical(rendered(parsed_scene(cloud_scene(clouds, integrator)), 1, isa),
                      rendered(parsed_scene(cloud_scene(spheres, integrator)), 1, isa)));
    }

  // Under a transform that leaves spheres round, and in a group that is stretched.
  const std::string transform =
      "<transform><scale x='-0.5' y='0.5' z='0.5'/><rotate x='1' y='1' z='0' angle='30'/>"
      "<translate x='1' y='2' z='-1'/></transform>";
  const auto with_transform = [&](std::string text, const std::string& end) {
    for (std::size_t at = 0; (at = text.find(end, at)) != std::string::npos; at += transform.size() + end.size())
      text.insert(at, transform);
    return text;
  };
  const std::string moved_cloud = with_transform(clouds, "</spherecloud>");
  const std::string moved_spheres = with_transform(spheres, "</sphere>");
  CHECK(identical(rendered(cloud_scene(moved_cloud)), rendered(cloud_scene(moved_spheres))));
  const std::string instances =
      "<instances><instance><group>atoms</group><transform><scale x='1' y='0.5' z='1'/></transform></instance>"
      "<instance><group>atoms</group><transform><translate x='3' y='0' z='0'/></transform></instance></instances>";
  const auto in_group = [&](const std::string& objects) {
    return cloud_scene(instances, "raycast",
                       "<groups><group><name>atoms</name><objects>" + objects + "</objects></group></groups>");
  };
  CHECK(identical(rendered(in_group(moved_cloud)), rendered(in_group(moved_spheres))));
}

TEST_CASE("a cloud has its file's colours where the scene gives it no material, else the material's") {
  std::mt19937 bits(5);
  Points points;
  for (int i = 0; i < 60; ++i) points.add(bits, "0.5", true);
  const TemporaryFolder folder;
  // Red as floats, which are linear.
  std::string red, plain;
  for (std::istringstream rows(points.rows); std::getline(rows, plain);) red += plain + " 1 0.25 0.125\n";
  const std::string file = ply_text(points.count, "radius red green blue", red);
  const FloatPicture wanted = rendered(cloud_scene("<spheres>" + points.elements + "</spheres>"));
  const FloatPicture colored = rendered(cloud_scene(cloud_element(folder, "red.ply", file, "")));
  double worst = 0;
  for (std::size_t i = 0; i < wanted.pixels().size(); ++i)
    worst = std::max(worst, difference(wanted.pixels()[i], colored.pixels()[i]));
  CHECK(worst < 1e-5);
  const FloatPicture grey =
      rendered(cloud_scene(cloud_element(folder, "grey.ply", file, "<material>floor</material>")));
  CHECK(std::all_of(grey.pixels().begin(), grey.pixels().end(), [](const Pixel& p) { return p.red <= p.blue; }));
}

TEST_CASE("a cloud is one object, behind the meshes") {
  const TemporaryFolder folder;
  const std::string cloud = cloud_element(folder, "a.ply", ply_text(2, "radius", "-3 0 5 1\n3 0 5 1\n"),
                                          "<name>atoms</name><material>red</material>");
  const SceneDescription scene = parsed_scene(cloud_scene(
      cloud + "<meshes><mesh><positions>-1 -1 3, 1 -1 3, 0 1 3</positions><faces>0 1 2</faces></mesh></meshes>"));
  CHECK(object_names(scene) == std::vector<std::string>{"plane#1", "sphere#1", "mesh#1", "atoms"});
  CHECK(build_scene(scene, {1, {}})->statistics().primitives == 5);
  const std::vector<std::uint32_t> ids = object_ids(scene, {});
  CHECK(std::set<std::uint32_t>(ids.begin(), ids.end()) == std::set<std::uint32_t>{0, 1, 2, 3, 4});
}

TEST_CASE("a cloud without radii, of another type, or stretched is refused where it stands") {
  const TemporaryFolder folder;
  const std::string rows = "0 0 0\n";
  const std::string none = errors_of(cloud_scene(cloud_element(folder, "a.ply", ply_text(1, "", rows), "")));
  CHECK(none == "scene.xml:1:" + none.substr(12, none.find(": error") - 12) + ": error: " + folder.file("a.ply") +
                    ": has no radii; add <radius> to the <spherecloud>\n");
  const std::string stretched = errors_of(cloud_scene(cloud_element(
      folder, "a.ply", ply_text(1, "", rows), "<radius>1</radius><transform><scale x='1' y='2' z='1'/></transform>")));
  CHECK(stretched.find("cannot stretch it; put it into a <group>") != std::string::npos);
  const std::string other = errors_of(cloud_scene(cloud_element(folder, "a.xyz", rows, "<radius>1</radius>")));
  CHECK(other.find("a.xyz: is no cloud by its name") != std::string::npos);
  Diagnostics diagnostics("s");
  const auto unloaded = parse_scene(cloud_scene(cloud_element(folder, "b.ply", "", "")), diagnostics);
  REQUIRE(unloaded);
  CHECK_THROWS_AS(build_scene(*unloaded, {1, {}}), SceneError);
}

TEST_CASE("a cloud counts in the scene's hash by what its file holds") {
  const TemporaryFolder folder;
  const auto hash_of = [&](const std::string& name, const std::string& rows) {
    return scene_hash(
        parsed_scene(cloud_scene(cloud_element(folder, name, ply_text(1, "radius red green blue", rows), ""))));
  };
  const std::string hash = hash_of("a.ply", "0 0 0 1 1 1 1\n");
  CHECK(hash_of("b.ply", "0 0 0 1 1 1 1\n") == hash);
  for (const std::string rows : {"0 0 1 1 1 1 1\n", "0 0 0 2 1 1 1\n", "0 0 0 1 1 1 0\n"})
    CHECK(hash_of("a.ply", rows) != hash);
}

TEST_CASE("points that are no spheres are left out with one warning, and counts that lie are refused") {
  const TemporaryFolder folder;
  const auto load = [&](const std::string& text, Diagnostics& diagnostics) {
    auto scene = parse_scene(cloud_scene(cloud_element(folder, "a.ply", text, "")), diagnostics);
    REQUIRE(scene);
    return load_meshes(*scene, diagnostics) ? std::get<ObjectItems<SphereCloud>>(scene->objects).front().data : nullptr;
  };
  Diagnostics bad_ones("s");
  const auto kept =
      load(ply_text(6, "radius", "0 0 0 1\n1 0 0 -1\n2 0 0 nan\nnan 0 0 1\n4 0 0 1e30\n5 0 0 0.5\n"), bad_ones);
  REQUIRE(kept != nullptr);
  CHECK(kept->size() == 2);
  REQUIRE(bad_ones.warning_count() == 1);
  CHECK(bad_ones.kept()[0].message.starts_with("4 points "));
  for (const std::string count : {"7", "4294967295", "99999999999999"}) {
    Diagnostics lies("s");
    std::string text = ply_text(6, "radius", "0 0 0 1\n");
    text.replace(text.find("vertex 6"), 8, "vertex " + count);
    CHECK(load(text, lies) == nullptr);
    CHECK(lies.error_count() == 1);
  }
}

}  // namespace raytrace::test
