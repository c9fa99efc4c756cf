// A camera that is moved so that all of a scene is just in view.
#include "raytrace/batch/fit_camera.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "raytrace/batch/settings_error.h"
#include "raytrace/cameras/view_frame.h"
#include "support/catch.h"
#include "support/parsed_scene.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

namespace {

const std::string pinhole_to_fit =
    "<camera><eye x='3' y='2' z='4'/><lookat x='1' y='1' z='-1'/><up x='0.1' y='1' z='0'/>"
    "<viewdistance>70</viewdistance></camera>";

SceneDescription scene_to_fit(const std::string& objects, const std::string& camera = pinhole_to_fit,
                              const std::string& more = {}) {
  return parsed_scene(
      "<raytracer><viewplane><hres>96</hres><vres>64</vres></viewplane>" + camera +
      "<materials><mattes><matte><name>m</name><ka>1</ka><kd>1</kd><cd red='1' green='1' blue='1'/></matte></mattes>"
      "<emissives><emissive><name>lamp</name><ce red='1' green='1' blue='1'/></emissive></emissives></materials>"
      "<objects>" +
      objects + "</objects>" + more + "</raytracer>");
}

/// Where points are in the picture that the camera shows: how far they reach to each of its edges, which are at 1.
struct Shown {
  double right = 0, left = 0, top = 0, bottom = 0;
  bool all_before_camera = true;

  void add(const SceneDescription& scene, const Vec3d& p) {
    const ViewPlane& picture = scene.viewplane;
    std::visit(
        [&](const auto& camera) {
          const ViewFrame frame(camera.eye, camera.lookat, camera.up);
          const Vec3d way = p - camera.eye;
          double x = dot(way, frame.u), y = dot(way, frame.v);
          const double depth = -dot(way, frame.w);
          all_before_camera = all_before_camera && depth > 0;
          if constexpr (requires { camera.viewdistance; }) {
            x *= camera.viewdistance / depth;
            y *= camera.viewdistance / depth;
            const double side = picture.pixelsize * std::max(picture.hres, picture.vres);
            x -= camera.shift.x * side;
            y -= camera.shift.y * side;
          }
          x /= picture.pixelsize * picture.hres / 2;
          y /= picture.pixelsize * picture.vres / 2;
          right = std::max(right, x);
          left = std::max(left, -x);
          top = std::max(top, y);
          bottom = std::max(bottom, -y);
        },
        scene.camera);
  }

