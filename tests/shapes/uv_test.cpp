// Texture coordinates of all shapes: at points where they are known, and that their derivatives are derivatives.
#include "exactness/random.h"
#include "raytrace/math/gather.h"
#include "raytrace/shapes/kernels.h"
#include "support/catch.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

using F = FloatN;

/// The record in all lanes, as Kernel::uv() takes it.
template <class Shape>
auto wide_record(const typename Shape::Parameters& parameters) {
  const auto record = Kernel<Shape>::record(parameters);
  if constexpr (std::is_same_v<Shape, Plane>) {
    return record;
  } else if constexpr (std::is_same_v<Shape, Sphere>) {
    return gather_records<Kernel<Shape>::template Record, F>(&record, LaneIndices(0));
  } else {
    return gather_records<Kernel<Shape>::template Record, Doubles<F>>(&record, LaneIndices(0));
  }
}

/// What rays that pass `through` points hit, from so much before.
template <class Shape>
struct Found {
  F distance;
  SurfacePoint<F> surface;
  SurfaceUv<F> uv, uv_of_other_side;

  Found(const typename Shape::Parameters& parameters, const Vec3<F>& through, const Vec3<F>& direction,
        float before = 20) {
    const Ray<F> rays{through - direction * F(before), direction, F(0), infinity<F>()};
    distance = Kernel<Shape>::template intersect<F>(Kernel<Shape>::record(parameters), rays, Mask<F>(true));
    const auto record = wide_record<Shape>(parameters);
    surface = Kernel<Shape>::surface(record, rays, distance);
    uv = Kernel<Shape>::uv(record, surface.position, surface.normal);
    uv_of_other_side = Kernel<Shape>::uv(record, surface.position, -surface.normal);
  }
};

struct Expected {
  double u, v;
  Vec3d dpdu, dpdv;
};

bool close(const Vec3d& a, const Vec3d& b) { return length(a - b) < 1e-5; }

/// At a point of the surface that a ray in that direction hits.
template <class Shape>
void check_uv(const typename Shape::Parameters& parameters, const Vec3d& at, const Vec3d& direction,
              const Expected& expected, float before = 20) {
  const Found<Shape> found(parameters, spread(at), spread(direction), before);
  INFO(Shape::element << " at " << at.x << ' ' << at.y << ' ' << at.z);
  REQUIRE(close(lane_of(found.surface.position, 0), at));
  for (const SurfaceUv<F>& uv : {found.uv, found.uv_of_other_side}) {
    CHECK(static_cast<double>(uv.u.get(0)) == Approx(expected.u).margin(1e-6));
    CHECK(static_cast<double>(uv.v.get(0)) == Approx(expected.v).margin(1e-6));
    const Vec3d dpdu = lane_of(uv.dpdu, 0), dpdv = lane_of(uv.dpdv, 0);
    INFO("dpdu " << dpdu.x << ' ' << dpdu.y << ' ' << dpdu.z << ", dpdv " << dpdv.x << ' ' << dpdv.y << ' ' << dpdv.z);
    CHECK(close(dpdu, expected.dpdu));
    CHECK(close(dpdv, expected.dpdv));
  }
}

/// Between two hits close to each other, the position has moved as the derivatives say. Shapes about the origin, of
/// sizes about 1.
template <class Shape>
void check_derivatives(const typename Shape::Parameters& parameters) {
  Random random(5);
  int hits = 0, checked = 0, wrong = 0;
  for (int packet = 0; packet < 500; ++packet) {
    constexpr double step = 4e-3;
    std::array<Vec3d, lanes> directions, targets, steps;
    const auto vector = [](const reference::Vector& v) {
      return Vec3d{static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
    };
    for (std::size_t i = 0; i < lanes; ++i) {
      directions[i] = vector(random.direction());
      targets[i] = vector(random.in_cube(1));
      steps[i] = vector(random.direction()) * step;
    }
    const auto direction = vectors_of([&](std::size_t i) { return directions[i]; });
    const auto found_at = [&](double sign) {
      return Found<Shape>(parameters, vectors_of([&](std::size_t i) { return targets[i] + steps[i] * sign; }),
                          direction);
    };
    const Found<Shape> here = found_at(0), before = found_at(-1), after = found_at(1);
    for (std::size_t i = 0; i < lanes; ++i) {
      if (!(here.distance.get(i) < 100 && before.distance.get(i) < 100 && after.distance.get(i) < 100)) continue;
      ++hits;
      const Vec3d moved = lane_of(after.surface.position, i) - lane_of(before.surface.position, i);
      const Vec3d dpdu = lane_of(here.uv.dpdu, i), dpdv = lane_of(here.uv.dpdv, i);
      // Not over an edge, not where the surface is almost along the ray, and not about a pole.
      const Vec3d turn = lane_of(after.surface.normal, i) - lane_of(before.surface.normal, i);
      if (length(turn) > 0.1 || length(moved) > 10 * step || length(dpdu) < 0.9) continue;
      ++checked;
      double du = static_cast<double>(after.uv.u.get(i) - before.uv.u.get(i));
      double dv = static_cast<double>(after.uv.v.get(i) - before.uv.v.get(i));
      if (!std::is_same_v<Shape, Plane>) du -= std::round(du), dv -= std::round(dv);  // angles begin again
      wrong += length(dpdu * du + dpdv * dv - moved) > 0.01 * length(moved) + 1e-5;
    }
  }
  INFO(Shape::element << ": " << wrong << " of " << checked);
  CHECK(wrong == 0);
  CHECK(hits > 500);
  CHECK(checked > hits / 2);
}

constexpr double turn = 6.283185307179586;
const double diagonal = std::sqrt(0.5);

}  // namespace

