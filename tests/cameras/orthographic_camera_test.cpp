// Parallel rays through known points of the picture.
#include <cmath>

#include "raytrace/cameras/kernels.h"
#include "support/catch.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

void check_close(const Vec3d& got, const Vec3d& wanted) {
  INFO(got.x << " " << got.y << " " << got.z << " instead of " << wanted.x << " " << wanted.y << " " << wanted.z);
  CHECK(length(got - wanted) < 1e-5);
}

}  // namespace

TEST_CASE("an orthographic camera's rays are parallel, and a pixel apart by pixelsize") {
  const Vec3d eye{2, 3, 10}, lookat{2, 1, 0};
  const Kernel<OrthographicCamera> camera({eye, lookat, {0, 1, 0}}, ViewPlane{.pixelsize = 0.25});
  const Vec3d w = normalize(eye - lookat), u{1, 0, 0}, v = cross(w, u);
  for (const double x : {-200.0, 0.0, 0.5, 160.0})
    for (const double y : {-120.0, 0.0, 75.5}) {
      const Ray<FloatN> rays = camera.generate(FloatN(static_cast<float>(x)), FloatN(static_cast<float>(y)));
      check_close(lane_of(rays.origin, 0), eye + u * (0.25 * x) + v * (0.25 * y));
      check_close(lane_of(rays.direction, 0), -w);
      CHECK(rays.near.get(0) == 0);
      CHECK(rays.far.get(0) == std::numeric_limits<float>::infinity());
    }
}

TEST_CASE("an orthographic camera's matrices take points to where its rays meet them") {
  const OrthographicCamera::Parameters parameters{{1, 2, 3}, {0, -1, 0.5}, {0.1, 1, 0}};
  const ViewPlane viewplane{.hres = 320, .vres = 200, .pixelsize = 0.1};
  const CameraMatrices matrices = OrthographicCamera::matrices(parameters, viewplane);
  const Kernel<OrthographicCamera> camera(parameters, viewplane);
  const auto transformed = [](const Vec3d& p, const float* m) {
    const auto column = [&](int i) {
      return p.x * double{m[i]} + p.y * double{m[4 + i]} + p.z * double{m[8 + i]} + double{m[12 + i]};
    };
    return Vec3d{column(0) / column(3), column(1) / column(3), column(2) / column(3)};
  };
  for (const double x : {-160.0, -20.0, 160.0})
    for (const double y : {-100.0, 33.0}) {
      const Ray<FloatN> ray = camera.generate(FloatN(static_cast<float>(x)), FloatN(static_cast<float>(y)));
      const Vec3d p = lane_of(ray.origin, 0) + lane_of(ray.direction, 0) * 7.0;
      check_close(transformed(p, matrices.world_to_camera), {0.1 * x, 0.1 * y, -7});
      const Vec3d ndc = transformed(p, matrices.world_to_ndc);
      CHECK(ndc.x == Approx(x / 320 + 0.5).margin(1e-5));
      CHECK(ndc.y == Approx(y / 200 + 0.5).margin(1e-5));
    }
}

}  // namespace raytrace::test