  /// All is in view, and reaches to the margin on two sides that face each other.
  void check(double precision) const {
    CHECK(all_before_camera);
    const double most = std::max({right, left, top, bottom});
    CHECK(most <= part_in_view + 1e-9);
    const bool touches_sides = std::min(right, left) > part_in_view - precision;
    const bool touches_ends = std::min(top, bottom) > part_in_view - precision;
    CHECK((touches_sides || touches_ends));
  }
};

/// Points of a circle.
void add_circle(std::vector<Vec3d>& points, const Vec3d& center, const Vec3d& normal, double radius) {
  const ViewFrame frame(normal, {0, 0, 0}, {0.3, 1, 0.2});
  constexpr int count = 720;
  for (int i = 0; i < count; ++i) {
    const double angle = 2 * std::numbers::pi * i / count;
    points.push_back(center + (frame.u * std::cos(angle) + frame.v * std::sin(angle)) * radius);
  }
}

struct ShapeToFit {
  std::string element;
  std::vector<Vec3d> points;  ///< of its surface, its corners and edges among them
};

std::vector<ShapeToFit> shapes_to_fit() {
  std::vector<ShapeToFit> shapes;
  const auto add = [&](const std::string& group, const std::string& element, const std::string& values,
                       std::vector<Vec3d> points) {
    shapes.push_back(
        {"<" + group + "><" + element + ">" + values + "<material>m</material>@</" + element + "></" + group + ">",
         std::move(points)});
  };
  const auto circles = [](std::initializer_list<std::tuple<Vec3d, Vec3d, double>> all) {
    std::vector<Vec3d> points;
    for (const auto& [center, normal, radius] : all) add_circle(points, center, normal, radius);
    return points;
  };
  std::vector<Vec3d> ball, tube;
  for (int i = 1; i < 360; ++i) {
    const double angle = std::numbers::pi * i / 360;
    add_circle(ball, Vec3d(1, 2, 3) + Vec3d(0, 2 * std::cos(angle), 0), {0, 1, 0}, 2 * std::sin(angle));
    add_circle(tube, {0, 0.5 * std::cos(2 * angle), 1}, {0, 1, 0}, 2 + 0.5 * std::sin(2 * angle));
  }
  add("spheres", "sphere", "<center x='1' y='2' z='3'/><radius>2</radius>", ball);
  add("toruses", "torus", "<center x='0' y='0' z='1'/><sweptradius>2</sweptradius><tuberadius>0.5</tuberadius>", tube);
  add("triangles", "triangle",
      "<vertexposition1 x='1' y='2' z='3'/><vertexposition2 x='-1' y='0' z='3'/><vertexposition3 x='0' y='4' z='1'/>",
      {{1, 2, 3}, {-1, 0, 3}, {0, 4, 1}});
  add("rectangles", "rectangle", "<corner x='1' y='2' z='3'/><edge1 x='2' y='1' z='0'/><edge2 x='0' y='-1' z='1'/>",
      {{1, 2, 3}, {3, 3, 3}, {1, 1, 4}, {3, 2, 4}});
  add("boxes", "box", "<min x='1' y='2' z='3'/><max x='2' y='4' z='3.5'/>",
      {{1, 2, 3}, {2, 2, 3}, {1, 4, 3}, {2, 4, 3}, {1, 2, 3.5}, {2, 2, 3.5}, {1, 4, 3.5}, {2, 4, 3.5}});
  const Vec3d a(1, 0, 2), b(2, 3, 1);
  const std::string axis = "<bottom x='1' y='0' z='2'/><top x='2' y='3' z='1'/>";
  add("cylinders", "cylinder", axis + "<radius>0.5</radius>", circles({{a, b - a, 0.5}, {b, b - a, 0.5}}));
  add("cones", "cone", axis + "<radius>2</radius><topradius>0.25</topradius>",
      circles({{a, b - a, 2}, {b, b - a, 0.25}}));
  const std::string about = "<center x='1' y='0' z='2'/><normal x='1' y='2' z='1'/>";
  add("disks", "disk", about + "<radius>1.5</radius>", circles({{a, {1, 2, 1}, 1.5}}));
  add("annuli", "annulus", about + "<innerradius>1</innerradius><outerradius>2</outerradius>",
      circles({{a, {1, 2, 1}, 2}}));
  add("meshes", "mesh", "<positions>0 0 0, 2 0 0, 0 3 0, 0 0 1, 90 90 90</positions><faces>0 1 2, 0 2 3,</faces>",
      {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 1}});  // 90 90 90 is no corner of a face
  return shapes;
}

const std::string step_to_fit =
    "<transform><scale x='1' y='2' z='0.5'/><rotate x='1' y='1' z='0' angle='40'/><translate x='5' y='0' z='-2'/>"
    "</transform>";

Affine affine_to_fit() {
  Transform transform;
  transform.steps = {{TransformStep::scale, {1, 2, 0.5}},
                     {TransformStep::rotate, {1, 1, 0, 40}},
                     {TransformStep::translate, {5, 0, -2}}};
  return transform.affine();
}

std::string with_step(std::string element, const std::string& step) {
  return element.replace(element.find('@'), 1, step);
}

}  // namespace