TEST_CASE("uv of a sphere: longitude from +z to +x, latitude from the south pole") {
  const Sphere::Parameters sphere{{1, 2, 3}, 2};
  check_uv<Sphere>(sphere, {3, 2, 3}, {-1, 0, 0}, {0.25, 0.5, {0, 0, -2 * turn}, {0, turn, 0}});
  check_uv<Sphere>(sphere, {1, 2, 5}, {0, 0, -1}, {0, 0.5, {2 * turn, 0, 0}, {0, turn, 0}});
  check_uv<Sphere>(sphere, {-1, 2, 3}, {1, 0, 0}, {0.75, 0.5, {0, 0, 2 * turn}, {0, turn, 0}});
  const double reach = 2 * diagonal;
  check_uv<Sphere>(sphere, {1 + reach, 2 + reach, 3}, {-1, 0, 0},
                   {0.25, 0.75, {0, 0, -reach * turn}, {-reach * turn / 2, reach * turn / 2, 0}});
  check_uv<Sphere>(sphere, {1, 4, 3}, {0, -1, 0}, {0, 1, {}, {}});
}

TEST_CASE("uv of a plane: units of the world, to the right and up") {
  check_uv<Plane>({{0, 0, 0}, {0, 2, 0}}, {3, 0, -4}, {0, -1, 0}, {3, 4, {1, 0, 0}, {0, 0, -1}});
  check_uv<Plane>({{5, 0, 0}, {1, 0, 0}}, {5, 2, -4}, {-1, 0, 0}, {4, 2, {0, 0, -1}, {0, 1, 0}});
  check_uv<Plane>({{0, 0, 1}, {0, 0, 3}}, {3, 2, 1}, {0, 0, -1}, {3, 2, {1, 0, 0}, {0, 1, 0}});
}

TEST_CASE("uv of a rectangle: along its edges") {
  check_uv<Rectangle>({{1, 1, 0}, {4, 0, 0}, {2, 2, 0}}, {4, 2, 0}, {0, 0, -1}, {0.5, 0.5, {4, 0, 0}, {2, 2, 0}});
}

TEST_CASE("uv of a disk and an annulus: the angle, and the distance from the inner radius") {
  check_uv<Disk>({{1, 2, 3}, {0, 1, 0}, 4}, {1, 2, 4}, {0, -1, 0}, {0, 0.25, {turn, 0, 0}, {0, 0, 4}});
  check_uv<Disk>({{1, 2, 3}, {0, 1, 0}, 4}, {3, 2, 3}, {0, -1, 0}, {0.25, 0.5, {0, 0, -2 * turn}, {4, 0, 0}});
  check_uv<Disk>({{0, 0, 0}, {0, 0, 1}, 4}, {2, 0, 0}, {0, 0, -1}, {0.25, 0.5, {0, 2 * turn, 0}, {4, 0, 0}});
  check_uv<Annulus>({{1, 2, 3}, {0, 1, 0}, 1, 5}, {1, 2, 5}, {0, -1, 0}, {0, 0.25, {2 * turn, 0, 0}, {0, 0, 4}});
  check_uv<Annulus>({{1, 2, 3}, {0, 1, 0}, 1, 5}, {1, 2, 4}, {0, -1, 0}, {0, 0, {turn, 0, 0}, {0, 0, 4}});
}

