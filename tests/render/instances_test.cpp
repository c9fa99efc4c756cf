// Transformed objects and instances of groups are where their transforms put them, however rays come to them.
#include <cmath>
#include <random>

#include "raytrace/aovs/aov_selection.h"
#include "render/scenes.h"
#include "support/catch.h"
#include "support/probe.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

const std::string instances_world =
    "<lights><ambientlight><scaleradiance>0.2</scaleradiance></ambientlight><pointlights><pointlight>"
    "<location x='6' y='9' z='10'/><scaleradiance>2</scaleradiance></pointlight></pointlights></lights>"
    "<materials><phongs><phong><name>red</name><ka>1</ka><kd>0.7</kd><ks>0.3</ks><cd red='1' green='0.3' blue='0.2'/>"
    "<cs red='1' green='1' blue='1'/><exp>20</exp></phong></phongs>"
    "<mattes><matte><name>blue</name><ka>1</ka><kd>0.8</kd><cd red='0' green='0' "
    "blue='1'/></matte></mattes></materials>";

std::string instances_scene(const std::string& objects, const std::string& groups = {}, int samples = 4) {
  return scene_text(64, 48, samples,
                    instances_world + "<objects>" + objects + "</objects><groups>" + groups + "</groups>");
}

std::string group_of(const std::string& name, const std::string& objects) {
  return "<group><name>" + name + "</name><objects>" + objects + "</objects></group>";
}

std::string instance_of(const std::string& group, const std::string& steps, const std::string& more = {}) {
  return "<instances><instance><group>" + group + "</group>" + more + "<transform>" + steps +
         "</transform></instance></instances>";
}

std::string ball(const std::string& center, const std::string& radius, const std::string& steps = {}) {
  return "<spheres><sphere><center " + center + "/><radius>" + radius + "</radius><material>red</material>" +
         (steps.empty() ? "" : "<transform>" + steps + "</transform>") + "</sphere></spheres>";
}

/// An octahedron with a mesh's smooth normals, and a tube on it.
const std::string thing =
    "<meshes><mesh><positions>1 0 0, -1 0 0, 0 1 0, 0 -1 0, 0 0 1, 0 0 -1</positions>"
    "<faces>0 2 4 2 1 4 1 3 4 3 0 4 2 0 5 1 2 5 3 1 5 0 3 5</faces><normals>smooth</normals>"
    "<material>red</material></mesh></meshes>"
    "<cylinders><cylinder><bottom x='0' y='0.5' z='0'/><top x='0.5' y='2' z='0'/><radius>0.3</radius>"
    "<material>blue</material></cylinder></cylinders>";

double mean_difference(const FloatPicture& a, const FloatPicture& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) sum += difference(a.pixels()[i], b.pixels()[i]);
  return sum / static_cast<double>(a.pixels().size());
}

}  // namespace

TEST_CASE("a shape under a transform that leaves it one is the shape with other parameters, to the bit") {
  const FloatPicture wanted = rendered(instances_scene(ball("x='1' y='-2' z='0.5'", "1.5")));
  CHECK(identical(rendered(instances_scene(ball("x='2' y='-2' z='1'", "3",
                                                "<scale x='0.5' y='0.5' z='0.5'/><translate x='0' y='-1' z='0'/>"))),
                  wanted));
  CHECK(identical(
      rendered(instances_scene(ball("x='2' y='1' z='0.5'", "1.5", "<rotate x='0' y='0' z='1' angle='270'/>"))),
      wanted));
  CHECK(identical(rendered(instances_scene(
                      ball("x='0' y='0' z='0'", "1.5", "<matrix>1 0 0 1  0 1 0 -2  0 0 -1 0.5  0 0 0 1</matrix>"))),
                  wanted));
}

