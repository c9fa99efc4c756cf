// Rays of the cameras whose pictures are no projections on a plane.
#include <cmath>
#include <numbers>

#include "raytrace/cameras/kernels.h"
#include "support/catch.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

using std::numbers::pi;

template <class Camera>
Vec3d direction_at(const Kernel<Camera>& camera, double x, double y) {
  const Ray<FloatN> rays = camera.generate(FloatN(static_cast<float>(x)), FloatN(static_cast<float>(y)));
  CHECK(rays.near.get(0) == 0);
  CHECK(rays.far.get(0) == std::numeric_limits<float>::infinity());
  CHECK(length(lane_of(rays.origin, 0) - Vec3d(camera.origin())) == 0);
  return lane_of(rays.direction, 0);
}

/// The same in double, less its rounding to float.
template <class Camera>
Vec3d precise_direction_at(const Kernel<Camera>& camera, double x, double y) {
  using D = Doubles<FloatN>;
  const Vec3<D> precise = camera.generate(D(FloatN(static_cast<float>(x))), D(FloatN(static_cast<float>(y)))).direction;
  const Vec3<FloatN> rounded = to_float(precise);
  return lane_of(rounded, 0) + lane_of(to_float(precise - Vec3<D>(rounded)), 0);
}

template <class Camera>
void check_direction(const Kernel<Camera>& camera, double x, double y, const Vec3d& wanted) {
  INFO("at " << x << " " << y);
  CHECK(length(direction_at(camera, x, y) - wanted) < 4e-7);
  CHECK(length(precise_direction_at(camera, x, y) - wanted) < 1e-13);
}

const Vec3d eye_all_round{25, 20, 10}, lookat_all_round{-0.5, 3, 7}, up_all_round{0.2, 1, -0.3};
const ViewFrame frame_all_round(eye_all_round, lookat_all_round, up_all_round);

}  // namespace

TEST_CASE("a fisheye's angle from the view direction grows with the distance from the middle") {
  const ViewPlane viewplane{.hres = 400, .vres = 300};  // the circle's radius is 150
  for (const double angle : {1.0, 180.0, 300.0, 360.0}) {
    const Kernel<FisheyeCamera> camera({eye_all_round, lookat_all_round, up_all_round, angle}, viewplane);
    for (const double radius : {0.0, 1.0, 75.0, 150.0})
      for (const double around : {0.0, 0.25, 0.5, 0.75}) {
        const double x = radius * std::cos(2 * pi * around), y = radius * std::sin(2 * pi * around);
        const double from_axis = angle / 2 * pi / 180 * radius / 150;
        const Vec3d aside =
            frame_all_round.u * std::cos(2 * pi * around) + frame_all_round.v * std::sin(2 * pi * around);
        INFO(angle << " degrees");
        check_direction(camera, std::round(x), std::round(y),
                        aside * std::sin(from_axis) - frame_all_round.w * std::cos(from_axis));
      }
  }
}

TEST_CASE("outside of a fisheye's circle there are no rays") {
  const Kernel<FisheyeCamera> camera({eye_all_round, lookat_all_round, up_all_round, 180},
                                     ViewPlane{.hres = 400, .vres = 300});
  const auto inside = [&](float x, float y) { return all(camera.has_ray(FloatN(x), FloatN(y))); };
  CHECK(inside(0, 0));
  CHECK(inside(150, 0));
  CHECK(inside(-90, 120));
  CHECK_FALSE(inside(150.1f, 0));
  CHECK_FALSE(inside(-110, 110));
}

TEST_CASE("a spherical camera has longitudes to the right and latitudes upwards") {
  const ViewPlane viewplane{.hres = 360, .vres = 180};  // a degree a pixel
  const Kernel<SphericalCamera> camera({eye_all_round, lookat_all_round, up_all_round}, viewplane);
  check_direction(camera, 0, 0, -frame_all_round.w);
  check_direction(camera, 90, 0, frame_all_round.u);
  check_direction(camera, -90, 0, -frame_all_round.u);
  check_direction(camera, 180, 0, frame_all_round.w);
  check_direction(camera, 33, 90, frame_all_round.v);
  for (const double longitude : {-179.0, -20.0, 45.0, 130.0})
    for (const double latitude : {-80.0, -1.0, 60.0}) {
      const double l = longitude * pi / 180, b = latitude * pi / 180;
      check_direction(camera, longitude, latitude,
                      (frame_all_round.u * std::sin(l) - frame_all_round.w * std::cos(l)) * std::cos(b) +
                          frame_all_round.v * std::sin(b));
    }
}

TEST_CASE("cameras that are no projections have no matrix to the picture, but one to camera space") {
  const ViewPlane viewplane{.hres = 400, .vres = 300};
  const CameraMatrices fisheye =
      FisheyeCamera::matrices({eye_all_round, lookat_all_round, up_all_round, 180}, viewplane);
  const CameraMatrices spherical =
      SphericalCamera::matrices({eye_all_round, lookat_all_round, up_all_round}, viewplane);
  const CameraMatrices pinhole =
      PinholeCamera::matrices({eye_all_round, lookat_all_round, up_all_round, 500}, viewplane);
  CHECK(pinhole.is_projection);
  for (const auto* matrices : {&fisheye, &spherical}) {
    CHECK_FALSE(matrices->is_projection);
    for (int i = 0; i < 16; ++i) CHECK(matrices->world_to_camera[i] == pinhole.world_to_camera[i]);
  }
}

}  // namespace raytrace::test
