// The reference against closed forms, and against dense sampling of each shape's implicit function.
#include "random.h"
#include "renderer.h"
#include "support/catch.h"

using namespace reference;

namespace {

double at(const Crossings& crossings, unsigned i) { return static_cast<double>(crossings.distances[i]); }

/// Counts the changes of sign of the distance to the surface along a unit ray. No change can lie nearer than the
/// distance itself, so that much is stepped over, but never less than `step`.
int sign_changes(const Shape& shape, const Ray& ray, Real reach, Real step) {
  int changes = 0;
  Real distance = shape.distance(ray.at(-reach));
  for (Real t = -reach; t <= reach; t += std::fmax(std::fabs(distance), step)) {
    const Real here = shape.distance(ray.at(t));
    changes += (here < 0) != (distance < 0);
    distance = here;
  }
  return changes;
}

}  // namespace

TEST_CASE("reference: a sphere is crossed at its poles, in multiples of the direction") {
  const Crossings crossings = Sphere({1, 2, 3}, 2).crossings({{1, 2, -7}, {0, 0, 4}});
  REQUIRE(crossings.count == 2);
  CHECK(at(crossings, 0) == 2);
  CHECK(at(crossings, 1) == 3);
  CHECK(static_cast<double>(crossings.clearance) == 2);
}

TEST_CASE("reference: planes, disks and triangles are crossed where the formula says") {
  const Ray ray{{0.25L, 5, 0.25L}, {0, -2, 0}};
  CHECK(at(Plane({9, 1, 9}, {0, 3, 0}).crossings(ray), 0) == 2);
  CHECK(Plane({0, 1, 0}, {0, 1, 0}).crossings({{0, 5, 0}, {1, 0, 0}}).count == 0);
  CHECK(at(Disk({0, 1, 0}, {0, -3, 0}, 1).crossings(ray), 0) == 2);
  CHECK(Disk({0, 1, 0}, {0, -3, 0}, 0.35L).crossings(ray).count == 0);
  const Triangle triangle({0, 1, 0}, {1, 1, 0}, {0, 1, 1});
  CHECK(at(triangle.crossings(ray), 0) == 2);
  CHECK(triangle.crossings({{0.6L, 5, 0.6L}, {0, -2, 0}}).count == 0);
  CHECK(static_cast<double>(triangle.crossings(ray).clearance) == 0.25);
  CHECK(static_cast<double>(triangle.smallest_extent()) == Approx(std::sqrt(0.5)));
}

TEST_CASE("reference: a cylinder has no caps") {
  const Cylinder cylinder({0, -1, 0}, {0, 3, 0}, 2);
  const Crossings across = cylinder.crossings({{-5, 0, 0}, {1, 0, 0}});
  REQUIRE(across.count == 2);
  CHECK(at(across, 0) == 3);
  CHECK(at(across, 1) == 7);
  CHECK(cylinder.crossings({{0, -5, 0}, {0, 1, 0}}).count == 0);
  const Crossings through_the_top = cylinder.crossings({{0, 4, 0}, {1, -1, 0}});
  REQUIRE(through_the_top.count == 1);
  CHECK(at(through_the_top, 0) == 2);
}

TEST_CASE("reference: boxes, cones, annuli and caps are crossed where the formula says") {
  const auto check = [](const Shape& shape, const Ray& ray, double first, double second) {
    INFO(shape.element() << shape.parameters());
    const Crossings crossings = shape.crossings(ray);
    REQUIRE(crossings.count == 2);
    CHECK(at(crossings, 0) == Approx(first));
    CHECK(at(crossings, 1) == Approx(second));
  };
  check(Box({0, 0, 0}, {1, 2, 4}), {{0.5L, 0.5L, -2}, {0, 0, 2}}, 1, 3);
  CHECK(Box({0, 0, 0}, {1, 2, 4}).crossings({{0.5L, 2.5L, -2}, {0, 0, 2}}).count == 0);
  check(CappedCylinder({0, -1, 0}, {0, 3, 0}, 2), {{1, -5, 0}, {0, 1, 0}}, 4, 8);
  check(CappedCylinder({0, -1, 0}, {0, 3, 0}, 2), {{0, 4, 0}, {1, -1, 0}}, 1, 2);
  for (const bool caps : {false, true}) check(Cone({0, 0, 0}, {0, 4, 0}, 2, 0, caps), {{-5, 2, 0}, {1, 0, 0}}, 4, 6);
  check(Cone({0, 0, 0}, {0, 4, 0}, 2, 0, true), {{1, 9, 0}, {0, -1, 0}}, 7, 9);
  CHECK(Cone({0, 0, 0}, {0, 4, 0}, 2, 0, false).crossings({{1, 9, 0}, {0, -1, 0}}).count == 1);
  CHECK(Cone({0, 0, 0}, {0, 4, 0}, 2, 0, true).crossings({{-5, 4.5L, 0}, {1, 0, 0}}).count == 0);
  const Annulus annulus({0, 0, 0}, {0, 1, 0}, 2, 1);
  CHECK(at(annulus.crossings({{1.5L, 3, 0}, {0, -1, 0}}), 0) == 3);
  CHECK(annulus.crossings({{0.5L, 3, 0}, {0, -1, 0}}).count == 0);
}

