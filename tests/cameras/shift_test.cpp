// A shifted camera's picture is a part of a larger one without a shift.
#include <cmath>
#include <string>
#include <tuple>

#include "raytrace/batch/render_job.h"
#include "raytrace/cameras/kernels.h"
#include "raytrace/render/renderer.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/lanes.h"
#include "support/parsed_scene.h"

namespace raytrace::test {

namespace {

const ViewPlane shifted_plane{.hres = 300, .vres = 200, .pixelsize = 0.8};
constexpr double shift_across = 0.25, shift_up = -0.4;  // of 300 pixels
constexpr double pixels_across = 75, pixels_up = -120;  // the same

template <class Camera>
typename Camera::Parameters unshifted() {
  typename Camera::Parameters parameters;
  parameters.eye = {25, 20, 10};
  parameters.lookat = {-0.5, 3, 7};
  parameters.up = {0.2, 1, -0.3};
  parameters.viewdistance = 300;
  if constexpr (requires { parameters.lensradius; }) {
    parameters.lensradius = 0.5;
    parameters.focaldistance = 7;
  }
  return parameters;
}

template <class Camera>
std::pair<Kernel<Camera>, Kernel<Camera>> with_and_without() {
  auto parameters = unshifted<Camera>();
  const Kernel<Camera> without(parameters, shifted_plane);
  parameters.shift = {shift_across, shift_up};
  return {Kernel<Camera>(parameters, shifted_plane), without};
}

const FloatN lens_u(0.3F), lens_v(0.9F);

Ray<FloatN> ray_at(const Kernel<PinholeCamera>& camera, double x, double y) {
  return camera.generate(FloatN(static_cast<float>(x)), FloatN(static_cast<float>(y)));
}
Ray<FloatN> ray_at(const Kernel<ThinLensCamera>& camera, double x, double y) {
  return camera.generate(FloatN(static_cast<float>(x)), FloatN(static_cast<float>(y)), lens_u, lens_v);
}
std::optional<FilmPoint> shown_at(const Kernel<PinholeCamera>& camera, const Vec3d& p) { return camera.project(p); }
std::optional<FilmPoint> shown_at(const Kernel<ThinLensCamera>& camera, const Vec3d& p) {
  return camera.project(p, lens_u, lens_v, 0);
}

template <class Camera>
void check_part_of_larger() {
  const auto [shifted, straight] = with_and_without<Camera>();
  for (const double x : {-150.0, 0.0, 77.25})
    for (const double y : {-100.0, 0.5, 100.0}) {
      INFO(x << " " << y);
      const Ray<FloatN> ray = ray_at(shifted, x, y), same = ray_at(straight, x + pixels_across, y + pixels_up);
      CHECK(length(lane_of(ray.origin, 0) - lane_of(same.origin, 0)) == 0);
      CHECK(length(lane_of(ray.direction, 0) - lane_of(same.direction, 0)) < 3e-7);
      // What the ray meets is shown where the ray comes from, and as large.
      const Vec3d p = lane_of(ray.origin, 0) + lane_of(ray.direction, 0) * 40.0;
      const auto point = shown_at(shifted, p), other = shown_at(straight, p);
      REQUIRE(point);
      REQUIRE(other);
      CHECK(point->x == Approx(x).margin(1e-3));
      CHECK(point->y == Approx(y).margin(1e-3));
      CHECK(point->area == Approx(other->area));
      CHECK(length(point->from - other->from) < 1e-12);
    }
}

std::string shifted_camera_message(const std::string& shift) {
  Diagnostics diagnostics("a.xml");
  parse_scene(
      "<raytracer><viewplane><hres>4</hres><vres>4</vres></viewplane><camera><eye x='0' y='0' z='5'/>"
      "<lookat x='0' y='0' z='0'/><viewdistance>4</viewdistance>" +
          shift + "</camera></raytracer>",
      diagnostics, 1);
  return diagnostics.kept().empty() ? "" : diagnostics.kept().front().message;
}

SceneDescription shifted_scene(const std::string& element) {
  const std::string lens = element == "camera" ? "" : "<lensradius>0.5</lensradius><focaldistance>7</focaldistance>";
  return parsed_scene("<raytracer><viewplane><hres>300</hres><vres>200</vres></viewplane><" + element +
                      "><eye x='1' y='2' z='9'/><lookat x='0' y='1' z='0'/><viewdistance>300</viewdistance>"
                      "<shift x='0.25' y='-0.4'/>" +
                      lens + "</" + element + "></raytracer>");
}

}  // namespace

TEST_CASE("a shifted camera has the rays of a part of a larger picture, and shows points where they come from") {
  SECTION("a pinhole") { check_part_of_larger<PinholeCamera>(); }
  SECTION("a lens") { check_part_of_larger<ThinLensCamera>(); }
}

TEST_CASE("the matrix to a shifted picture leads where the camera shows points") {
  for (const std::string element : {"camera", "thinlenscamera"}) {
    const SceneDescription scene = shifted_scene(element);
    const CameraMatrices matrices = camera_matrices(scene);
    const auto place = [&](const Vec3d& p) {
      const float* const m = matrices.world_to_ndc;
      const auto column = [&](int i) { return p.x * m[i] + p.y * m[4 + i] + p.z * m[8 + i] + m[12 + i]; };
      return std::pair{column(0) / column(3), column(1) / column(3)};
    };
    // What the camera looks at is as far to the left of the middle as the view is shifted to the right.
    const auto [x, y] = place({0, 1, 0});
    CHECK(x == Approx(0.5 - 0.25).margin(1e-6));
    CHECK(y == Approx(0.5 + 0.4 * 300 / 200).margin(1e-6));
  }
}

TEST_CASE("a picture of another shape has all in view that a shifted one had") {
  for (const auto& [width, height] : {std::pair{600, 400}, {200, 300}, {900, 200}}) {
    SceneDescription scene = shifted_scene("camera");
    RenderJob job;
    job.resolution = Resolution{width, height};
    apply_job(job, scene);
    const auto& camera = std::get<PinholeCamera::Parameters>(scene.camera);
    const Vec2d shift = shift_in_pixels(camera, scene.viewplane);
    INFO(width << " x " << height);
    CHECK(shift.x * scene.viewplane.pixelsize == Approx(75));
    CHECK(shift.y * scene.viewplane.pixelsize == Approx(-120));
  }
}

TEST_CASE("a shift has two numbers of at most 100") {
  CHECK(shifted_camera_message("<shift x='100' y='-100'/>").empty());
  CHECK(contains(shifted_camera_message("<shift x='0' y='101'/>"), "<shift> are from -100 to 100"));
  CHECK(contains(shifted_camera_message("<shift x='0'/>"), "missing attribute 'y' in <shift>"));
  CHECK(contains(shifted_camera_message("<lensshift x='0' y='0'/>"), "did you mean <shift>?"));
  CHECK(contains(shifted_camera_message("<shiftx>0.1</shiftx>"), "did you mean <shift>?"));
  CHECK(contains(shifted_camera_message("<shift_y>0.1</shift_y>"), "did you mean <shift>?"));
}

}  // namespace raytrace::test
