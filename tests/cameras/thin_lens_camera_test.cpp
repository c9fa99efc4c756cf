// Rays through a lens.
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "raytrace/cameras/kernels.h"
#include "support/catch.h"
#include "support/chi_square.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

ThinLensCamera::Parameters lens_at(const Vec3d& eye, const Vec3d& lookat, double radius, int blades, double rotation) {
  ThinLensCamera::Parameters parameters;
  parameters.eye = eye;
  parameters.lookat = lookat;
  parameters.up = {0.2, 1, -0.3};
  parameters.viewdistance = 400;
  parameters.lensradius = radius;
  parameters.focaldistance = 7;
  parameters.blades = blades;
  parameters.bladerotation = rotation;
  return parameters;
}

/// So many points, evenly over the unit square, packet by packet: f(u1, u2).
template <class Function>
void for_each_point(int count, const Function& f) {
  for (int i = 0; i < count; i += static_cast<int>(lanes)) {
    const auto number = [&](std::size_t lane) { return i + static_cast<double>(lane); };
    f(batch_of<FloatN>([&](std::size_t lane) { return (number(lane) + 0.5) / count; }),
      batch_of<FloatN>([&](std::size_t lane) { return std::fmod(number(lane) * 0.6180339887498949, 1); }));
  }
}

}  // namespace

TEST_CASE("rays from all over a lens meet where the pinhole's ray meets the plane in focus") {
  const Vec3d eye{25, 20, 10}, lookat{-0.5, 3, 7};
  const ViewPlane viewplane{.hres = 320, .vres = 240, .pixelsize = 0.8};
  for (const int blades : {0, 3, 6}) {
    const auto parameters = lens_at(eye, lookat, 0.5, blades, 10);
    const Kernel<ThinLensCamera> camera(parameters, viewplane);
    const ViewFrame frame(eye, lookat, parameters.up);
    double worst = 0, off_lens = 0;
    for (const float x : {-160.0f, 0.0f, 77.25f})
      for (const float y : {-120.0f, 0.5f}) {
        const Vec3d to = frame.u * (0.8 * double{x}) + frame.v * (0.8 * double{y}) - frame.w * 400.0;
        const Vec3d in_focus = eye + to * (7.0 / 400);
        for_each_point(64, [&](const FloatN& u1, const FloatN& u2) {
          const Ray<FloatN> rays = camera.generate(FloatN(x), FloatN(y), u1, u2);
          for (std::size_t lane = 0; lane < lanes; ++lane) {
            const Vec3d origin = lane_of(rays.origin, lane), direction = lane_of(rays.direction, lane);
            const Vec3d way = in_focus - origin;
            worst = std::max({worst, length(cross(way, direction)), std::abs(length(direction) - 1)});
            off_lens = std::max({off_lens, std::abs(dot(origin - eye, frame.w)), length(origin - eye) - 0.5});
          }
        });
      }
    INFO(blades << " blades");
    CHECK(worst < 1e-5);
    CHECK(off_lens < 3e-6);
  }
}

TEST_CASE("a lens of no size is a pinhole") {
  const auto parameters = lens_at({3, 4, 10}, {0, 1, 0}, 0, 0, 0);
  const ViewPlane viewplane{.hres = 320, .vres = 240};
  const Kernel<ThinLensCamera> lens(parameters, viewplane);
  const Kernel<PinholeCamera> pinhole({parameters.eye, parameters.lookat, parameters.up, 400}, viewplane);
  for (const float x : {-160.0f, 3.5f}) {
    const auto through_lens = lens.generate(FloatN(x), FloatN(90), FloatN(0.3f), FloatN(0.9f));
    const auto through_pinhole = pinhole.generate(FloatN(x), FloatN(90));
    CHECK(length(lane_of(through_lens.origin, 0) - parameters.eye) == 0);
    CHECK(length(lane_of(through_lens.direction, 0) - lane_of(through_pinhole.direction, 0)) < 2e-7);
  }
}

TEST_CASE("points of a round lens are uniform, and in the middle where the square's are") {
  const Aperture aperture(0, 0);
  std::vector<double> rings(8), sectors(16);
  for_each_point(65536, [&](const FloatN& u1, const FloatN& u2) {
    const auto [right, up] = aperture.point(u1, u2);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const double x = double{right.get(lane)}, y = double{up.get(lane)}, squared = x * x + y * y;
      REQUIRE(squared <= 1.000001);
      ++rings[std::min<std::size_t>(7, static_cast<std::size_t>(squared * 8))];
      ++sectors[static_cast<std::size_t>((std::atan2(y, x) / std::numbers::pi + 1) * 7.9999999)];
    }
  });
  for (const auto* counts : {&rings, &sectors})
    for (const double count : *counts)
      CHECK(count / (65536.0 / static_cast<double>(counts->size())) == Approx(1).epsilon(0.02));
  const auto [right, up] = aperture.point(FloatN(0.5f), FloatN(0.5f));
  CHECK(right.get(0) == 0);
  CHECK(up.get(0) == 0);
}

TEST_CASE("points of a bladed lens are uniform over the regular polygon with its corners on the circle") {
  for (const int blades : {3, 5, 8}) {
    const double rotation = 25;
    const Aperture aperture(blades, rotation);
    const double reach = std::cos(std::numbers::pi / blades);  // from the middle to a side
    std::vector<double> sides(static_cast<std::size_t>(blades)), rings(4);
    double beyond = 0;
    for_each_point(65536, [&](const FloatN& u1, const FloatN& u2) {
      const auto [right, up] = aperture.point(u1, u2);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const double x = double{right.get(lane)}, y = double{up.get(lane)};
        double turns = (std::atan2(y, x) - rotation * std::numbers::pi / 180) / (2 * std::numbers::pi) * blades;
        turns = std::fmod(turns + 2 * blades, blades);
        const auto side = std::min<std::size_t>(sides.size() - 1, static_cast<std::size_t>(turns));
        const double normal =
            ((static_cast<double>(side) + 0.5) * 2 * std::numbers::pi) / blades + rotation * std::numbers::pi / 180;
        const double outwards = (x * std::cos(normal) + y * std::sin(normal)) / reach;
        beyond = std::max(beyond, outwards - 1);
        ++sides[side];
        ++rings[std::min<std::size_t>(3, static_cast<std::size_t>(std::max(0.0, outwards * outwards * 4)))];
      }
    });
    INFO(blades << " blades");
    CHECK(beyond < 1e-6);
    for (const auto* counts : {&rings, &sides})
      for (const double count : *counts)
        CHECK(count / (65536.0 / static_cast<double>(counts->size())) == Approx(1).epsilon(0.02));
  }
}

}  // namespace raytrace::test
