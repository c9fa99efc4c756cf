// Photons around a point: the light that is chosen for all of them, against a sum over all photons in double precision.
#include "raytrace/tracing/photon_map.cpp"  // NOLINT(bugprone-suspicious-include)

#include <cmath>
#include <random>

#include "support/catch.h"

namespace raytrace::test {

namespace {

Vec3<FloatN> everywhere(const Vec3f& v) { return Vec3<FloatN>(v); }

/// On a floor at height 0 and on its lower side, and on a sheet above it, under lights from two sides.
std::vector<Photon> photons_on_a_floor(int count) {
  std::mt19937 bits(7);
  std::uniform_real_distribution<float> place(-1, 1), flux(0.1F, 2);
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    Photon photon;
    const bool below = i % 5 == 0, on_sheet = i % 7 == 0;
    photon.p = {place(bits), on_sheet ? 0.08F : 0.0F, place(bits)};
    photon.normal = {0, below ? -1.0F : 1.0F, 0};
    photon.wi = Vec3f{0.6F, below ? -0.8F : 0.8F, 0};
    photon.flux = Rgb<float>(flux(bits), flux(bits), -flux(bits)) * 1e-3F;
    photon.group = i % 3;
    photon.points = 1 + i % 4;
    photons.push_back(photon);
  }
  return photons;
}

struct Expected {
  std::array<double, 3> flux_density{};
  int photons = 0;
};

Expected expected(const std::vector<Photon>& photons, const Vec3d& p, const Vec3d& normal, double radius,
                  int most_points) {
  Expected result;
  for (const Photon& photon : photons) {
    const Vec3d way = Vec3d(photon.p) - p;
    const double above = dot(way, normal), distance2 = dot(way, way) + 3 * above * above;
    if (distance2 >= radius * radius || photon.points > most_points || dot(Vec3d(photon.normal), normal) < 0.7)
      continue;
    const double kernel = 2 / (std::numbers::pi * radius * radius) * (1 - distance2 / (radius * radius));
    result.flux_density[0] += kernel * double{photon.flux.red};
    result.flux_density[1] += kernel * double{photon.flux.green};
    result.flux_density[2] += kernel * double{photon.flux.blue};
    ++result.photons;
  }
  return result;
}

/// The mean over evenly spaced random numbers.
std::array<double, 3> mean_choice(const PhotonMap& map, const Vec3f& p, const Vec3f& normal, int most_points,
                                  int packets) {
  std::array<double, 3> sum{};
  for (int i = 0; i < packets; ++i) {
    const FloatN u = (FloatN(static_cast<float>(i * packet_lanes)) + lane_numbers<FloatN>() + FloatN(0.5F)) *
                     FloatN(1.0F / static_cast<float>(packets * packet_lanes));
    const PhotonMap::Light light = map.choose(everywhere(p), everywhere(normal), MaskN(true), u, most_points);
    for (std::size_t lane = 0; lane < packet_lanes; ++lane) {
      sum[0] += double{light.flux_density.red.get(lane)};
      sum[1] += double{light.flux_density.green.get(lane)};
      sum[2] += double{light.flux_density.blue.get(lane)};
    }
  }
  for (double& channel : sum) channel /= packets * packet_lanes;
  return sum;
}

}  // namespace

TEST_CASE("the light chosen among photons has the expectation of all of them") {
  const std::vector<Photon> photons = photons_on_a_floor(6000);
  std::mt19937 bits(3);
  std::uniform_real_distribution<float> place(-1.1F, 1.1F);
  int with_photons = 0;
  for (const float radius : {0.05F, 0.11F, 0.4F}) {
    const PhotonMap map(photons, radius, 2);
    for (int i = 0; i < 20; ++i) {
      const Vec3f p{place(bits), i % 4 == 0 ? 0.03F : 0.0F, place(bits)};
      const Vec3f normal = i % 3 == 0 ? Vec3f{0, -1, 0} : Vec3f{0.6F, 0.8F, 0};
      const int most_points = i % 2 == 0 ? 4 : 2;
      const Expected wanted = expected(photons, Vec3d(p), Vec3d(normal), double{radius}, most_points);
      const std::array<double, 3> got = mean_choice(map, p, normal, most_points, 4000);
      INFO("radius " << radius << ", point " << i << ", " << wanted.photons << " photons");
      for (std::size_t channel = 0; channel < 3; ++channel)
        CHECK(std::abs(got[channel] - wanted.flux_density[channel]) <= 0.015 * std::abs(wanted.flux_density[channel]));
      with_photons += wanted.photons > 0;
    }
  }
  CHECK(with_photons > 50);
}

