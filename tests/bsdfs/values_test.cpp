// f and rho against their formulas.
#include <algorithm>

#include "bsdfs/directions.h"
#include "raytrace/bsdfs/glossy_specular.h"
#include "raytrace/bsdfs/lambertian.h"
#include "support/catch.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

const Rgb<float> reflectance(0.25f, 0.5f, 0.75f);

GlossySpecular<FloatN> glossy(double exponent) {
  return {Rgb<FloatN>(reflectance), FloatN(static_cast<float>(exponent))};
}

/// Unit vectors in floats: what the BRDFs are given, so that the formula gets the very same.
struct Directions {
  Vec3<FloatN> wo, wi, normal;
};

Directions random_directions(Random& random) {
  const auto above = [&](const Vec3d& normal) {
    const Vec3d w = random.direction();
    return dot(w, normal) < 0 ? -w : w;
  };
  std::array<Vec3d, lanes> normal, wo, wi;
  for (std::size_t i = 0; i < lanes; ++i) {
    normal[i] = random.direction();
    wo[i] = above(normal[i]);
    // Every other one in the highlight.
    wi[i] = i % 2 == 0 ? above(normal[i])
                       : normalize(mirror_of(wo[i], normal[i]) + random.direction() * (0.3 * random.unit()));
  }
  const auto wide = [](const auto& vectors) { return vectors_of([&](std::size_t i) { return vectors[i]; }); };
  return {wide(wo), wide(wi), wide(normal)};
}

