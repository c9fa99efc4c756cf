// Which of many lights a point is lit by: each as often as the tree says, and none never that could light it.
//
// Wide code is compiled for each instruction set apart, so the test has its own.
#include "raytrace/scene/light_tree.cpp"  // NOLINT(bugprone-suspicious-include)

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "support/catch.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

class RandomLights {
 public:
  explicit RandomLights(unsigned seed) : bits_(seed) {}

  double number(double low, double high) { return low + (high - low) * static_cast<double>(bits_()) / 4294967296.0; }
  Vec3d in_cube(double half) { return {number(-half, half), number(-half, half), number(-half, half)}; }
  Vec3d direction() {
    Vec3d v;
    do v = in_cube(1);
    while (dot(v, v) > 1 || dot(v, v) < 0.01);
    return normalize(v);
  }
  /// A direction in a cone; one of four on its edge.
  Vec3d in_cone(const Vec3d& axis, double cosine) {
    const double z = bits_() % 4 == 0 ? cosine : number(cosine, 1);
    const Vec3d side = normalize(cross(axis, std::abs(axis.x) < 0.5 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0}));
    const double around = number(0, 2 * std::numbers::pi), r = std::sqrt(std::max(1 - z * z, 0.0));
    return axis * z + side * (r * std::cos(around)) + cross(axis, side) * (r * std::sin(around));
  }

  /// Flat ones, round ones, points; some that shine to all sides, and some of a power far beyond that of others.
  LightEmission light(double extent) {
    const Vec3f middle(in_cube(extent));
    const double size = std::pow(10, number(-3, 0.3));
    const Vec3f half(static_cast<float>(size * number(0, 1)), static_cast<float>(bits_() % 3 == 0 ? 0 : size),
                     static_cast<float>(bits_() % 5 == 0 ? 0 : size * number(0, 1)));
    const float cosines[] = {1, 1, 0.8F, 0, -0.5F, -1};
    return {{middle - half, middle + half},
            Vec3f(direction()),
            cosines[bits_() % 6],
            static_cast<float>(std::pow(10, number(-3, 3)))};
  }
  std::vector<LightEmission> lights(std::size_t count) {
    std::vector<LightEmission> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back(light(4));
    return result;
  }

 private:
  std::mt19937 bits_;
};

std::vector<double> probabilities(const LightTree& tree, std::size_t count, const Vec3d& p, const Vec3d& normal) {
  std::vector<double> result;
  for (std::size_t first = 0; first < count; first += lanes) {
    const FloatN here = tree.probability(
        spread(p), spread(normal), batch_of<IntN>([&](std::size_t lane) { return std::min(first + lane, count - 1); }));
    for (std::size_t lane = 0; lane < lanes && first + lane < count; ++lane)
      result.push_back(static_cast<double>(here.get(lane)));
  }
  return result;
}

/// Draws with evenly spread numbers, so that each light must be drawn as often as its probability says, give or take
/// where its interval begins and ends. The last cell counts those that reach no light.
void check_draws(const LightTree& tree, std::size_t count, const Vec3d& p, const Vec3d& normal) {
  constexpr std::size_t draws = 1U << 16U;
  const std::vector<double> wanted = probabilities(tree, count, p, normal);
  std::vector<double> seen(count + 1);
  int wrong_lights = 0, wrong_probabilities = 0;
  for (std::size_t first = 0; first < draws; first += lanes) {
    const auto u =
        batch_of<FloatN>([&](std::size_t lane) { return (static_cast<double>(first + lane) + 0.5) / draws; });
    const LightTree::Choice choice = tree.sample(spread(p), spread(normal), u);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const auto light = static_cast<std::size_t>(choice.light.get(lane));
      const double probability = static_cast<double>(choice.probability.get(lane));
      if (light >= count)
        ++wrong_lights;
      else if (probability > 0 && std::abs(probability - wanted[light]) > 1e-6 * wanted[light])
        ++wrong_probabilities;
      else
        ++seen[probability > 0 ? light : count];
    }
  }
  CHECK(wrong_lights == 0);
  CHECK(wrong_probabilities == 0);
  double sum = 0, most_apart = 0;
  for (std::size_t i = 0; i < count; ++i) {
    sum += wanted[i];
    most_apart = std::max(most_apart, std::abs(seen[i] - wanted[i] * draws));
  }
  INFO("they add up to " << sum << ", and " << seen[count] << " of " << draws << " draws reach none");
  CHECK(std::abs(sum + seen[count] / draws - 1) < 1e-3);
  if (seen[count] == 0) CHECK(std::abs(sum - 1) < 1e-5);
  CHECK(most_apart < 4);
}

/// Lights of which points that see them are found, and that are never drawn there.
int lights_left_out(const LightTree& tree, const std::vector<LightEmission>& lights, LightTree::Reach reach,
                    RandomLights& random) {
  int left_out = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3d p = random.in_cube(5), normal = random.direction();
    const std::vector<double> chosen = probabilities(tree, lights.size(), p, normal);
    for (std::size_t j = 0; j < lights.size(); ++j) {
      if (chosen[j] > 0) continue;
      const LightEmission& light = lights[j];
      for (int k = 0; k < 8; ++k) {
        const Vec3d lower(light.box.lower), upper(light.box.upper);
        const Vec3d x{random.number(lower.x, upper.x), random.number(lower.y, upper.y),
                      random.number(lower.z, upper.z)};
        const Vec3d to_light = x - p;
        const double cosine = static_cast<double>(light.cosine), least = 1e-4 * length(to_light);
        const Vec3d front = random.in_cone(normalize(Vec3d(light.axis)), cosine);
        const bool reaches = reach == LightTree::Reach::hemispheres
                                 ? -dot(front, to_light) > least
                                 : -dot(normalize(Vec3d(light.axis)), to_light) > cosine * length(to_light) + least;
        if (dot(normal, to_light) > least && reaches) {
          ++left_out;
          break;
        }
      }
    }
  }
  return left_out;
}

}  // namespace