TEST_CASE("an ellipsoid is the sphere as a narrower camera shows it") {
  // The eye is on the z axis: squeezing the object along x squeezes the picture.
  const auto silhouette = [](const std::string& object, int column) {
    const FloatPicture picture = rendered(scene_text(64, 48, 1, instances_world + "<objects>" + object + "</objects>",
                                                     "<eye x='0' y='0' z='1000'/><lookat x='0' y='0' z='0'/>"));
    int covered = 0;
    for (int row = 0; row < 48; ++row)
      covered += std::abs(picture.pixels()[static_cast<std::size_t>(64 * row + column)].blue - 0.4F) > 1e-3F ? 1 : 0;
    return covered;
  };
  const std::string squeezed = ball("x='0' y='0' z='0'", "200", "<scale x='0.5' y='1' z='1'/>");
  const std::string round = ball("x='0' y='0' z='0'", "200");
  for (const int column : {32, 34, 36, 37}) {
    INFO("column " << column);
    // Its middle is the round one's edge between two columns.
    const int left = 32 + 2 * (column - 32), covered = silhouette(squeezed, column);
    CHECK(covered <= silhouette(round, left));
    CHECK(covered >= silhouette(round, left + 1));
  }
}

TEST_CASE("an instance of a group is its objects, moved") {
  const std::string steps =
      "<rotate x='1' y='2' z='0.5' angle='40'/><scale x='1.5' y='1.5' z='1.5'/>"
      "<translate x='1' y='-1' z='2'/>";
  std::string moved = thing;
  for (const char* end : {"<material>red</material></mesh>", "<material>blue</material></cylinder>"})
    moved.insert(moved.find(end), "<transform>" + steps + "</transform>");
  const FloatPicture wanted = rendered(instances_scene(moved + ball("x='-2' y='0' z='0'", "1")));
  const FloatPicture got = rendered(
      instances_scene(instance_of("thing", steps) + ball("x='-2' y='0' z='0'", "1"), group_of("thing", thing)));
  CHECK(mean_difference(got, wanted) < 1e-4);
  // In a group of its own, whose instance does the second half.
  const FloatPicture nested = rendered(instances_scene(
      instance_of("outer", "<scale x='1.5' y='1.5' z='1.5'/><translate x='1' y='-1' z='2'/>") +
          ball("x='-2' y='0' z='0'", "1"),
      group_of("outer", instance_of("thing", "<rotate x='1' y='2' z='0.5' angle='40'/>")) + group_of("thing", thing)));
  CHECK(mean_difference(nested, wanted) < 1e-4);
}

TEST_CASE("mirrored and stretched instances have their normals on the right side") {
  // The same as a mesh whose vertices are mirrored and stretched.
  const std::string steps = "<scale x='-1' y='2' z='0.5'/><rotate x='0' y='1' z='0' angle='30'/>";
  std::string mesh = thing.substr(0, thing.find("<cylinders>"));
  std::string moved = mesh;
  moved.replace(moved.find("<normals>smooth"), std::string("<normals>smooth").size(), "<normals>flat");
  const std::string flat = moved;
  moved.insert(moved.find("<material>"), "<transform>" + steps + "</transform>");
  CHECK(mean_difference(rendered(instances_scene(instance_of("thing", steps), group_of("thing", flat))),
                        rendered(instances_scene(moved))) < 1e-4);
}

TEST_CASE("an instance is one object, and its material counts before those of its objects") {
  const SceneDescription scene = parsed_scene(instances_scene(
      ball("x='-3' y='0' z='0'", "1") +
          instance_of("thing", "<translate x='3' y='0' z='0'/>", "<name>right</name><material>blue</material>") +
          instance_of("thing", "<translate x='0' y='0' z='0'/>"),
      group_of("thing", thing)));
  CHECK(object_names(scene) == std::vector<std::string>{"sphere#1", "right", "instance#2"});
  const auto built = build_scene(scene, {1, {}});
  CHECK(built->statistics().primitives > 8);
  RayCounts rays;
  const FloatPicture picture = render(*built, scene, {1, 0, whole(scene)}, rays);
  const auto pixel = [&](std::size_t column) { return picture.pixels()[64 * 22 + column]; };
  CHECK((pixel(16).red > 0.1F && pixel(32).red > 0.1F));
  CHECK((pixel(48).red == 0 && pixel(48).blue > 0.05F));
}

