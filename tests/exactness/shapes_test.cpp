// Each shape, alone in its scene, against the reference: where rays hit, whether they do, and the surface there,
// through every query the library has (single rays, packets of the native width, Embree's packets of 4, 8 and 16).
#include <functional>
#include <map>

#include "exactness/judge.h"
#include "support/catch.h"
#include "support/parsed_scene.h"
#include "support/probe.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

using reference::Real;
using reference::Vector;

/// The best instruction set's own queries get all rays; Embree's packets and the other instruction sets those of one
/// scene in so many.
constexpr int others_share = 5;

struct Query {
  std::string name;
  std::function<std::vector<ProbeHit>(const Probe&, std::span<const ProbeRay>)> intersect;
  std::function<std::vector<bool>(const Probe&, std::span<const ProbeRay>)> occluded;
};

bool is_native(const Query& query) { return query.name.starts_with("single") || query.name.starts_with("native"); }

std::vector<Query> queries() {
  std::vector<Query> all = {
      {"single rays", [](const Probe& probe, auto rays) { return probe.intersect_single(rays); },
       [](const Probe& probe, auto rays) { return probe.occluded_single(rays); }},
      {"scattered rays", [](const Probe& probe, auto rays) { return probe.intersect_scattered(rays); },
       [](const Probe& probe, auto rays) { return probe.occluded_scattered(rays); }},
      {"native packets", [](const Probe& probe, auto rays) { return probe.intersect_packet(rays); },
       [](const Probe& probe, auto rays) { return probe.occluded_packet(rays); }}};
  for (const int size : {4, 8, 16}) {
    all.push_back({"Embree's packets of " + std::to_string(size),
                   [size](const Probe& probe, auto rays) { return probe.intersect_embree(rays, size); },
                   [size](const Probe& probe, auto rays) { return probe.occluded_embree(rays, size); }});
  }
  return all;
}

/// The gradient of the implicit function by central differences.
Vector gradient(const reference::Shape& shape, const Vector& p, Real step) {
  const auto along = [&](const Vector& v) { return shape.distance(p + step * v) - shape.distance(p - step * v); };
  return reference::unit({along({1, 0, 0}), along({0, 1, 0}), along({0, 0, 1})});
}

/// The surface's point and normal. The library keeps a hit's distance in float, which moves the hit along the ray by up
/// to 2^-24 of it and turns the normal as the surface curves there. Where that is more than a hundredth, nothing is
/// asked of the normal.
struct SurfaceTally {
  double float_error = 0;  ///< of the corners of a triangle, over its size: turns the normal of a sliver
  long hits = 0, creases = 0, far_away = 0;
  Worst position;  ///< distance from the surface, in units of 2^-24 of the largest coordinate
  Worst normal;    ///< error over 1e-5 + 4 times that turn, float_error, and what grazing adds
  Worst turned;    ///< cosine to the ray: a normal must face its origin

  void count(const ShapeCase& shape, const ProbeRay& ray, const Expectation& expected, const ProbeHit& hit);
};

void SurfaceTally::count(const ShapeCase& shape, const ProbeRay& ray, const Expectation& expected,
                         const ProbeHit& hit) {
  if (expected.is_silhouette() || !hit.hit || expected.first() < 0) return;
  ++hits;
  if (expected.error(static_cast<double>(hit.distance)) > 1) return;
  const reference::Ray exact = exact_ray(ray);
  const Real t = expected.crossings().nearest_to(static_cast<Real>(hit.distance));
  const Vector p = exact.at(t);
  const auto describe = [&] { return replay(*shape.shape, ray); };
  const Real magnitude = std::fmax(length(p), length(shape.center)) + shape.size;
  position.update(
      static_cast<double>(std::fabs(shape.shape->distance(exact_vector(hit.position))) / (0x1p-24L * magnitude)),
      describe);

  const Real step = 1e-6L * shape.shape->smallest_extent() + 1e-13L * length(p);
  Vector normal_there = gradient(*shape.shape, p, step);
  const Real gradient_error = length(normal_there - gradient(*shape.shape, p, step / 2));  // near the tip of a cone
  // Where the two sheets of a torus meet, there is no normal.
  if (std::fabs(dot(normal_there, shape.shape->normal(p))) < 0.9999L) {
    ++creases;
    return;
  }
  if (dot(normal_there, exact.direction) > 0) normal_there = -normal_there;
  const Vector got = exact_vector(hit.normal);
  turned.update(1 + static_cast<double>(dot(got, reference::unit(exact.direction))), describe);
  const Real turn =
      length(shape.shape->normal(exact.at(t * (1 + 0x1p-24L))) - shape.shape->normal(exact.at(t * (1 - 0x1p-24L))));
  if (turn > 0.01L) {
    ++far_away;
    return;
  }
  // On a ray that grazes the surface, which side faces its origin is rounding's to say: that is `turned`'s concern.
  const Real error = std::fmin(length(got - normal_there), length(got + normal_there));
  // A rounding error across the ray moves the hit along it by one over the cosine.
  const Real grazing = 0x1p-24L / std::fabs(dot(normal_there, reference::unit(exact.direction)));
  const Real limit =
      1e-5L + 4 * (turn + grazing + gradient_error) + static_cast<Real>(float_error) * shape.length_over_altitude();
  normal.update(static_cast<double>(error / limit), describe);
}

