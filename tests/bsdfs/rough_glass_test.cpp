// Rough glass: what light that is drawn sends through it, against what it draws by itself.
#include <cmath>
#include <numbers>

#include "bsdfs/judge.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

using FrostedBsdf = Kernel<Dielectric>::Bsdf<FloatN>;

FrostedBsdf frosted(double roughness, double ior, bool front, bool thinwalled) {
  Dielectric::Parameters parameters;
  parameters.ior = ior;
  parameters.roughness = roughness;
  parameters.thinwalled = thinwalled;
  parameters.cr = {0.5, 0.5, 0.5};
  FrostedBsdf bsdf = spread_bsdf<Kernel<Dielectric>::Bsdf>(Kernel<Dielectric>::bsdf(parameters));
  bsdf.set_side(MaskN(front), FloatN(1));
  return bsdf;
}

/// How often directions are drawn in which light is sent on, and their mean.
struct Drawn {
  double share = 0;
  Vec3d mean{0, 0, 0};

  void add(double weight, const Vec3<FloatN>& wi, std::size_t lane) {
    share += weight;
    mean = mean + lane_of(wi, lane) * weight;
  }
};

}  // namespace

TEST_CASE("rough glass: f and pdf of a sample are those of its direction, on both sides") {
  Random random(12);
  for (const bool thin : {false, true})
    for (const bool front : {true, false})
      for (const double roughness : {0.2, 0.45, 0.8}) {
        const FrostedBsdf bsdf = frosted(roughness, 1.5, front, thin);
        double worst = 0;
        int through = 0;
        for (int i = 0; i < 2000; ++i) {
          const Vec3<FloatN> wo = spread(at_angle({0, 0, 1}, 80 * random.unit(), 6 * random.unit()));
          const auto number = [&] { return batch_of<FloatN>([&](std::size_t) { return random.unit(); }); };
          const FloatN u = number(), u1 = number(), u2 = number();
          const auto sample = bsdf.sample(wo, u, u1, u2);
          const auto value = bsdf.value(bsdf.lobes(wo), sample.wi);
          for (std::size_t lane = 0; lane < lanes; ++lane) {
            if (sample.f.green.get(lane) == 0 || std::abs(sample.wi.z.get(lane)) < 0.01F) continue;
            through += sample.wi.z.get(lane) < 0;
            worst = std::max(worst, std::abs(double{value.pdf.get(lane)} / double{sample.pdf.get(lane)} - 1));
            worst = std::max(worst, std::abs(double{value.f.green.get(lane)} / double{sample.f.green.get(lane)} - 1));
          }
        }
        INFO("roughness " << roughness << (front ? ", front" : ", back") << (thin ? ", thin" : ""));
        CHECK(worst < 0.02);
        CHECK(through > 1000);
      }
}

TEST_CASE("rough glass: its pdf over all directions is as often as it draws there") {
  constexpr int rows = 400, columns = 800, draws = 400;
  for (const bool thin : {false, true})
    for (const bool front : {true, false})
      for (const double angle : {10.0, 50.0}) {
        const FrostedBsdf bsdf = frosted(0.5, 1.5, front, thin);
        const Vec3<FloatN> wo = spread(at_angle({0, 0, 1}, angle, 1));
        const auto lobes = bsdf.lobes(wo);
        Drawn wanted, got;
        for (int row = 0; row < rows; ++row)
          for (int column = 0; column < columns; column += packet_lanes) {
            const double polar = (row + 0.5) * std::numbers::pi / rows, sine = std::sin(polar);
            const Vec3<FloatN> wi = vectors_of([&](std::size_t lane) {
              const double turn = (column + static_cast<int>(lane) + 0.5) * 2 * std::numbers::pi / columns;
              return Vec3d{sine * std::cos(turn), sine * std::sin(turn), std::cos(polar)};
            });
            const FloatN pdf = bsdf.value(lobes, wi).pdf;
            for (std::size_t lane = 0; lane < lanes && column + static_cast<int>(lane) < columns; ++lane)
              got.add(double{pdf.get(lane)} * sine * 2 * std::numbers::pi * std::numbers::pi / (rows * columns), wi,
                      lane);
          }
        Random random(13);
        for (int i = 0; i < draws; ++i)
          for (int j = 0; j < draws; j += packet_lanes) {
            const auto step = [&](int first) {
              return batch_of<FloatN>(
                  [&](std::size_t lane) { return (first + static_cast<int>(lane) + random.unit()) / draws; });
            };
            const FloatN u1((static_cast<float>(i) + 0.5F) / draws);
            const auto sample = bsdf.sample(wo, batch_of<FloatN>([&](std::size_t) { return random.unit(); }), u1,
                                            min(step(j), FloatN(0.9999999F)));
            for (std::size_t lane = 0; lane < lanes && j + static_cast<int>(lane) < draws; ++lane)
              if (sample.f.green.get(lane) > 0) wanted.add(1.0 / (draws * draws), sample.wi, lane);
          }
        INFO((front ? "front" : "back") << (thin ? ", thin" : "") << ", wo at " << angle << " degrees");
        CHECK(got.share == Approx(wanted.share).epsilon(0.005));
        CHECK(length(got.mean - wanted.mean) < 0.005);
      }
}

}  // namespace raytrace::test