TEST_CASE("packets and single rays hit the same of instances, coincident ones included") {
  std::mt19937 bits(5);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(bits()) / 4294967296.0;
  };
  std::string objects = ball("x='0' y='0' z='0'", "0.7", "<scale x='1' y='2' z='1'/>");
  for (int i = 0; i < 60; ++i) {
    const std::string steps = "<scale x='" + std::to_string(between(0.3, 1.5)) + "' y='" +
                              std::to_string(between(-1.5, -0.3)) + "' z='1'/><rotate x='1' y='" +
                              std::to_string(between(-1, 1)) + "' z='0' angle='" + std::to_string(between(0, 360)) +
                              "'/><translate x='" + std::to_string(between(-4, 4)) + "' y='" +
                              std::to_string(between(-3, 3)) + "' z='" + std::to_string(between(-4, 2)) + "'/>";
    for (int copy = 0; copy < 3; ++copy)
      objects += instance_of("thing", steps, copy == 1 ? "<material>blue</material>" : "");
  }
  const SceneDescription scene = parsed_scene(instances_scene(objects, group_of("thing", thing)));
  for (const std::string& isa : usable_isas()) {
    INFO(isa);
    const Probe probe(scene, isa);
    const Vec3f eye(0, 2, 12);
    std::vector<ProbeRay> rays;
    for (int i = 0; i < 4000; ++i) {
      const Vec3d target{between(-4, 4), between(-3, 3), between(-4, 2)};
      rays.push_back({eye, Vec3f(normalize(target - Vec3d(eye)))});
    }
    const std::vector<ProbeHit> packets = probe.intersect_packet(rays), single = probe.intersect_single(rays);
    int hits = 0, different = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
      hits += packets[i].hit;
      different += packets[i].hit != single[i].hit ||
                   (packets[i].hit && (packets[i].distance != single[i].distance || packets[i].kind != single[i].kind ||
                                       packets[i].index != single[i].index));
    }
    CHECK(hits > 1000);
    CHECK(different == 0);
  }
  // The first of the coincident ones shows, whatever the packets: the second is blue.
  RayCounts rays;
  const auto built = build_scene(scene, {1, {}});
  RenderSettings settings{1, 0, whole(scene)};
  const FloatPicture wanted = render(*built, scene, settings, rays);
  settings.aovs = aov_set({"object_id", "depth"});
  CHECK(identical(FloatPicture(render(*built, scene, settings, rays)), wanted));
}

TEST_CASE("what cannot be instanced is refused") {
  const auto refused = [](const std::string& objects, const std::string& groups) {
    Diagnostics diagnostics("s");
    CHECK_FALSE(parse_scene(instances_scene(objects, groups), diagnostics));
    return diagnostics.kept().empty() ? "" : diagnostics.kept().front().message;
  };
  CHECK(refused(instance_of("thin", ""), group_of("thing", thing)).find("did you mean 'thing'?") != std::string::npos);
  // Beside another error, too.
  Diagnostics both("s");
  CHECK_FALSE(parse_scene(
      instances_scene(instance_of("thin", "") + ball("x='0' y='0' z='0'", "-1"), group_of("thing", thing)), both));
  CHECK(both.error_count() == 2);
  CHECK(refused("", group_of("a", instance_of("b", "")) + group_of("b", instance_of("a", "")))
            .find("would have itself in it") != std::string::npos);
  CHECK(refused("", group_of("a", thing) + group_of("a", thing)).find("is taken by the <group>") != std::string::npos);
  CHECK(refused("", group_of("a",
                             "<planes><plane><point x='0' y='0' z='0'/><normal x='0' y='1' z='0'/><material>red"
                             "</material></plane></planes>"))
            .find("a plane has no end") != std::string::npos);
  std::string groups = group_of("g0", thing);
  for (int i = 1; i < 9; ++i) {
    std::string copies;
    for (int k = 0; k < 9; ++k) copies += instance_of("g" + std::to_string(i - 1), "");
    groups += group_of("g" + std::to_string(i), copies);
  }
  CHECK(refused(instance_of("g8", ""), groups).find("the most is 16777216") != std::string::npos);
  CHECK(refused(ball("x='0' y='0' z='0'", "1", "<scale x='1' y='0' z='1'/>"), "").find("must not be 0") !=
        std::string::npos);
  CHECK(refused(ball("x='0' y='0' z='0'", "1", "<matrix>1 0 0 0  0 1 0 0  0 0 1 0</matrix>"), "").find("takes 16") !=
        std::string::npos);
  CHECK(refused(ball("x='0' y='0' z='0'", "1", "<turn angle='3'/>"), "").find("unknown element <turn>") !=
        std::string::npos);
}

}  // namespace raytrace::test