TEST_CASE("uv of cylinders and cones: the angle about the axis, and from bottom to top") {
  const Cylinder::Parameters cylinder{{0, 1, 0}, {0, 5, 0}, 2, true};
  check_uv<Cylinder>({{0, 1, 0}, {0, 5, 0}, 2, false}, {2, 2, 0}, {-1, 0, 0},
                     {0.25, 0.25, {0, 0, -2 * turn}, {0, 4, 0}});
  check_uv<Cylinder>(cylinder, {2, 2, 0}, {-1, 0, 0}, {0.25, 0.25, {0, 0, -2 * turn}, {0, 4, 0}});
  check_uv<Cylinder>(cylinder, {1, 5, 0}, {0, -1, 0}, {0.25, 0.5, {0, 0, -turn}, {2, 0, 0}});
  check_uv<Cylinder>(cylinder, {1, 1, 0}, {0, 1, 0}, {0.25, 0.5, {0, 0, -turn}, {2, 0, 0}});
  const Cone::Parameters cone{{0, 1, 0}, {0, 5, 0}, 2, 0, true};
  check_uv<Cone>(cone, {1, 3, 0}, {-1, 0, 0}, {0.25, 0.5, {0, 0, -turn}, {-2, 4, 0}});
  check_uv<Cone>(cone, {1, 1, 0}, {0, 1, 0}, {0.25, 0.5, {0, 0, -turn}, {2, 0, 0}});
  check_uv<Cone>(cone, {0, 5, 0}, {0, -1, 0}, {0, 1, {}, {0, 4, 0}});
  check_uv<Cone>({{0, 1, 0}, {0, 5, 0}, 1, 3, false}, {0, 3, 2}, {0, 0, -1}, {0, 0.5, {2 * turn, 0, 0}, {0, 4, 2}});
}

TEST_CASE("uv of a torus: the angle about the axis, and around the tube from the hole over the bottom") {
  const Torus::Parameters torus{{0, 1, 0}, {0, 1, 0}, 3, 1};
  check_uv<Torus>(torus, {4, 1, 0}, {-1, 0, 0}, {0.25, 0.5, {0, 0, -4 * turn}, {0, turn, 0}});
  check_uv<Torus>(torus, {3, 2, 0}, {0, -1, 0}, {0.25, 0.75, {0, 0, -3 * turn}, {-turn, 0, 0}});
  check_uv<Torus>(torus, {0, 0, 3}, {0, 1, 0}, {0, 0.25, {3 * turn, 0, 0}, {0, 0, turn}});
  // The inner sheet of a spindle belongs to the circle on the axis' other side.
  const double root = std::sqrt(3.0);
  check_uv<Torus>({{0, 0, 0}, {0, 1, 0}, 1, 2}, {0, 1, root - 1}, {0, 0, 1},
                  {0.5, 11 / 12.0, {(root - 1) * turn, 0, 0}, {0, -root * turn, turn}}, 0.5F);
}

TEST_CASE("uv of a box: over each face once, to the right and up") {
  const Box::Parameters box{{0, 0, 0}, {4, 2, 8}};
  check_uv<Box>(box, {1, 0.5, 8}, {0, 0, -1}, {0.25, 0.25, {4, 0, 0}, {0, 2, 0}});
  check_uv<Box>(box, {1, 0.5, 0}, {0, 0, 1}, {0.75, 0.25, {-4, 0, 0}, {0, 2, 0}});
  check_uv<Box>(box, {4, 0.5, 2}, {-1, 0, 0}, {0.75, 0.25, {0, 0, -8}, {0, 2, 0}});
  check_uv<Box>(box, {0, 0.5, 2}, {1, 0, 0}, {0.25, 0.25, {0, 0, 8}, {0, 2, 0}});
  check_uv<Box>(box, {1, 2, 2}, {0, -1, 0}, {0.25, 0.75, {4, 0, 0}, {0, 0, -8}});
  check_uv<Box>(box, {1, 0, 2}, {0, 1, 0}, {0.25, 0.25, {4, 0, 0}, {0, 0, 8}});
}

TEST_CASE("positions move as the derivatives by u and v say") {
  const Vec3d aslant{1, 2, -0.5};
  check_derivatives<Plane>({{0.1, 0.2, 0}, aslant});
  check_derivatives<Sphere>({{0.1, 0.2, -0.1}, 1});
  check_derivatives<Rectangle>({{-1, -1, 0.1}, {2, 0.3, 0}, {0.5, 2, 0.3}});
  check_derivatives<Disk>({{0.1, 0.2, -0.1}, aslant, 1.2});
  check_derivatives<Annulus>({{0.1, 0.2, -0.1}, aslant, 0.4, 1.2});
  check_derivatives<Cylinder>({{-0.3, -0.6, 0.4}, {0.5, 0.8, -0.2}, 0.7, false});
  check_derivatives<Cylinder>({{-0.3, -0.6, 0.4}, {0.5, 0.8, -0.2}, 0.7, true});
  check_derivatives<Cone>({{-0.3, -0.6, 0.4}, {0.5, 0.8, -0.2}, 1, 0.3, false});
  check_derivatives<Cone>({{-0.3, -0.6, 0.4}, {0.5, 0.8, -0.2}, 0, 1, true});
  check_derivatives<Torus>({{0.1, 0.2, -0.1}, aslant, 0.8, 0.3});
  check_derivatives<Torus>({{0.1, 0.2, -0.1}, aslant, 0.4, 0.8});
  check_derivatives<Box>({{-0.8, -0.7, -0.9}, {0.7, 0.9, 0.8}});
}

}  // namespace raytrace::test