TEST_CASE("reference: a torus is crossed four times through its plane, twice along its axis's side") {
  const Torus torus({1, 1, 1}, {0, 0, 5}, 3, 0.5L);
  const Crossings through = torus.crossings({{-9, 1, 1}, {1, 0, 0}});
  REQUIRE(through.count == 4);
  for (unsigned i = 0; i < 4; ++i) CHECK(at(through, i) == Approx(std::array{6.5, 7.5, 12.5, 13.5}[i]).epsilon(1e-15));
  CHECK(torus.crossings({{1, 1, -9}, {0, 0, 1}}).count == 0);
  const Crossings down = torus.crossings({{4, 1, 9}, {0, 0, -1}});
  REQUIRE(down.count == 2);
  CHECK(at(down, 0) == Approx(7.5).epsilon(1e-15));
  CHECK(at(down, 1) == Approx(8.5).epsilon(1e-15));
  CHECK(torus.crossings({{1, 4.5L + 1e-9L, -9}, {0, 0, 1}}).count == 0);  // a hair outside
}

TEST_CASE("reference: a torus's crossings are all that dense sampling finds, and lie on it") {
  Random random(1);
  int rays = 0;
  for (const Real tube : {0.0001L, 0.01L, 0.3L, 0.99L, 1.5L}) {
    for (const Real far : {0.0L, 1.0L, 10000.0L}) {
      for (int i = 0; i < 60; ++i) {
        const Torus torus(random.in_cube(1), random.in_cube(1), 1, tube);
        // Aim at a point of the tube, so that thin ones are hit too.
        const Vector axis = unit(random.in_cube(1)), side = perpendicular(axis);
        const Torus aimed({0, 0, 0}, axis, 1, tube);
        const Vector target = side + tube * random.in_cube(1);
        const Vector direction = unit(random.in_cube(1));
        const Ray ray{target - far * direction, direction};
        const Crossings crossings = aimed.crossings(ray);
        for (int k = 0; k < crossings.count; ++k) {
          const Vector p = ray.at(crossings.distances[static_cast<unsigned>(k)]);
          REQUIRE(std::fabs(static_cast<double>(aimed.distance(p) / tube)) < 1e-9);
        }
        if (crossings.clearance < 0.01L * tube || tube > 1) continue;  // inside the spindle the distance has a crease
        const Ray centred{ray.at(far), direction};
        REQUIRE(sign_changes(aimed, centred, 4, tube / 1000) == crossings.count);
        ++rays;
      }
    }
  }
  CHECK(rays > 400);
}

TEST_CASE("reference: normals are the gradient of the distance") {
  Random random(2);
  for (int i = 0; i < 300; ++i) {
    const std::vector<ShapePointer> shapes = {
        std::make_shared<Plane>(random.in_cube(1), random.in_cube(2)),
        std::make_shared<Disk>(random.in_cube(1), random.in_cube(2), 2),
        std::make_shared<Sphere>(random.in_cube(1), 1.5L),
        std::make_shared<Triangle>(random.in_cube(3), random.in_cube(3), random.in_cube(3)),
        std::make_shared<Cylinder>(random.in_cube(1), random.in_cube(3), 0.7L),
        std::make_shared<Torus>(random.in_cube(1), random.in_cube(1), 1, 0.4L),
        std::make_shared<Torus>(random.in_cube(1), random.in_cube(1), 1, 1.4L)};
    for (const ShapePointer& shape : shapes) {
      const Ray ray{random.in_cube(5), random.in_cube(1)};
      const Crossings crossings = shape->crossings(ray);
      for (int k = 0; k < crossings.count; ++k) {
        const Vector p = ray.at(crossings.distances[static_cast<unsigned>(k)]);
        const Real h = 1e-6L;
        const Vector gradient{shape->distance(p + Vector{h, 0, 0}) - shape->distance(p - Vector{h, 0, 0}),
                              shape->distance(p + Vector{0, h, 0}) - shape->distance(p - Vector{0, h, 0}),
                              shape->distance(p + Vector{0, 0, h}) - shape->distance(p - Vector{0, 0, h})};
        REQUIRE(static_cast<double>(length(unit(gradient) - shape->normal(p))) < 1e-6);
      }
    }
  }
}

TEST_CASE("reference: a ray that leaves a sphere from inside meets the other side, from outside nothing") {
  const Sphere sphere({0, 0, 0}, 1);
  CHECK(crossings_leaving(sphere, {{1, 0, 0}, {1, 0.1L, 0}}).count == 0);
  const Crossings inwards = crossings_leaving(sphere, {{1, 0, 0}, {-1, 0, 0}});
  REQUIRE(inwards.count == 1);
  CHECK(at(inwards, 0) == Approx(2));
}

TEST_CASE("reference: the camera's first row is the bottom, its first column the left") {
  Scene scene;
  scene.hres = 4;
  scene.vres = 2;
  scene.pixel_size = 0.5L;
  scene.eye = {0, 0, 5};
  scene.view_distance = 2;
  const Ray ray = camera_ray(scene, 0, 1, 0.5L, 0.5L);
  CHECK(static_cast<double>(ray.direction.x) == -0.75);
  CHECK(static_cast<double>(ray.direction.y) == 0.25);
  CHECK(static_cast<double>(ray.direction.z) == -2);
}
