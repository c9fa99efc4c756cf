// sample() against pdf(): a chi-square test over the sphere of directions.
#include <algorithm>
#include <vector>

#include "bsdfs/directions.h"
#include "raytrace/bsdfs/glossy_specular.h"
#include "raytrace/bsdfs/lambertian.h"
#include "raytrace/materials/kernels.h"
#include "raytrace/math/gather.h"
#include "support/catch.h"
#include "support/chi_square.h"
#include "support/lanes.h"

namespace raytrace::test {

namespace {

constexpr int samples = 60000;
constexpr std::size_t rings = 16, sectors = 12;

const std::vector<Vec3d> normals{{0, 0, 1}, {0, 0, -1}, {0.48, -0.6, 0.64}, {-0.8, 0.6, -1e-8}};
const std::vector<double> angles{0, 30, 60, 85, 89.9};  // of wo from the normal

/// The sphere in rings about an axis, bounded by equal steps of cosine^power, each cut into sectors; what lies more
/// than a right angle from the axis is one cell, the last. The lobe cosine^(power - 1) has as much in each ring.
class Cells {
 public:
  Cells(const Vec3d& axis, double power) : frame_(axis), power_(power) {}

  static constexpr std::size_t count = rings * sectors + 1;

  std::size_t cell_of(const Vec3d& direction) const {
    const double cosine = dot(direction, frame_.w);
    if (cosine <= 0) return count - 1;
    const auto ring = static_cast<std::size_t>(std::pow(std::min(cosine, 1.0), power_) * rings);
    const auto sector = static_cast<std::size_t>(frame_.azimuth_of(direction) / (2 * std::numbers::pi) * sectors);
    return std::min(ring, rings - 1) * sectors + std::min(sector, sectors - 1);
  }

  /// The integral of a density over each cell but the last, by the midpoint rule in the variables cosine^power and
  /// azimuth.
  template <class Density>
  std::vector<double> integrals(Density density) const {
    constexpr std::size_t steps = 12;
    std::vector<double> result(count);
    for (std::size_t ring = 0; ring < rings; ++ring)
      for (std::size_t sector = 0; sector < sectors; ++sector)
        for (std::size_t i = 0; i < steps; ++i) {
          const double cosine =
              std::pow((static_cast<double>(ring) + (static_cast<double>(i) + 0.5) / steps) / rings, 1 / power_);
          const double solid_angle =
              2 * std::numbers::pi / (power_ * std::pow(cosine, power_ - 1)) / double{rings * steps * sectors * steps};
          for (std::size_t first = 0; first < steps; first += lanes) {
            const FloatN values = density(vectors_of([&](std::size_t lane) {
              const double azimuth =
                  (static_cast<double>(sector) + (static_cast<double>(first + lane) + 0.5) / steps) / sectors;
              return frame_.direction(cosine, azimuth * 2 * std::numbers::pi);
            }));
            for (std::size_t lane = 0; lane < lanes && first + lane < steps; ++lane)
              result[ring * sectors + sector] += static_cast<double>(values.get(lane)) * solid_angle;
          }
        }
    return result;
  }

 private:
  Frame frame_;
  double power_;
};

struct Outcome {
  double integral;      ///< of the pdf over the sphere
  double deviation;     ///< of the samples from the pdf, in standard deviations
  double worst_length;  ///< largest | |wi| - 1 |
  double lowest;        ///< smallest dot(normal, wi)
  int impossible = 0;   ///< samples whose pdf is 0
};

template <class Brdf>
Outcome judge(const Brdf& brdf, const Vec3d& wo, const Vec3d& normal, const Cells& cells) {
  const Vec3<FloatN> wide_wo = spread(wo), wide_normal = spread(normal);
  const auto pdf = [&](const Vec3<FloatN>& wi) { return brdf.pdf(wide_wo, wi, wide_normal); };
  std::vector<double> expected = cells.integrals(pdf);
  Outcome outcome{0, 0, 0, 1};
  for (double& value : expected) {
    outcome.integral += value;
    value *= samples;
  }
  std::vector<double> observed(Cells::count);
  Random random(12345);
  for (int i = 0; i < samples; i += packet_lanes) {
    const FloatN u1 = batch_of<FloatN>([&](std::size_t) { return random.unit(); });
    const FloatN u2 = batch_of<FloatN>([&](std::size_t) { return random.unit(); });
    const Vec3<FloatN> wi = brdf.sample(wide_wo, wide_normal, u1, u2);
    const FloatN density = pdf(wi);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const Vec3d direction = lane_of(wi, lane);
      ++observed[cells.cell_of(direction)];
      outcome.worst_length = std::max(outcome.worst_length, std::abs(length(direction) - 1));
      outcome.lowest = std::min(outcome.lowest, dot(direction, normal));
      outcome.impossible += !(density.get(lane) > 0);
    }
  }
  outcome.deviation = chi_square_deviation(observed, expected);
  return outcome;
}

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

/// A material's Bsdf, for judge(): which lobe a sample is of comes from random numbers of its own.
template <class Bsdf>
struct JudgedBsdf {
  Bsdf bsdf;
  mutable Random lobes{777};

  Vec3<FloatN> sample(const Vec3<FloatN>& wo, const Vec3<FloatN>&, const FloatN& u1, const FloatN& u2) const {
    return bsdf.sample(wo, batch_of<FloatN>([&](std::size_t) { return lobes.unit(); }), u1, u2).wi;
  }
  FloatN pdf(const Vec3<FloatN>& wo, const Vec3<FloatN>& wi, const Vec3<FloatN>&) const { return bsdf.pdf(wo, wi); }
};

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

/// The same of every lane.
template <template <class> class Bsdf>
Bsdf<FloatN> spread_bsdf(const Bsdf<float>& bsdf) {
  return gather_records<Bsdf, FloatN>(&bsdf, LaneIndices(0));
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