TEST_CASE("where more photons lie together than a point looks at, some stand for all") {
  std::vector<Photon> photons = photons_on_a_floor(100000);
  for (Photon& photon : photons) photon.p = photon.p * 0.01F;
  const PhotonMap map(photons, 0.05F, 2);
  const Expected wanted = expected(photons, Vec3d(0, 0, 0), Vec3d(0, 1, 0), 0.05, 9);
  REQUIRE(wanted.photons > 50000);
  const std::array<double, 3> got = mean_choice(map, {0, 0, 0}, {0, 1, 0}, 9, 2000);
  for (std::size_t channel = 0; channel < 3; ++channel)
    CHECK(std::abs(got[channel] / wanted.flux_density[channel] - 1) < 0.015);
}

TEST_CASE("what a lane gets depends neither on its neighbours nor on how many threads made the map") {
  const std::vector<Photon> photons = photons_on_a_floor(60000);
  const PhotonMap map(photons, 0.1F, 1), other(photons, 0.1F, 3);
  std::mt19937 bits(5);
  std::uniform_real_distribution<float> place(-1, 1);
  for (int i = 0; i < 100; ++i) {
    const Vec3f p{place(bits), 0, place(bits)};
    const FloatN u = lane_numbers<FloatN>() * FloatN(1.0F / packet_lanes);
    const PhotonMap::Light all = map.choose(everywhere(p), everywhere({0, 1, 0}), MaskN(true), u, 4);
    for (std::size_t lane = 0; lane < packet_lanes; ++lane) {
      const MaskN alone = float_mask<FloatN>(lane_numbers<IntN>() == IntN(static_cast<std::int32_t>(lane)));
      const PhotonMap::Light one = other.choose(everywhere(p), everywhere({0, 1, 0}), alone, u, 4);
      REQUIRE(one.flux_density.red.get(lane) == all.flux_density.red.get(lane));
      REQUIRE(one.wi.x.get(lane) == all.wi.x.get(lane));
      REQUIRE(one.group.get(lane) == all.group.get(lane));
    }
  }
}

TEST_CASE("where there are no photons, there is no light") {
  const PhotonMap none({}, 0.1F, 1);
  CHECK_FALSE(any(none.choose(everywhere({0, 0, 0}), everywhere({0, 1, 0}), MaskN(true), FloatN(0.5F), 9).lanes));
  CHECK(radius_for({}, 24, 1) == 0);
  const std::vector<Photon> photons = photons_on_a_floor(1000);
  const PhotonMap some(photons, 0.1F, 1);
  for (const Vec3f& p : {Vec3f{0, 1, 0}, Vec3f{5, 0, 0}, Vec3f{1e30F, -1e30F, 0}})
    CHECK_FALSE(any(some.choose(everywhere(p), everywhere({0, 1, 0}), MaskN(true), FloatN(0.5F), 9).lanes));
}

TEST_CASE("the radius is that of a photon in the middle") {
  // Evenly over a square: n photons within r of one take n / (pi r^2) of all 20,000 / 4.
  const std::vector<Photon> photons = photons_on_a_floor(20000);
  const double radius = double{radius_for(photons, 24, 2)};
  CHECK(std::abs(radius / std::sqrt(24 / (std::numbers::pi * 5000)) - 1) < 0.2);
}

}  // namespace raytrace::test
