// The matrices that pictures carry: row vectors times matrix.
#include <array>
#include <cmath>

#include "raytrace/render/renderer.h"
#include "support/catch.h"
#include "support/parsed_scene.h"

namespace raytrace::test {

namespace {

using Matrix = std::array<double, 16>;

struct Matrices {
  Matrix world_to_camera, world_to_ndc;
};

SceneDescription scene() {
  return parsed_scene(
      "<raytracer><viewplane><hres>640</hres><vres>360</vres><pixelsize>0.25</pixelsize></viewplane>"
      "<camera><eye x='25' y='20' z='10'/><lookat x='-0.5' y='3' z='7'/><up x='0.1' y='1' "
      "z='0.2'/><viewdistance>120</viewdistance></camera>"
      "</raytracer>");
}

Matrices matrices(const SceneDescription& description) {
  const auto& [camera, ndc, is_projection] = camera_matrices(description);
  REQUIRE(is_projection);
  Matrices result;
  std::copy(std::begin(camera), std::end(camera), result.world_to_camera.begin());
  std::copy(std::begin(ndc), std::end(ndc), result.world_to_ndc.begin());
  return result;
}

/// (x y z 1) M, after the divide.
Vec3d transformed(const Vec3d& p, const Matrix& m) {
  const auto column = [&](std::size_t c) { return p.x * m[c] + p.y * m[4 + c] + p.z * m[8 + c] + m[12 + c]; };
  const double w = column(3);
  return {column(0) / w, column(1) / w, column(2) / w};
}

/// A point of the ray through (x, y) of the picture, in pixels from its center.
Vec3d seen_at(const SceneDescription& description, double x, double y, double depth) {
  const auto& camera = std::get<PinholeCamera::Parameters>(description.camera);
  const Vec3d w = normalize(camera.eye - camera.lookat), u = normalize(cross(camera.up, w)), v = cross(w, u);
  const double pixel = description.viewplane.pixelsize;
  return camera.eye + (u * (x * pixel) + v * (y * pixel) - w * camera.viewdistance) * (depth / camera.viewdistance);
}

void check_same(const Vec3d& got, const Vec3d& wanted, double tolerance) {
  INFO(got.x << " " << got.y << " " << got.z << " instead of " << wanted.x << " " << wanted.y << " " << wanted.z);
  CHECK(length(got - wanted) < tolerance);
}

}  // namespace

TEST_CASE("camera space has the eye at its origin, x to the right, y up, and looks along -z") {
  const SceneDescription description = scene();
  const Matrix m = matrices(description).world_to_camera;
  check_same(transformed({25, 20, 10}, m), {0, 0, 0}, 1e-5);
  const double distance = length(Vec3d{25.5, 17, 3});
  check_same(transformed({-0.5, 3, 7}, m), {0, 0, -distance}, 1e-5);
  check_same(transformed(seen_at(description, 100, 0, 120), m), {25, 0, -120}, 1e-4);
  check_same(transformed(seen_at(description, 0, 100, 120), m), {0, 25, -120}, 1e-4);
}

TEST_CASE("world to camera keeps lengths and handedness") {
  const Matrix m = matrices(scene()).world_to_camera;
  const auto row = [&](std::size_t i) { return Vec3d{m[4 * i], m[4 * i + 1], m[4 * i + 2]}; };
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(dot(row(i), row(k)) - (i == k ? 1 : 0)) < 1e-6);
  check_same(cross(row(0), row(1)), row(2), 1e-6);
  // An affine map of row vectors: the translation stands in the last row, and the last column is that of a point.
  CHECK(m[3] == 0);
  CHECK(m[7] == 0);
  CHECK(m[11] == 0);
  CHECK(m[15] == 1);
}

TEST_CASE("the corners of the picture are those of normalised device coordinates, at any depth") {
  const SceneDescription description = scene();
  const Matrix m = matrices(description).world_to_ndc;
  for (const double depth : {1.0, 120.0, 10000.0})
    for (const double x : {0.0, 0.25, 1.0})
      for (const double y : {0.0, 0.5, 1.0}) {
        const Vec3d p = transformed(seen_at(description, (x - 0.5) * 640, (y - 0.5) * 360, depth), m);
        INFO("depth " << depth);
        CHECK(p.x == Approx(x).margin(1e-4));
        CHECK(p.y == Approx(y).margin(1e-4));
      }
}

}  // namespace raytrace::test
