// Rays that Embree cannot take, in some lanes of a packet: nothing crashes, they miss, and the others answer as before.
#include <limits>

#include "exactness/shape_cases.h"
#include "support/catch.h"
#include "support/parsed_scene.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

/// What a component of a ray must not be. The last ones are beyond what Embree takes (1.8e18).
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float refused[] = {nan, -nan, infinite, -infinite, 1e19F, -1e19F, 1e30F, 3e38F};

ProbeRay spoilt(ProbeRay ray, Random& random) {
  if (random.chance(0.2)) {  // no direction, or one whose square vanishes
    constexpr float small[] = {0, -0.0F, 1e-45F, 1e-40F, 1e-30F};
    const float x = small[random.below(5)];
    ray.direction = {x, x, x};
    return ray;
  }
  float* const components[] = {&ray.origin.x,    &ray.origin.y,    &ray.origin.z,
                               &ray.direction.x, &ray.direction.y, &ray.direction.z};
  for (int i = 1 + random.below(3); i > 0; --i) *components[random.below(6)] = refused[random.below(8)];
  return ray;
}

ProbeRay without_interval(ProbeRay ray, Random& random) {
  switch (random.below(3)) {
    case 0:
      ray.near = nan;
      break;
    case 1:
      ray.far = nan;
      break;
    default:
      ray.far = -1;
      break;
  }
  return ray;
}

bool same(const ProbeHit& a, const ProbeHit& b) {
  return a.hit == b.hit && (!a.hit || (a.distance == b.distance && a.kind == b.kind && a.index == b.index));
}

struct Way {
  const char* name;
  std::vector<ProbeHit> (Probe::*intersect)(std::span<const ProbeRay>) const;
  std::vector<bool> (Probe::*occluded)(std::span<const ProbeRay>) const;
};

constexpr Way ways[] = {{"packets", &Probe::intersect_packet, &Probe::occluded_packet},
                        {"scattered rays", &Probe::intersect_scattered, &Probe::occluded_scattered},
                        {"single rays", &Probe::intersect_single, &Probe::occluded_single}};

}  // namespace

TEST_CASE("rays that Embree cannot take miss and leave the other lanes alone") {
  Random random(21);
  std::vector<reference::ShapePointer> shapes;
  for (const char* kind : {"plane", "sphere", "triangle", "disk", "rectangle", "cylinder", "torus", "spindle", "box",
                           "cone", "annulus", "capped cylinder", "capped cone"}) {
    shapes.push_back(random_shape_case(kind, random).shape);
  }
  const ShapeCase target = random_shape_case("sphere", random);
  shapes.push_back(target.shape);
  const SceneDescription description = parsed_scene(scene_of(shapes));
  for (const std::string& isa : usable_isas()) {
    const Probe probe(description, isa);
    for (int round = 0; round < 200; ++round) {
      std::vector<ProbeRay> good, mixed;
      std::vector<bool> bad;
      for (int i = 0; i < 64; ++i) {
        ProbeRay ray = random_ray(target, random);
        ray.near = 0;
        ray.far = 3e38F;
        good.push_back(ray);
        bad.push_back(random.chance(0.4));
        mixed.push_back(!bad.back() ? ray : random.chance(0.8) ? spoilt(ray, random) : without_interval(ray, random));
      }
      for (const Way& way : ways) {
        INFO(isa << ", " << way.name << ", round " << round);
        const auto before = (probe.*way.intersect)(good), after = (probe.*way.intersect)(mixed);
        const auto occluded = (probe.*way.occluded)(mixed);
        for (std::size_t i = 0; i < good.size(); ++i) {
          INFO(replay(*target.shape, mixed[i]));
          if (bad[i]) {
            REQUIRE_FALSE(after[i].hit);
            REQUIRE_FALSE(occluded[i]);
          } else {
            REQUIRE(same(before[i], after[i]));
            REQUIRE(occluded[i] == before[i].hit);
          }
        }
      }
    }
  }
}

}  // namespace raytrace::test
