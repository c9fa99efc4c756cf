// Scenes of many objects against brute force, and planes to the horizon.
#include "exactness/judge.h"
#include "reference/renderer.h"
#include "support/catch.h"
#include "support/parsed_scene.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

using reference::Real;
using reference::Vector;

template <class Function>
void for_each_isa_and_query(const SceneDescription& description, std::span<const ProbeRay> rays, Function check) {
  for (const std::string& isa : usable_isas()) {
    const Probe probe(description, isa);
    check(isa + ", single rays", probe.intersect_single(rays), probe.occluded_single(rays));
    check(isa + ", scattered rays", probe.intersect_scattered(rays), probe.occluded_scattered(rays));
    check(isa + ", native packets", probe.intersect_packet(rays), probe.occluded_packet(rays));
    for (const int size : {4, 8, 16}) {
      check(isa + ", Embree's packets of " + std::to_string(size), probe.intersect_embree(rays, size),
            probe.occluded_embree(rays, size));
    }
  }
}

/// The nearest crossing of all shapes, and whether any shape's silhouette is too near to say.
struct Nearest {
  int shape = -1;
  Real distance = std::numeric_limits<Real>::infinity();
  bool uncertain = false;
};

Nearest nearest_of(const std::vector<reference::ShapePointer>& shapes, const ProbeRay& ray) {
  const reference::Ray exact = exact_ray(ray);
  Nearest nearest;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const reference::Crossings crossings = shapes[i]->crossings(exact);
    nearest.uncertain |= crossings.clearance < 1e-4L * shapes[i]->smallest_extent();
    for (int k = 0; k < crossings.count; ++k) {
      const Real t = crossings.distances[static_cast<unsigned>(k)];
      if (t > 0 && t < nearest.distance) nearest = {static_cast<int>(i), t, nearest.uncertain};
    }
  }
  return nearest;
}

void check_against_brute_force(const std::vector<reference::ShapePointer>& shapes, const std::vector<ProbeRay>& rays) {
  std::vector<Nearest> wanted;
  for (const ProbeRay& ray : rays) wanted.push_back(nearest_of(shapes, ray));
  // Objects are numbered among those of their element, in their order.
  std::vector<std::uint32_t> numbers;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    std::uint32_t number = 0;
    for (std::size_t k = 0; k < i; ++k) number += shapes[k]->element() == shapes[i]->element();
    numbers.push_back(number);
  }
  std::vector<std::string> elements;
  for_each_type(Shapes{}, [&](auto type) { elements.emplace_back(decltype(type)::type::element); });

  for_each_isa_and_query(
      parsed_scene(scene_of(shapes)), rays,
      [&](const std::string& name, const std::vector<ProbeHit>& hits, const std::vector<bool>& occluded) {
        int certain = 0, hit_count = 0, wrong = 0, wrong_object = 0, disagree = 0;
        Worst worst;
        std::string first;
        for (std::size_t i = 0; i < rays.size(); ++i) {
          disagree += hits[i].hit != occluded[i];
          if (wanted[i].uncertain) continue;
          ++certain;
          const bool should_hit = wanted[i].shape >= 0;
          hit_count += should_hit;
          if (hits[i].hit != should_hit) {
            if (wrong++ == 0) first = std::string(should_hit ? "missed: " : "hit: ") + replay(*shapes[0], rays[i]);
            continue;
          }
          if (!should_hit) continue;
          const auto error = std::fabs(static_cast<Real>(hits[i].distance) - wanted[i].distance) / wanted[i].distance;
          worst.update(static_cast<double>(error),
                       [&] { return replay(*shapes[static_cast<std::size_t>(wanted[i].shape)], rays[i]); });
          const auto shape = static_cast<std::size_t>(wanted[i].shape);
          wrong_object += elements[hits[i].kind] != shapes[shape]->element() || hits[i].index != numbers[shape];
        }
        INFO(name << ": " << certain << " of " << rays.size() << " rays, " << hit_count << " hits");
        {
          INFO("wrong hit or miss, first: " << first);
          CHECK(wrong == 0);
        }
        {
          INFO("worst distance: " << worst.where);
          CHECK(worst.value < 1e-5);
        }
        {
          INFO("another object at the same distance, or the wrong one");
          CHECK(wrong_object <= hit_count / 10000);
        }
        {
          INFO("intersect and occluded disagree");
          CHECK(disagree == 0);
        }
        CHECK(certain > static_cast<int>(rays.size()) / 2);
        CHECK(hit_count > certain / 4);
      });
}

}  // namespace