/// The integral of f cos over the hemisphere, red channel, by a fine grid about the mirror direction.
double reflected_share(double exponent, double angle) {
  const Vec3d normal{0, 0, 1}, wo = at_angle(normal, angle, 0.7);
  const Frame frame(mirror_of(wo, normal));
  const Vec3<FloatN> wide_wo = spread(wo), wide_normal = spread(normal);
  constexpr int rings = 400;
  constexpr std::size_t sectors = 256;
  double sum = 0;
  for (int ring = 0; ring < rings; ++ring) {
    // Rings of equal shares of the lobe: by equal steps of cosine^(exponent + 1).
    const double cosine = std::pow((ring + 0.5) / rings, 1 / (exponent + 1));
    const double solid_angle =
        2 * std::numbers::pi / ((exponent + 1) * std::pow(cosine, exponent)) / (double{rings} * double{sectors});
    for (std::size_t first = 0; first < sectors; first += lanes) {
      const auto wi = [&](std::size_t lane) {
        return frame.direction(cosine, 2 * std::numbers::pi * (static_cast<double>(first + lane) + 0.5) / sectors);
      };
      const Vec3<FloatN> wide_wi = vectors_of(wi);
      const FloatN value = glossy(exponent).f(wide_wo, wide_wi, wide_normal).red * max(wide_wi.z, FloatN(0));
      for (std::size_t lane = 0; lane < lanes; ++lane) sum += static_cast<double>(value.get(lane)) * solid_angle;
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("Lambertian: f is reflectance / pi, and what it reflects is its rho") {
  const Lambertian<FloatN> brdf{Rgb<FloatN>(reflectance)};
  CHECK(static_cast<double>(brdf.f().red.get(0)) == Approx(0.25 / std::numbers::pi).epsilon(1e-6));
  CHECK(static_cast<double>(brdf.f().green.get(0)) == Approx(0.5 / std::numbers::pi).epsilon(1e-6));
  CHECK(static_cast<double>(brdf.f().blue.get(0)) == Approx(0.75 / std::numbers::pi).epsilon(1e-6));
  // The integral of the cosine over the hemisphere is pi.
  CHECK(static_cast<double>(brdf.rho().blue.get(0)) ==
        Approx(static_cast<double>(brdf.f().blue.get(0)) * std::numbers::pi).epsilon(1e-6));
}

TEST_CASE("GlossySpecular: f is reflectance * max(0, r.wo)^exponent") {
  Random random(1);
  for (const double exponent : {0.0, 0.5, 1.0, 2.0, 5.0, 20.0, 100.0, 1000.0}) {
    // The directions themselves are floats: the cosine of two is good to 2^-22, and the exponent multiplies that.
    const double tolerance = 1e-5 + exponent * 0x1p-22;
    double worst = 0;
    int lit = 0;
    for (int i = 0; i < 20000; i += packet_lanes) {
      const Directions d = random_directions(random);
      const Rgb<FloatN> f = glossy(exponent).f(d.wo, d.wi, d.normal);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const double cosine = dot(mirror_of(lane_of(d.wi, lane), lane_of(d.normal, lane)), lane_of(d.wo, lane));
        if (std::abs(cosine) < 1e-6) continue;  // exponent 0 steps there from 0 to 1
        const double lobe = cosine > 0 ? std::pow(std::min(cosine, 1.0), exponent) : 0;
        lit += lobe > 0.01;
        worst = std::max({worst, std::abs(static_cast<double>(f.red.get(lane)) - 0.25 * lobe),
                          std::abs(static_cast<double>(f.green.get(lane)) - 0.5 * lobe),
                          std::abs(static_cast<double>(f.blue.get(lane)) - 0.75 * lobe)});
      }
    }
    INFO("exponent " << exponent);
    CHECK(worst < tolerance);
    CHECK(lit > 1000);
  }
}

TEST_CASE("GlossySpecular: f is reciprocal") {
  Random random(2);
  for (const double exponent : {1.0, 20.0, 1000.0}) {
    double worst = 0;
    for (int i = 0; i < 20000; i += packet_lanes) {
      const Directions d = random_directions(random);
      const FloatN forth = glossy(exponent).f(d.wo, d.wi, d.normal).blue,
                   back = glossy(exponent).f(d.wi, d.wo, d.normal).blue;
      for (std::size_t lane = 0; lane < lanes; ++lane)
        worst = std::max(worst, std::abs(static_cast<double>(forth.get(lane) - back.get(lane))));
    }
    INFO("exponent " << exponent);
    CHECK(worst < 1e-5 + exponent * 0x1p-22);
  }
}

TEST_CASE("GlossySpecular: rho is what is reflected from straight above, and no direction reflects more") {
  for (const double exponent : {0.0, 1.0, 5.0, 20.0, 100.0, 1000.0}) {
    const double rho = static_cast<double>(glossy(exponent).rho().red.get(0));
    INFO("exponent " << exponent);
    CHECK(reflected_share(exponent, 0) == Approx(rho).epsilon(1e-3));
    for (const double angle : {20.0, 45.0, 70.0, 85.0, 89.9}) CHECK(reflected_share(exponent, angle) < rho * 1.001);
    // More than arrives is reflected only by lobes broader than Phong's of 2 pi - 2.
    if (exponent >= 2 * std::numbers::pi - 2) CHECK(rho <= 0.25 * 1.001);
  }
}

TEST_CASE("GlossySpecular: lanes with other surfaces do not mix, and no exponent makes f more than its reflectance") {
  const FloatN exponents = batch_of<FloatN>([](std::size_t i) { return std::array{0.0, 1e30, 7.0, 1e5}[i % 4]; });
  const FloatN red = batch_of<FloatN>([](std::size_t i) { return 0.1 + 0.05 * static_cast<double>(i); });
  const GlossySpecular<FloatN> brdf{{red, red, red}, exponents};
  const Vec3<FloatN> normal = spread({0, 0, 1});
  for (const double angle : {0.0, 1e-4, 10.0, 60.0, 89.99}) {
    const Vec3d w = at_angle({0, 0, 1}, angle, 0);
    const FloatN f = brdf.f(spread(w), normal, normal).red;  // light from straight above: r is the normal
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const double exponent = static_cast<double>(exponents.get(lane)),
                   cosine = static_cast<double>(static_cast<float>(w.z));
      INFO("angle " << angle << ", exponent " << exponent);
      CHECK(static_cast<double>(f.get(lane)) ==
            Approx(static_cast<double>(red.get(lane)) * std::pow(cosine, exponent)).epsilon(1e-3).margin(1e-7));
      CHECK(f.get(lane) <= red.get(lane));
    }
  }
}

TEST_CASE(
    "GlossySpecular: light estimated from samples is what is reflected; those below the surface count as nothing") {
  for (const double exponent : {1.0, 20.0, 300.0})
    for (const double angle : {0.0, 50.0, 85.0}) {
      const Vec3d normal{0, 0, 1}, wo = at_angle(normal, angle, 0.7);
      const Vec3<FloatN> wide_wo = spread(wo), wide_normal = spread(normal);
      const GlossySpecular<FloatN> brdf = glossy(exponent);
      constexpr int count = 512;  // an edge of the grid of samples
      double sum = 0;
      for (int i = 0; i < count; ++i)
        for (int j = 0; j < count; j += packet_lanes) {
          const FloatN u1((static_cast<float>(i) + 0.5f) / count);
          const FloatN u2 =
              batch_of<FloatN>([&](std::size_t lane) { return (j + static_cast<int>(lane) + 0.5) / count; });
          const Vec3<FloatN> wi = brdf.sample(wide_wo, wide_normal, u1, u2);
          const FloatN value =
              brdf.f(wide_wo, wi, wide_normal).red * max(wi.z, FloatN(0)) / brdf.pdf(wide_wo, wi, wide_normal);
          for (std::size_t lane = 0; lane < lanes; ++lane) sum += static_cast<double>(value.get(lane));
        }
      INFO("exponent " << exponent << ", wo at " << angle << " degrees");
      CHECK(sum / (double{count} * count) == Approx(reflected_share(exponent, angle)).epsilon(2e-3));
    }
}

}  // namespace raytrace::test