void check_tally(const Tally& tally, const std::string& what) {
  INFO(what << ": " << tally.rays << " rays, " << tally.hits << " hits, " << tally.misses << " misses, "
            << tally.silhouettes << " at silhouettes");
  {
    INFO("hits that should be misses: " << tally.wrong_hits << ", misses that should be hits: " << tally.wrong_misses
                                        << "\nfirst: " << tally.first_wrong);
    CHECK(tally.wrong_hits * 1'000'000 <= tally.rays / 2);
    CHECK(tally.wrong_misses * 1'000'000 <= tally.rays / 2);
  }
  {
    INFO("worst distance: " << tally.distance.where);
    CHECK(tally.distance.value <= 1);
  }
  // The test itself: all outcomes occurred, and not too much was excused.
  CHECK(tally.hits > tally.rays / 5);
  CHECK(tally.misses > tally.rays / 20);
  CHECK(tally.silhouettes < tally.rays / 4);
}

/// What the surface test needs of one shape.
struct SurfaceLimits {
  double position = 4, normal = 1;
};

void check_shape(const std::string& kind, const Exactness& exactness, const SurfaceLimits& limits) {
  const std::vector<Query> all_queries = queries();
  std::map<std::string, Tally> intersect_tallies, occluded_tallies;
  std::map<std::string, long> disagreements;
  std::map<std::string, SurfaceTally> surfaces;
  Random random(4711);
  const std::vector<std::string> isas = usable_isas();
  for (int scene = ray_count(rays_a_shape) / rays_a_scene; scene >= 0; --scene) {
    const ShapeCase shape = random_shape_case(kind, random);
    std::vector<ProbeRay> rays;
    std::vector<Expectation> expected;
    for (int i = 0; i < rays_a_scene; ++i) {
      rays.push_back(random_ray(shape, random));
      expected.emplace_back(shape, rays.back(), exactness);
    }
    const SceneDescription description = parsed_scene(scene_of({&shape.shape, 1}));
    for (const std::string& isa : isas) {
      const Probe probe(description, isa);
      for (const Query& query : all_queries) {
        const bool always = isa == isas.back() && is_native(query);
        if (!always && scene % others_share != 0) continue;
        const std::string name = kind + ", " + isa + ", " + query.name;
        const std::vector<ProbeHit> hits = query.intersect(probe, rays);
        const std::vector<bool> occluded = query.occluded(probe, rays);
        Tally& intersect_tally = intersect_tallies[name];
        Tally& occluded_tally = occluded_tallies[name];
        const bool has_surface = is_native(query);
        for (std::size_t i = 0; i < rays.size(); ++i) {
          intersect_tally.count(shape, rays[i], expected[i], hits[i].hit, static_cast<double>(hits[i].distance));
          occluded_tally.count(shape, rays[i], expected[i], occluded[i]);
          disagreements[name] += hits[i].hit != occluded[i];
          if (!has_surface) continue;
          SurfaceTally& surface = surfaces[name];
          surface.float_error = exactness.float_errors * 0x1p-24;
          surface.count(shape, rays[i], expected[i], hits[i]);
        }
      }
    }
  }
  for (const auto& [name, tally] : intersect_tallies) check_tally(tally, name + ", intersect");
  for (const auto& [name, tally] : occluded_tallies) check_tally(tally, name + ", occluded");
  for (const auto& [name, count] : disagreements) {
    INFO(name << ": rays whose occluded and intersect disagree");
    CHECK(count == 0);
  }
  for (const auto& [name, surface] : surfaces) {
    CHECK(surface.hits > 0);
    CHECK(surface.creases <= surface.hits / 100);
    CHECK(surface.far_away <= surface.hits / 2);
    {
      INFO(name << ", position off the surface: " << surface.position.where);
      CHECK(surface.position.value <= limits.position);
    }
    {
      INFO(name << ", normal: " << surface.normal.where);
      CHECK(surface.normal.value <= limits.normal);
    }
    {
      INFO(name << ", normal that does not face the ray's origin: " << surface.turned.where);
      CHECK(surface.turned.value <= 1 + 1e-4);
    }
  }
}

}  // namespace

TEST_CASE("exactness of planes") { check_shape("plane", {}, {}); }
TEST_CASE("exactness of spheres") { check_shape("sphere", {}, {}); }
TEST_CASE("exactness of disks") { check_shape("disk", {}, {}); }
TEST_CASE("exactness of rectangles") { check_shape("rectangle", {}, {}); }
TEST_CASE("exactness of cylinders") { check_shape("cylinder", {}, {}); }
TEST_CASE("exactness of toruses") { check_shape("torus", {}, {}); }
TEST_CASE("exactness of boxes") { check_shape("box", {}, {}); }
TEST_CASE("exactness of cones") { check_shape("cone", {}, {}); }
TEST_CASE("exactness of annuli") { check_shape("annulus", {}, {}); }
TEST_CASE("exactness of cylinders with caps") { check_shape("capped cylinder", {}, {}); }
TEST_CASE("exactness of cones with caps") { check_shape("capped cone", {}, {}); }
TEST_CASE("exactness of strands") { check_shape("strand", {}, {}); }
TEST_CASE("exactness of toruses that meet themselves") { check_shape("spindle", {}, {}); }

// Embree solves triangles in float.
TEST_CASE("exactness of triangles") {
  Exactness exactness;
  exactness.float_errors = 4;
  check_shape("triangle", exactness, {});
}

}  // namespace raytrace::test