TEST_CASE("a tree of lights draws each as often as it says, and all of them together always") {
  RandomLights random(11);
  for (const LightSampling sampling : {LightSampling::tree, LightSampling::power, LightSampling::uniform})
    for (const std::size_t count : {1U, 2U, 3U, 17U, 150U}) {
      const std::vector<LightEmission> lights = random.lights(count);
      const LightTree tree(lights, sampling);
      for (int i = 0; i < 12; ++i) {
        // Every third point is in a light.
        const Vec3d p = i % 3 == 0 ? Vec3d((lights[0].box.lower + lights[0].box.upper) * 0.5F) : random.in_cube(6);
        INFO(count << " lights, " << static_cast<int>(sampling) << ", point " << i);
        check_draws(tree, count, p, random.direction());
        check_draws(tree, count, p, {0, 0, 0});  // of a point in a medium
      }
    }
}

TEST_CASE("lights in one place, and lights in a row that is cut off one by one, make a tree as others") {
  RandomLights random(12);
  std::vector<LightEmission> same(40, random.light(1)), row;
  for (int i = 0; i < 90; ++i) {
    LightEmission light = random.light(0);
    const Vec3f place(std::ldexp(1.0F, i), 0, 0);
    light.box = {place, place};
    light.power = std::ldexp(1.0F, i);
    row.push_back(light);
  }
  for (const std::vector<LightEmission>& lights : {same, row})
    for (int i = 0; i < 12; ++i)
      check_draws(LightTree(lights, LightSampling::power), lights.size(), random.in_cube(3), random.direction());
  const LightTree tree(same, LightSampling::tree);
  for (int i = 0; i < 12; ++i) check_draws(tree, same.size(), random.in_cube(3), random.direction());
}

TEST_CASE("by power and evenly, lights are drawn in these proportions") {
  RandomLights random(13);
  const std::vector<LightEmission> lights = random.lights(60);
  double total = 0;
  for (const LightEmission& light : lights) total += static_cast<double>(light.power);
  const auto power = probabilities(LightTree(lights, LightSampling::power), 60, {0, 1, 0}, {0, 1, 0});
  const auto even = probabilities(LightTree(lights, LightSampling::uniform), 60, {0, 1, 0}, {0, 1, 0});
  for (std::size_t i = 0; i < 60; ++i) {
    const double share = static_cast<double>(lights[i].power) / total;
    CHECK(std::abs(power[i] - share) < 1e-5 * share + 1e-7);
    CHECK(std::abs(even[i] - 1.0 / 60) < 1e-6);
  }
}

TEST_CASE("for points on no surface, lights are drawn that may light others near them") {
  RandomLights random(16);
  const std::vector<LightEmission> lights = random.lights(60);
  const LightTree tree(lights, LightSampling::tree, LightTree::Reach::cone);
  for (int i = 0; i < 40; ++i) {
    const std::vector<double> chosen = probabilities(tree, 60, random.in_cube(5), {0, 0, 0});
    CHECK(*std::min_element(chosen.begin(), chosen.end()) > 0);
  }
}

TEST_CASE("leaves of several lights have each light once, and are drawn as often as they say") {
  RandomLights random(15);
  for (const std::size_t count : {1U, 8U, 9U, 150U}) {
    INFO(count << " lights");
    const std::vector<LightEmission> lights = random.lights(count);
    const LightTree tree(lights, LightSampling::tree, LightTree::Reach::cone, 8);
    std::vector<int> found(count, 0);
    for (const std::uint32_t light : tree.leaves())
      if (light != LightTree::none) ++found[light];
    CHECK(std::count(found.begin(), found.end(), 1) == static_cast<std::ptrdiff_t>(count));
    CHECK(tree.leaves().size() % 8 == 0);
    for (int i = 0; i < 12; ++i) {
      const Vec3d p = random.in_cube(6), normal = random.direction();
      const std::vector<double> of_lights = probabilities(tree, count, p, normal);
      int wrong = 0;
      for (std::size_t first = 0; first < 4096; first += lanes) {
        const LightTree::Choice choice = tree.sample(spread(p), spread(normal), batch_of<FloatN>([&](std::size_t lane) {
                                                       return (static_cast<double>(first + lane) + 0.5) / 4096;
                                                     }));
        for (std::size_t lane = 0; lane < lanes; ++lane) {
          const auto leaf = static_cast<std::size_t>(choice.light.get(lane));
          const double wanted = of_lights[tree.leaves().at(leaf * 8)],
                       rest = static_cast<double>(choice.rest.get(lane));
          const double probability = static_cast<double>(choice.probability.get(lane));
          wrong += rest < 0 || rest >= 1 || (probability > 0 && std::abs(probability - wanted) > 1e-6 * wanted) ? 1 : 0;
        }
      }
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("no light is left out that could light a point") {
  RandomLights random(14);
  for (const std::size_t count : {1U, 2U, 9U, 60U, 300U}) {
    const std::vector<LightEmission> lights = random.lights(count);
    INFO(count << " lights");
    for (const LightTree::Reach reach : {LightTree::Reach::hemispheres, LightTree::Reach::cone}) {
      INFO((reach == LightTree::Reach::cone ? "that shine in cones" : "of surfaces"));
      for (const std::size_t leaf_size : {1U, 8U})
        CHECK(lights_left_out(LightTree(lights, LightSampling::tree, reach, leaf_size), lights, reach, random) == 0);
    }
  }
}

}  // namespace raytrace::test
