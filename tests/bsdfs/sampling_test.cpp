// sample() against pdf(): a chi-square test over the sphere of directions.
#include "bsdfs/judge.h"
#include "raytrace/bsdfs/glossy_specular.h"
#include "raytrace/bsdfs/lambertian.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

const std::vector<Vec3d> normals{{0, 0, 1}, {0, 0, -1}, {0.48, -0.6, 0.64}, {-0.8, 0.6, -1e-8}};
const std::vector<double> angles{0, 30, 60, 85, 89.9};  // of wo from the normal

}  // namespace

TEST_CASE("Lambertian samples follow their pdf, which integrates to 1") {
  const Lambertian<FloatN> brdf{Rgb<FloatN>(Rgb<float>(0.5f, 0.6f, 0.7f))};
  for (const Vec3d& normal : normals) {
    const Vec3d wo = at_angle(normal, 40, 1);
    const Outcome outcome = judge(brdf, wo, normal, Cells(normal, 2));
    INFO("normal " << normal.x << " " << normal.y << " " << normal.z);
    CHECK(outcome.integral == Approx(1).epsilon(1e-3));
    CHECK(outcome.deviation < 4);
    CHECK(outcome.worst_length < 1e-6);
    CHECK(outcome.lowest > 0);  // never below the surface
    CHECK(outcome.impossible == 0);
  }
}

TEST_CASE("GlossySpecular samples follow their pdf, which integrates to 1, from any side and for any exponent") {
  for (const double exponent : {0.0, 1.0, 5.0, 20.0, 100.0, 1000.0}) {
    const GlossySpecular<FloatN> brdf{Rgb<FloatN>(Rgb<float>(1, 1, 1)), FloatN(static_cast<float>(exponent))};
    for (const Vec3d& normal : normals)
      for (const double angle : angles) {
        const Vec3d wo = at_angle(normal, angle, 2.5);
        const Outcome outcome = judge(brdf, wo, normal, Cells(mirror_of(wo, normal), exponent + 1));
        INFO("exponent " << exponent << ", wo at " << angle << " degrees, normal " << normal.x << " " << normal.y << " "
                         << normal.z);
        CHECK(outcome.integral == Approx(1).epsilon(1e-3));
        CHECK(outcome.deviation < 4);
        CHECK(outcome.worst_length < 1e-6);
        CHECK(outcome.impossible <= 1);  // by rounding at the lobe's rim
      }
  }
}

namespace {

/// The mean of f cos / pdf of a Bsdf's samples: the share of light that it reflects.
template <class Bsdf>
double reflected_share(const Bsdf& bsdf, const Vec3d& wo) {
  Random random(4242);
  double sum = 0;
  for (int i = 0; i < samples; i += packet_lanes) {
    const auto numbers = [&] { return batch_of<FloatN>([&](std::size_t) { return random.unit(); }); };
    const FloatN u = numbers(), u1 = numbers(), u2 = numbers();
    const BsdfSample<FloatN> drawn = bsdf.sample(spread(wo), u, u1, u2);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const double cosine = std::max(0.0, double{drawn.wi.z.get(lane)});
      sum += double{drawn.f.red.get(lane)} * cosine / double{drawn.pdf.get(lane)};
    }
  }
  return sum / samples;
}

}  // namespace

TEST_CASE("a matte's samples follow its pdf, and carry its albedo") {
  const auto bsdf = spread_bsdf<Kernel<Matte>::Bsdf>(Kernel<Matte>::bsdf({0.3, 0.8, {0.5, 0.6, 0.7}}));
  for (const double angle : angles) {
    const Vec3d normal{0, 0, 1}, wo = at_angle(normal, angle, 2);
    const Outcome outcome = judge(JudgedBsdf<Kernel<Matte>::Bsdf<FloatN>>{bsdf}, wo, normal, Cells(normal, 2));
    INFO("wo at " << angle << " degrees");
    CHECK(outcome.integral == Approx(1).epsilon(1e-3));
    CHECK(outcome.deviation < 4);
    CHECK(outcome.lowest > 0);
    CHECK(reflected_share(bsdf, wo) == Approx(0.4).epsilon(1e-5));
  }
}

TEST_CASE("a phong's samples follow its pdf over both lobes, and carry what it reflects") {
  for (const double exponent : {3.0, 40.0}) {
    const auto bsdf =
        spread_bsdf<Kernel<Phong>::Bsdf>(Kernel<Phong>::bsdf({0.3, 0.5, 0.1, {0.5, 0.6, 0.7}, {1, 1, 1}, exponent}));
    // From straight above, no part of the lobe lies below the surface.
    const Vec3d normal{0, 0, 1};
    const Outcome outcome = judge(JudgedBsdf<Kernel<Phong>::Bsdf<FloatN>>{bsdf}, normal, normal, Cells(normal, 2));
    INFO("exponent " << exponent);
    CHECK(outcome.integral == Approx(1).epsilon(2e-3));
    CHECK(outcome.deviation < 4);
    CHECK(outcome.impossible == 0);
    CHECK(reflected_share(bsdf, normal) == Approx(0.25 + 0.1 * 2 * std::numbers::pi / (exponent + 2)).epsilon(0.01));
  }
}

TEST_CASE("a phong that reflects nothing still draws directions with a density") {
  const auto bsdf = spread_bsdf<Kernel<Phong>::Bsdf>(Kernel<Phong>::bsdf({0, 0, 0, {0, 0, 0}, {0, 0, 0}, 20}));
  CHECK(reflected_share(bsdf, {0, 0.6, 0.8}) == 0);
}

TEST_CASE("a lobe narrower than float can cancel still has the spread of its exponent") {
  // cosine^(exponent + 1) is uniform whatever the exponent, and exp(-(exponent + 1) angle^2 / 2) for these small
  // angles.
  const Vec3d normal{0, 0, 1};
  const Vec3<FloatN> straight = spread(normal);
  for (const double exponent : {1e4, 1e6, 1e8}) {
    const GlossySpecular<FloatN> brdf{Rgb<FloatN>(Rgb<float>(1, 1, 1)), FloatN(static_cast<float>(exponent))};
    Random random(99);
    double sum = 0;
    for (int i = 0; i < samples; i += packet_lanes) {
      const FloatN u1 = batch_of<FloatN>([&](std::size_t) { return random.unit(); });
      const Vec3<FloatN> wi = brdf.sample(straight, straight, u1, FloatN(0.3f));
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const Vec3d direction = lane_of(wi, lane);
        sum += 1 - std::exp(-(direction.x * direction.x + direction.y * direction.y) / 2 * (exponent + 1));
      }
    }
    CHECK(sum / samples == Approx(0.5).epsilon(0.01));
  }
}

}  // namespace raytrace::test