TEST_CASE("each shape is just in view, moved and stretched, too") {
  for (const ShapeToFit& shape : shapes_to_fit())
    for (const bool moved : {false, true}) {
      INFO(shape.element << moved);
      SceneDescription scene = scene_to_fit(with_step(shape.element, moved ? step_to_fit : ""));
      const auto before = std::get<PinholeCamera::Parameters>(scene.camera);
      fit_camera(scene, scene);
      const auto after = std::get<PinholeCamera::Parameters>(scene.camera);
      Shown shown;
      for (const Vec3d& point : shape.points) shown.add(scene, moved ? affine_to_fit().point(point) : point);
      shown.check(1e-3);
      const Vec3d old_way = normalize(before.eye - before.lookat), way = normalize(after.eye - after.lookat);
      CHECK(length(old_way - way) < 1e-12);
      CHECK(after.viewdistance == before.viewdistance);
      CHECK(scene.viewplane.pixelsize == 1);
    }
}

TEST_CASE("all cameras that can be moved show all objects, instances of groups of groups included") {
  const std::vector<ShapeToFit> shapes = shapes_to_fit();
  std::string objects;
  std::vector<Vec3d> points;
  const Affine map = affine_to_fit();
  for (const ShapeToFit& shape : shapes) {
    objects += with_step(shape.element, "");
    for (const Vec3d& point : shape.points)
      for (const Vec3d& p : {point, map.point(point), map.point(map.point(point))}) points.push_back(p);
  }
  const auto instance = [](const std::string& group) {
    return "<instances><instance><group>" + group + "</group>" + step_to_fit + "</instance></instances>";
  };
  const std::string groups = "<groups><group><name>a</name><objects>" + objects + instance("b") +
                             "</objects></group><group><name>b</name><objects>" + objects +
                             "</objects></group></groups>";
  const std::string view = "<eye x='3' y='2' z='4'/><lookat x='1' y='1' z='-1'/>";
  for (const std::string& camera :
       {pinhole_to_fit, "<camera>" + view + "<viewdistance>70</viewdistance><shift x='0.3' y='-0.6'/></camera>",
        "<orthographiccamera>" + view + "</orthographiccamera>",
        "<thinlenscamera>" + view +
            "<fov>50</fov><lensradius>0.1</lensradius><focaldistance>1</focaldistance>"
            "</thinlenscamera>"}) {
    INFO(camera);
    SceneDescription scene = scene_to_fit(objects + instance("a"), camera, groups);
    fit_camera(scene, scene);
    Shown shown;
    for (const Vec3d& point : points) shown.add(scene, point);
    shown.check(1e-3);
    if (const auto* const lens = std::get_if<ThinLensCamera::Parameters>(&scene.camera))
      CHECK(lens->focaldistance == Approx(length(lens->eye - lens->lookat)));
  }
}

TEST_CASE("planes and lamps do not count, but for lamps alone") {
  const auto eye_of = [](const std::string& objects, const std::string& more = {}) {
    SceneDescription scene = scene_to_fit(objects, pinhole_to_fit, more);
    fit_camera(scene, scene);
    return std::get<PinholeCamera::Parameters>(scene.camera).eye;
  };
  const auto ball = [](double x, const std::string& material) {
    return "<spheres><sphere><center x='" + std::to_string(x) + "' y='0' z='0'/><radius>1</radius><material>" +
           material + "</material></sphere></spheres>";
  };
  const std::string plane =
      "<planes><plane><point x='0' y='-1' z='0'/><normal x='0' y='1' z='0'/><material>m</material></plane></planes>";
  const Vec3d alone = eye_of(ball(0, "m"));
  CHECK(length(eye_of(ball(0, "m") + plane + ball(9, "lamp")) - alone) == 0);
  CHECK(length(eye_of(ball(0, "lamp")) - alone) == 0);
  CHECK(length(eye_of(ball(0, "m") + ball(9, "m")) - alone) > 1);
  // A material of the instance is that of the lamps in its group.
  const std::string group = "<groups><group><name>g</name><objects>" + ball(9, "lamp") + "</objects></group></groups>";
  const auto instance = [](const std::string& more) {
    return "<instances><instance><group>g</group>" + more + "</instance></instances>";
  };
  CHECK(length(eye_of(ball(0, "m") + instance(""), group) - alone) == 0);
  CHECK(length(eye_of(ball(0, "m") + instance("<material>m</material>"), group) - alone) > 1);
  CHECK_THROWS_AS(eye_of(plane), SettingsError);
}

