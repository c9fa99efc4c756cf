// Rays through known points of the picture.
#include <cmath>
#include <vector>

#include "raytrace/cameras/kernels.h"
#include "raytrace/cameras/view_plane.h"
#include "support/catch.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

PinholeCamera::Parameters parameters(Vec3d eye, Vec3d lookat, Vec3d up, double viewdistance) {
  PinholeCamera::Parameters result;
  result.eye = eye;
  result.lookat = lookat;
  result.up = up;
  result.viewdistance = viewdistance;
  return result;
}

Vec3d direction(const Kernel<PinholeCamera>& camera, double x, double y) {
  const Ray<FloatN> rays = camera.generate<FloatN>(FloatN(static_cast<float>(x)), FloatN(static_cast<float>(y)));
  return lane_of(rays.direction, lanes - 1);
}

void check_same(const Vec3d& got, const Vec3d& wanted) {
  INFO(got.x << " " << got.y << " " << got.z << " instead of " << wanted.x << " " << wanted.y << " " << wanted.z);
  CHECK(length(got - wanted) < 3e-7 * std::max(1.0, length(wanted)));
}

}  // namespace

TEST_CASE("a camera on the z axis sees x to the right and y up, as far off as its pixels are large") {
  const Kernel<PinholeCamera> camera(parameters({0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 500), ViewPlane{.pixelsize = 2});
  check_same(direction(camera, 0, 0), {0, 0, -1});
  check_same(direction(camera, 200, 0), normalize(Vec3d{400, 0, -500}));
  check_same(direction(camera, -200, 0), normalize(Vec3d{-400, 0, -500}));
  check_same(direction(camera, 0, 150), normalize(Vec3d{0, 300, -500}));
  for (const double x : {-200.0, 200.0})
    for (const double y : {-150.0, 150.0}) check_same(direction(camera, x, y), normalize(Vec3d{2 * x, 2 * y, -500}));
}

TEST_CASE("rays start at the eye, have unit length and no end") {
  const Kernel<PinholeCamera> camera(parameters({25, 200, 100}, {-0.5, 0, 0}, {0, 1, 0}, 8000),
                                     ViewPlane{.pixelsize = 1});
  const FloatN x = batch_of<FloatN>([](std::size_t i) { return 40.0 * static_cast<double>(i) - 100; });
  const Ray<FloatN> rays = camera.generate<FloatN>(x, FloatN(33));
  CHECK(all(rays.near == FloatN(0)));
  CHECK(all(rays.far == infinity<FloatN>()));
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    check_same(lane_of(rays.origin, lane), {25, 200, 100});
    CHECK(length(lane_of(rays.direction, lane)) == Approx(1).epsilon(1e-6));
  }
}

TEST_CASE("a tilted camera sees what the formulas of the scene format say") {
  const Vec3d eye{25, 200, 100}, lookat{-0.5, 3, 7}, up{0.2, 1, -0.3};
  const Vec3d w = normalize(eye - lookat), u = normalize(cross(up, w)), v = cross(w, u);
  const Kernel<PinholeCamera> camera(parameters(eye, lookat, up, 700), ViewPlane{.pixelsize = 0.8});
  for (const double x : {-320.0, -0.5, 0.0, 77.25, 320.0})
    for (const double y : {-240.0, 0.0, 240.0})
      check_same(direction(camera, x, y), normalize(u * (0.8 * x) + v * (0.8 * y) - w * 700.0));
}

TEST_CASE("looking along `up` still gives a frame, upright and of unit lengths") {
  const std::vector<Vec3d> views{{0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {0, 0, -1}, {0.6, 0.8, 0}, {1, 1, 1}, {1e-12, 5, 0}};
  for (const Vec3d& view : views) {
    for (const double scale : {1.0, -2.0}) {
      const auto [u, v, w] = ViewFrame(view, {0, 0, 0}, view * scale);
      INFO("view " << view.x << " " << view.y << " " << view.z);
      CHECK(length(u) == Approx(1));
      CHECK(length(v) == Approx(1));
      CHECK(std::abs(dot(u, v)) < 1e-12);
      CHECK(std::abs(dot(u, w)) < 1e-12);
      CHECK(std::abs(dot(v, w)) < 1e-12);
      check_same(w, normalize(view));
      check_same(cross(u, v), w);  // right-handed
    }
  }
}

TEST_CASE("another resolution keeps the framing") {
  ViewPlane viewplane;
  viewplane.hres = 400;
  viewplane.vres = 300;
  viewplane.pixelsize = 0.5;
  const auto check_edges = [](const ViewPlane& other, double width, double height) {
    CHECK(other.pixelsize * other.hres == Approx(width));
    CHECK(other.pixelsize * other.vres == Approx(height));
  };
  check_edges(with_resolution(viewplane, 1600, 1200), 200, 150);
  check_edges(with_resolution(viewplane, 40, 30), 200, 150);
  // Of another shape: the whole former picture is in view, and touches two edges.
  check_edges(with_resolution(viewplane, 400, 400), 200, 200);
  check_edges(with_resolution(viewplane, 800, 300), 400, 150);

  const PinholeCamera::Parameters camera = parameters({1, 2, 3}, {0, 0, 0}, {0, 1, 0}, 100);
  const ViewPlane larger = with_resolution(viewplane, 1000, 750);
  check_same(direction(Kernel<PinholeCamera>(camera, larger), 500, 375),
             direction(Kernel<PinholeCamera>(camera, viewplane), 200, 150));
}

}  // namespace raytrace::test
