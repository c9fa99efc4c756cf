// Rays that leave a hit: never back into the point that they leave, and never past what stands in their way.
#include "exactness/judge.h"
#include "reference/renderer.h"
#include "support/catch.h"
#include "support/parsed_scene.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

using reference::Real;
using reference::Vector;

/// In a direction on the normal's side; every other one grazes the surface, by down to 1e-4.
Vector leaving_direction(const Vector& normal, Random& random) {
  const Vector any = random.direction();
  if (random.chance(0.5)) return dot(any, normal) < 0 ? -any : any;
  const Vector tangent = any - dot(any, normal) * normal;
  return reference::unit(reference::unit(tangent) + random.log_between(1e-4, 1) * normal);
}

struct LeavingTally {
  long rays = 0, free = 0, blocked = 0, uncertain = 0;
  long rehits = 0, leaks = 0;
  std::string first_rehit, first_leak;

  void count(const ShapeCase& shape, const ProbeRay& ray, const ProbeHit& left, const ProbeRay& leaving,
             const ProbeHit& hit);
};

void LeavingTally::count(const ShapeCase& shape, const ProbeRay& ray, const ProbeHit& left, const ProbeRay& leaving,
                         const ProbeHit& hit) {
  // The exact point that `left` means: the crossing closest to the library's.
  const reference::Ray exact = exact_ray(ray);
  const reference::Crossings arriving = shape.shape->crossings(exact);
  if (arriving.count == 0) return;
  const Vector p = exact.at(arriving.nearest_to(static_cast<Real>(left.distance)));
  const Vector direction = exact_vector(leaving.direction);
  // The library's point is another, by the rounding of its distance, and the direction's rounding may have turned it:
  // only directions that leave the surface at both points say anything.
  Vector normal = shape.shape->normal(p), normal_there = shape.shape->normal(exact_vector(left.position));
  if (dot(normal, exact_vector(left.normal)) < 0) normal = -normal;
  if (dot(normal_there, exact_vector(left.normal)) < 0) normal_there = -normal_there;
  if (dot(normal, direction) < 1e-6L + 2 * length(normal - normal_there)) return;

  // How far the secondary ray starts from the exact point. Where that is not small, floats cannot tell the point's
  // surroundings.
  const Real offset = length(exact_vector(leaving.origin) - p);
  if (offset * 64 > shape.shape->smallest_extent()) return;
  // At an edge the point may be on either face, and leave one of them through the other.
  if (arriving.clearance < 4 * offset) return;

  ++rays;
  const reference::Crossings ahead = reference::crossings_leaving(*shape.shape, {p, direction});
  const auto distance = static_cast<Real>(hit.distance);
  const bool has_next = ahead.count > 0;
  const Real next = has_next ? ahead.distances[0] : 0;
  ++(has_next ? blocked : free);

  // Whatever is met well before the next crossing, or where there is none, is the point itself.
  const Real slack = 64 * offset / std::fmin(1.0L, std::fabs(dot(normal, direction)));
  const bool grazes_elsewhere = ahead.clearance < 1e-4L * shape.shape->smallest_extent() + 4 * offset;
  if (hit.hit) {
    const bool meets_next = has_next && distance > 0.5L * next - slack;
    const bool meets_other = grazes_elsewhere && distance > 0.1L * shape.shape->smallest_extent();
    if (!meets_next && !meets_other) {
      if (rehits++ == 0) {
        first_rehit = "re-hit at " + std::to_string(hit.distance) + ", next crossing " +
                      (has_next ? std::to_string(static_cast<double>(next)) : "none") + "\n  arriving " +
                      replay(*shape.shape, ray) + "\n  leaving " + replay(*shape.shape, leaving);
      }
    }
    return;
  }
  if (!has_next) return;
  if (grazes_elsewhere || next < slack) {
    ++uncertain;
    return;
  }
  if (leaks++ == 0) {
    first_leak = "missed what is at " + std::to_string(static_cast<double>(next)) + "\n  arriving " +
                 replay(*shape.shape, ray) + "\n  leaving " + replay(*shape.shape, leaving);
  }
}

void check_leaving(const std::string& kind) {
  const std::vector<std::string> isas = usable_isas();
  for (const std::string& isa : isas) {
    Random random(815);
    LeavingTally packets, scattered, singles;
    const int rays_of_isa = isa == isas.back() ? rays_a_shape : rays_a_shape / 10;
    for (int scene = ray_count(rays_of_isa) / rays_a_scene; scene >= 0; --scene) {
      const ShapeCase shape = random_shape_case(kind, random);
      std::vector<ProbeRay> rays;
      for (int i = 0; i < rays_a_scene; ++i) rays.push_back(random_ray(shape, random));
      const Probe probe(parsed_scene(scene_of({&shape.shape, 1})), isa);
      const std::vector<ProbeHit> left = probe.intersect_packet(rays);
      std::vector<ProbeRay> arriving, leaving;
      std::vector<ProbeHit> arrived;
      for (std::size_t i = 0; i < rays.size(); ++i) {
        if (!left[i].hit) continue;
        const Vector direction = leaving_direction(exact_vector(left[i].normal), random);
        arriving.push_back(rays[i]);
        arrived.push_back(left[i]);
        leaving.push_back({left[i].offset_ray_origin, rounded(direction)});
      }
      // A third of the scenes each: leaving a surface is the same for both, and meeting one is the other tests'
      // concern.
      const int way = scene % 3;
      const std::vector<ProbeHit> hits = way == 0   ? probe.intersect_packet(leaving)
                                         : way == 1 ? probe.intersect_scattered(leaving)
                                                    : probe.intersect_single(leaving);
      for (std::size_t i = 0; i < leaving.size(); ++i) {
        (way == 0   ? packets
         : way == 1 ? scattered
                    : singles)
            .count(shape, arriving[i], arrived[i], leaving[i], hits[i]);
      }
    }
    for (const auto& [queries, tally] :
         {std::pair{"packets", packets}, std::pair{"scattered rays", scattered}, std::pair{"single rays", singles}}) {
      INFO(kind << ", " << isa << ", " << queries << ": " << tally.rays << " rays, " << tally.free << " free, "
                << tally.blocked << " blocked, " << tally.uncertain << " uncertain");
      {
        INFO(tally.rehits << " hit the point they leave; first: " << tally.first_rehit);
        CHECK(tally.rehits == 0);
      }
      {
        INFO(tally.leaks << " pass through the surface; first: " << tally.first_leak);
        CHECK(tally.leaks == 0);
      }
      CHECK(tally.free > 0);
      CHECK(tally.uncertain <= tally.rays / 10);
    }
  }
}

}  // namespace

TEST_CASE("rays that leave a plane") { check_leaving("plane"); }
TEST_CASE("rays that leave a sphere") { check_leaving("sphere"); }
TEST_CASE("rays that leave a triangle") { check_leaving("triangle"); }
TEST_CASE("rays that leave a disk") { check_leaving("disk"); }
TEST_CASE("rays that leave a rectangle") { check_leaving("rectangle"); }
TEST_CASE("rays that leave a cylinder") { check_leaving("cylinder"); }
TEST_CASE("rays that leave a box") { check_leaving("box"); }
TEST_CASE("rays that leave a cone") { check_leaving("cone"); }
TEST_CASE("rays that leave an annulus") { check_leaving("annulus"); }
TEST_CASE("rays that leave a cylinder with caps") { check_leaving("capped cylinder"); }
TEST_CASE("rays that leave a cone with caps") { check_leaving("capped cone"); }
TEST_CASE("rays that leave a torus") { check_leaving("torus"); }

}  // namespace raytrace::test