TEST_CASE("the nearest of many objects of all shapes") {
  Random random(11);
  std::vector<reference::ShapePointer> shapes;
  for (const char* kind : {"sphere", "triangle", "disk", "rectangle", "cylinder", "torus", "box", "cone", "annulus",
                           "capped cylinder", "capped cone"}) {
    for (int i = 0; i < 12; ++i) {
      // Shapes of like size near each other: those of random_shape_case, moved by drawing until they are so.
      ShapeCase shape = random_shape_case(kind, random);
      while (shape.size < 0.3 || shape.size > 3 || length(shape.center) > 5) shape = random_shape_case(kind, random);
      shapes.push_back(shape.shape);
    }
  }
  shapes.push_back(std::make_shared<reference::Plane>(Vector{0, -4, 0}, Vector{0.125L, 1, 0}));
  std::vector<ProbeRay> rays;
  for (int i = ray_count(100'000); i > 0; --i) {
    const Vector target = random.in_cube(5), direction = random.direction();
    rays.push_back(
        {rounded(target - random.between(0, 20) * direction), rounded(random.log_between(0.01, 100) * direction)});
  }
  check_against_brute_force(shapes, rays);
}

TEST_CASE("no ray slips through where triangles meet") {
  Random random(14);
  constexpr int edge = 12;
  std::vector<Vector> corners;  // hills, seen from above
  for (int row = 0; row <= edge; ++row)
    for (int column = 0; column <= edge; ++column)
      corners.push_back(exact_vector(
          rounded({column - edge / 2 + random.between(-0.3, 0.3), random.between(-0.5, 0.5), row - edge / 2 + 0.0})));
  std::vector<reference::ShapePointer> triangles;
  std::vector<ProbeRay> rays;
  const auto aim = [&](const Vector& target) {
    const Vector origin = target + Vector{random.between(-3, 3), random.log_between(2, 1000), random.between(-3, 3)};
    rays.push_back({rounded(origin), rounded(target - origin)});
  };
  for (int row = 0; row < edge; ++row)
    for (int column = 0; column < edge; ++column) {
      const auto at = [&](int right, int down) {
        return corners[static_cast<std::size_t>(row + down) * (edge + 1) + static_cast<std::size_t>(column + right)];
      };
      triangles.push_back(std::make_shared<reference::Triangle>(at(0, 0), at(1, 0), at(0, 1)));
      triangles.push_back(std::make_shared<reference::Triangle>(at(1, 1), at(1, 0), at(0, 1)));
      if (row == 0 || column == 0 || row == edge - 1 || column == edge - 1) continue;
      for (int i = 0; i < 20; ++i) {
        const double share = random.between(0, 1);
        aim(share * at(1, 0) + (1 - share) * at(0, 1));
        aim(share * at(0, 0) + (1 - share) * at(1, 0));
        aim(at(0, 0));
      }
    }
  for_each_isa_and_query(
      parsed_scene(scene_of(triangles)), rays,
      [&](const std::string& name, const std::vector<ProbeHit>& hits, const std::vector<bool>& occluded) {
        INFO(name);
        int missed = 0;
        for (std::size_t i = 0; i < rays.size(); ++i) missed += !hits[i].hit || !occluded[i];
        CHECK(missed == 0);
      });
}

TEST_CASE("the nearest of 10,000 planes") {
  Random random(12);
  std::vector<reference::ShapePointer> planes;
  // Around the middle, which is left free: each one farther away than 1, and most behind others.
  for (int i = 0; i < 10'000; ++i) {
    const Vector normal = random.direction();
    planes.push_back(std::make_shared<reference::Plane>(exact_vector(rounded(random.between(1, 100) * normal)),
                                                        exact_vector(rounded(normal))));
  }
  std::vector<ProbeRay> rays;
  for (int i = std::min(256, ray_count(20'000)); i > 0; --i)
    rays.push_back({rounded(random.in_cube(0.5)), rounded(random.direction())});
  check_against_brute_force(planes, rays);
}

TEST_CASE("a plane is hit to the horizon, and not above it") {
  for (const Real eye_height : {0.001L, 1.0L, 10000.0L}) {
    const std::vector<reference::ShapePointer> plane = {
        std::make_shared<reference::Plane>(Vector{0, -3, 0}, Vector{0, 1, 0})};
    Random random(13);
    std::vector<ProbeRay> rays;
    std::vector<double> wanted;  // negative: none
    for (int i = ray_count(20'000); i > 0; --i) {
      const double angle = random.between(0, 6.283185307179586);
      const double slope = random.sign() * random.log_between(1e-7, 1e-2);  // radians over the horizon, nearly
      const ProbeRay ray{rounded({random.between(-100, 100), -3 + eye_height, random.between(-100, 100)}),
                         rounded({std::cos(angle), slope, std::sin(angle)})};
      rays.push_back(ray);
      wanted.push_back((static_cast<double>(ray.origin.y) + 3) / -static_cast<double>(ray.direction.y));
    }
    for_each_isa_and_query(
        parsed_scene(scene_of(plane)), rays,
        [&](const std::string& name, const std::vector<ProbeHit>& hits, const std::vector<bool>& occluded) {
          int wrong = 0, disagree = 0;
          Worst worst;
          for (std::size_t i = 0; i < rays.size(); ++i) {
            wrong += hits[i].hit != (wanted[i] > 0);
            disagree += hits[i].hit != occluded[i];
            if (hits[i].hit && wanted[i] > 0) {
              worst.update(std::fabs(static_cast<double>(hits[i].distance) / wanted[i] - 1),
                           [&] { return replay(*plane[0], rays[i]); });
            }
          }
          INFO(name << ", eye height " << eye_height << ", worst distance: " << worst.where);
          CHECK(wrong == 0);
          CHECK(disagree == 0);
          CHECK(worst.value < 1e-5);
        });
  }
}

}  // namespace raytrace::test