TEST_CASE("a cloud is in view as its spheres are") {
  const TemporaryFolder folder;
  const std::string file = folder.file("cloud.ply");
  write_text(file,
             "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
             "property float radius\nend_header\n1 2 3 0.5\n-2 0 1 0.25\n");
  SceneDescription cloud =
      scene_to_fit("<sphereclouds><spherecloud><file>" + file + "</file></spherecloud></sphereclouds>");
  SceneDescription spheres = scene_to_fit(
      "<spheres><sphere><center x='1' y='2' z='3'/><radius>0.5</radius><material>m</material></sphere>"
      "<sphere><center x='-2' y='0' z='1'/><radius>0.25</radius><material>m</material></sphere></spheres>");
  for (SceneDescription* const scene : {&cloud, &spheres}) fit_camera(*scene, *scene);
  const auto eye = [](const SceneDescription& scene) { return std::get<PinholeCamera::Parameters>(scene.camera).eye; };
  CHECK(length(eye(cloud) - eye(spheres)) < 1e-12);
}

TEST_CASE("a point is in the picture's middle, and a camera that sees all around is refused") {
  SceneDescription scene = scene_to_fit(
      "<spheres><sphere><center x='1' y='2' z='3'/><radius>1e-9</radius><material>m</material></sphere></spheres>");
  fit_camera(scene, scene);
  Shown shown;
  shown.add(scene, {1, 2, 3});
  CHECK(shown.all_before_camera);
  CHECK(shown.right + shown.left + shown.top + shown.bottom < 0.1);
  SceneDescription around = scene_to_fit(
      "<spheres><sphere><center x='1' y='2' z='3'/><radius>1</radius><material>m</material></sphere></spheres>",
      "<sphericalcamera><eye x='3' y='2' z='4'/><lookat x='1' y='1' z='-1'/></sphericalcamera>");
  CHECK_THROWS_AS(fit_camera(around, around), SettingsError);
}

TEST_CASE("a camera that is moved cuts where it did, and need not show what is not visible to it") {
  const std::string ball = "<spheres><sphere><center x='0' y='0' z='0'/><radius>1</radius><material>m</material>";
  const std::string far_ball = "</sphere><sphere><center x='50' y='0' z='0'/><radius>1</radius><material>m</material>";
  const std::string end = "</sphere></spheres>", hidden = "<visible>false</visible>";
  const auto fitted = [&](const std::string& objects, double nearclip) {
    SceneDescription scene = scene_to_fit(objects,
                                          "<camera><eye x='0' y='0' z='90'/><lookat x='0' y='0' z='0'/><viewdistance>"
                                          "70</viewdistance><nearclip>" +
                                              std::to_string(nearclip) + "</nearclip></camera>");
    fit_camera(scene, scene);
    return std::get<PinholeCamera::Parameters>(scene.camera);
  };
  const PinholeCamera::Parameters camera = fitted(ball + end, 90);
  CHECK(std::abs(camera.eye.z - camera.nearclip) < 1e-9);
  CHECK(camera.eye.z < 10);
  CHECK(fitted(ball + end, 0).nearclip == 0);
  CHECK(fitted(ball + end, 10).nearclip == 0);
  CHECK(std::abs(fitted(ball + far_ball + hidden + end, 90).eye.z - camera.eye.z) < 1e-9);
  CHECK(fitted(ball + far_ball + end, 90).eye.z > 20);
}

}  // namespace raytrace::test
