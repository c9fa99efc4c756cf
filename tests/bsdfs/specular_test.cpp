// Mirrors, metals and glass against formulas: what they send on, and where to.
#include <cmath>
#include <cstring>
#include <numbers>

#include "bsdfs/judge.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

using GlassBsdf = Kernel<Dielectric>::Bsdf<FloatN>;
using MetalBsdf = Kernel<Conductor>::Bsdf<FloatN>;

GlassBsdf glass(double ior, double roughness, bool front, bool thinwalled = false) {
  Dielectric::Parameters parameters;
  parameters.ior = ior;
  parameters.roughness = roughness;
  parameters.thinwalled = thinwalled;
  GlassBsdf bsdf = spread_bsdf<Kernel<Dielectric>::Bsdf>(Kernel<Dielectric>::bsdf(parameters));
  bsdf.set_side(MaskN(front), FloatN(1));
  return bsdf;
}

MetalBsdf metal(double roughness, const Rgb<double>& cr = {1, 1, 1}, const Rgb<double>& edgecolor = {0, 0, 0}) {
  Conductor::Parameters parameters;
  parameters.cr = cr;
  parameters.edgecolor = edgecolor;
  parameters.roughness = roughness;
  return spread_bsdf<Kernel<Conductor>::Bsdf>(Kernel<Conductor>::bsdf(parameters));
}

Vec3d at_cosine(double cosine) { return {std::sqrt(1 - cosine * cosine), 0, cosine}; }

/// What a sample in the first lane sends on.
Rgb<double> weight(const BsdfSample<FloatN>& sample) {
  const double factor = std::abs(double{sample.wi.z.get(0)}) / double{sample.pdf.get(0)};
  return {sample.f.red.get(0) * factor, sample.f.green.get(0) * factor, sample.f.blue.get(0) * factor};
}

/// The mean of f |cos| / pdf eta^2 over a grid of samples: the share of light that is sent on.
template <class Bsdf>
double sent_share(const Bsdf& bsdf, const Vec3d& wo) {
  constexpr int count = 256;
  Random random(31);
  double sum = 0;
  for (int i = 0; i < count; ++i)
    for (int j = 0; j < count; j += packet_lanes) {
      const FloatN u = batch_of<FloatN>([&](std::size_t) { return random.unit(); });
      const FloatN u1((static_cast<float>(i) + 0.5F) / count);
      const FloatN u2 = batch_of<FloatN>([&](std::size_t lane) { return (j + static_cast<int>(lane) + 0.5) / count; });
      const BsdfSample<FloatN> sample = bsdf.sample(spread(wo), u, u1, u2);
      for (std::size_t lane = 0; lane < lanes; ++lane)
        if (sample.pdf.get(lane) > 0)
          sum += double{sample.f.red.get(lane)} * std::abs(double{sample.wi.z.get(lane)}) /
                 double{sample.pdf.get(lane)} * double{sample.eta2.get(lane)};
    }
  return sum / (double{count} * count);
}

double fresnel_share(double cosine, double eta) {
  return double{
      fresnel_reflection(FloatN(static_cast<float>(cosine)), FloatN(static_cast<float>(eta))).reflectance.get(0)};
}

}  // namespace

TEST_CASE("Fresnel: straight on, at Brewster's angle, beyond the critical angle, and from the other side") {
  for (const double n : {1.1, 1.33, 1.5, 2.4}) {
    INFO(n);
    CHECK(fresnel_share(1, n) == Approx(std::pow((n - 1) / (n + 1), 2)).epsilon(1e-5));
    CHECK(fresnel_share(1, 1 / n) == Approx(std::pow((n - 1) / (n + 1), 2)).epsilon(1e-5));
    // There the half that is polarised along the plane of incidence comes through wholly.
    const double brewster = 1 / std::sqrt(1 + n * n);
    CHECK(fresnel_share(brewster, n) == Approx(std::pow((n * n - 1) / (n * n + 1), 2) / 2).epsilon(1e-4));
    const double critical = std::sqrt(1 - 1 / (n * n));
    CHECK(fresnel_share(critical * 0.999, 1 / n) == 1);
    CHECK(fresnel_share(critical + 0.02, 1 / n) < 1);
    CHECK(fresnel_share(0, n) == 1);
    for (const double c : {0.1, 0.5, 0.9}) {
      const double on_the_other_side = std::sqrt(1 - (1 - c * c) / (n * n));
      CHECK(fresnel_share(on_the_other_side, 1 / n) == Approx(fresnel_share(c, n)).epsilon(1e-4));
    }
  }
}

TEST_CASE("a pane reflects what goes to and fro in it") {
  for (const double r : {0.0, 0.04, 0.5, 0.9}) {
    double sum = r, inside = (1 - r) * (1 - r) * r;
    for (int i = 0; i < 1000; ++i, inside *= r * r) sum += inside;
    CHECK(double{pane_reflectance(FloatN(static_cast<float>(r))).get(0)} == Approx(sum).epsilon(1e-5));
  }
}

TEST_CASE("a mirror sends all of its color on, to the mirrored side") {
  const auto bsdf = spread_bsdf<Kernel<Mirror>::Bsdf>(Kernel<Mirror>::bsdf({{0.25, 0.5, 0.75}}));
  for (const double angle : {0.0, 30.0, 80.0, 89.9}) {
    const Vec3d wo = at_angle({0, 0, 1}, angle, 2);
    const auto sample = bsdf.sample(spread(wo), FloatN(0.5F), FloatN(0.5F), FloatN(0.5F));
    CHECK(all(sample.specular));
    CHECK(length(lane_of(sample.wi, 0) - mirror_of(wo, {0, 0, 1})) < 1e-6);
    CHECK(weight(sample).red == Approx(0.25).epsilon(1e-5));
    CHECK(weight(sample).blue == Approx(0.75).epsilon(1e-5));
  }
}

TEST_CASE("smooth glass chooses by Fresnel, bends as Snell says, and scales radiance by eta^2") {
  for (const double n : {1.33, 1.5, 2.4})
    for (const bool front : {true, false})
      for (const double cosine : {0.05, 0.3, 0.7, 0.95, 1.0}) {
        const double eta = front ? n : 1 / n, r = fresnel_share(cosine, eta);
        const Vec3d wo = at_cosine(cosine);
        const auto sampled = [&](double u) {
          return glass(n, 0, front).sample(spread(wo), FloatN(static_cast<float>(u)), FloatN(0.3F), FloatN(0.7F));
        };
        INFO(n << (front ? " front " : " back ") << cosine);
        const auto reflected = sampled(0);
        CHECK(length(lane_of(reflected.wi, 0) - mirror_of(wo, {0, 0, 1})) < 1e-6);
        CHECK(double{reflected.pdf.get(0)} == Approx(r).epsilon(1e-5));
        CHECK(weight(reflected).green == Approx(1).epsilon(1e-5));
        CHECK(reflected.eta2.get(0) == 1);
        const auto last = sampled(1 - 0x1p-24);
        CHECK(all(last.specular));
        if (r == 1) {
          CHECK(last.wi.z.get(0) > 0);
          continue;
        }
        CHECK(double{last.wi.x.get(0)} == Approx(-wo.x / eta).margin(1e-6));
        CHECK(double{last.wi.z.get(0)} == Approx(-std::sqrt(1 - (1 - cosine * cosine) / (eta * eta))).epsilon(1e-5));
        CHECK(double{last.eta2.get(0)} == Approx(eta * eta).epsilon(1e-5));
        CHECK(weight(last).green == Approx(1 / (eta * eta)).epsilon(1e-5));
      }
}

TEST_CASE("what comes through a thin wall goes straight on") {
  const Vec3d wo = at_cosine(0.4);
  const auto sample = glass(1.5, 0, false, true).sample(spread(wo), FloatN(0.99F), FloatN(0.3F), FloatN(0.7F));
  const double r = fresnel_share(0.4, 1.5);
  CHECK(length(lane_of(sample.wi, 0) + wo) < 1e-6);
  CHECK(double{sample.pdf.get(0)} == Approx(1 - 2 * r / (1 + r)).epsilon(1e-5));
  CHECK(weight(sample).red == Approx(1).epsilon(1e-5));
  CHECK(sample.eta2.get(0) == 1);
}

TEST_CASE("attenuation: its color after its distance, and powers of it after others") {
  Dielectric::Parameters parameters;
  parameters.attenuationcolor = {0.25, 0.5, 1};
  parameters.attenuationdistance = 2;
  const auto bsdf = spread_bsdf<Kernel<Dielectric>::Bsdf>(Kernel<Dielectric>::bsdf(parameters));
  for (const double distance : {0.0, 1.0, 2.0, 6.0}) {
    const Rgb<FloatN> left = bsdf.transmittance(FloatN(static_cast<float>(distance)));
    CHECK(double{left.red.get(0)} == Approx(std::pow(0.25, distance / 2)).epsilon(1e-5));
    CHECK(double{left.green.get(0)} == Approx(std::pow(0.5, distance / 2)).epsilon(1e-5));
    CHECK(left.blue.get(0) == 1);
  }
}

TEST_CASE("a smooth metal: its color straight on, its edge color times Schlick's at a cosine of 1/7") {
  const auto share = [](const MetalBsdf& bsdf, double cosine) {
    return weight(bsdf.sample(spread(at_cosine(cosine)), FloatN(0.5F), FloatN(0.3F), FloatN(0.7F)));
  };
  const MetalBsdf plain = metal(0, {0.2, 0.5, 0.9}), edged = metal(0, {0.2, 0.5, 0.9}, {0.5, 0.8, 1});
  for (const double cosine : {1.0, 0.5, 1.0 / 7}) CHECK(share(plain, cosine).green == Approx(0.5).epsilon(1e-5));
  CHECK(share(edged, 1).red == Approx(0.2).epsilon(1e-5));
  const auto schlick = [](double normal, double cosine) { return normal + (1 - normal) * std::pow(1 - cosine, 5); };
  CHECK(share(edged, 1.0 / 7).red == Approx(0.5 * schlick(0.2, 1.0 / 7)).epsilon(1e-5));
  CHECK(share(edged, 1.0 / 7).green == Approx(0.8 * schlick(0.5, 1.0 / 7)).epsilon(1e-5));
  CHECK(share(edged, 0.5).blue == Approx(schlick(0.9, 0.5)).epsilon(1e-5));
  CHECK(share(edged, 0.001).red == Approx(1).epsilon(0.01));
  Conductor::Parameters gold;
  gold.metal = Metal::gold;
  const auto bsdf = spread_bsdf<Kernel<Conductor>::Bsdf>(Kernel<Conductor>::bsdf(gold));
  CHECK(share(bsdf, 1).green == Approx(0.730).epsilon(1e-5));
}

TEST_CASE("a rough metal's samples follow its pdf, from any side") {
  for (const double roughness : {0.35, 0.5, 0.7, 1.0})
    for (const double angle : {0.0, 30.0, 60.0, 85.0}) {
      if (roughness < 0.5 && angle > 80) continue;  // narrower there than the cells' steps
      const Vec3d normal{0, 0, 1}, wo = at_angle(normal, angle, 2);
      const Outcome outcome = judge(JudgedBsdf<MetalBsdf>{metal(roughness)}, wo, normal, Cells(normal, 1), true);
      INFO("roughness " << roughness << ", wo at " << angle << " degrees, " << outcome.integral);
      CHECK(outcome.deviation < 4);
      CHECK(outcome.worst_length < 1e-5);
    }
}

TEST_CASE("a lobe too narrow for cells has the spread of its roughness, and GGX's density") {
  // From straight above, tan^2 / (alpha^2 + tan^2) of the facets' angles is even in [0, 1), and the pdf is D / 4.
  const Vec3<FloatN> wo = local_normal<FloatN>();
  for (const double roughness : {0.05, 0.1, 0.2}) {
    const double alpha2 = std::pow(roughness, 4);
    const MetalBsdf bsdf = metal(roughness);
    std::vector<double> counts(20);
    double worst = 0;
    Random random(17);
    for (int i = 0; i < samples; i += packet_lanes) {
      const auto numbers = [&] { return batch_of<FloatN>([&](std::size_t) { return random.unit(); }); };
      const FloatN u1 = numbers(), u2 = numbers();
      const BsdfSample<FloatN> sample = bsdf.sample(wo, FloatN(0.5F), u1, u2);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const Vec3d wi = lane_of(sample.wi, lane), facet = normalize(wi + Vec3d{0, 0, 1});
        const double tan2 = (facet.x * facet.x + facet.y * facet.y) / (facet.z * facet.z);
        ++counts[std::min(static_cast<std::size_t>(tan2 / (alpha2 + tan2) * 20), counts.size() - 1)];
        const double density = alpha2 / (std::numbers::pi * std::pow(facet.z, 4) * std::pow(alpha2 + tan2, 2));
        if (wi.z > 0.01) worst = std::max(worst, std::abs(double{sample.pdf.get(lane)} / (density / 4) - 1));
      }
    }
    INFO("roughness " << roughness);
    CHECK(chi_square_deviation(counts) < 4);
    CHECK(worst < 2e-3);
  }
}

namespace {

/// What a dielectric reflects; other samples go straight down.
struct ReflectedPart {
  JudgedBsdf<GlassBsdf> judged;

  Vec3<FloatN> sample(const Vec3<FloatN>& wo, const Vec3<FloatN>& normal, const FloatN& u1, const FloatN& u2) const {
    const BsdfSample<FloatN> drawn =
        judged.bsdf.sample(wo, batch_of<FloatN>([&](std::size_t) { return judged.lobes.unit(); }), u1, u2);
    return select(drawn.f.red > FloatN(0), drawn.wi, -normal);
  }
  FloatN pdf(const Vec3<FloatN>& wo, const Vec3<FloatN>& wi, const Vec3<FloatN>& normal) const {
    return judged.pdf(wo, wi, normal);
  }
};

}  // namespace

TEST_CASE("what rough glass reflects follows its pdf, from both sides") {
  for (const bool front : {true, false})
    for (const double roughness : {0.4, 0.7, 1.0})
      for (const double angle : {0.0, 40.0, 75.0}) {
        const Vec3d normal{0, 0, 1}, wo = at_angle(normal, angle, 2);
        const ReflectedPart part{{glass(1.5, roughness, front)}};
        const Outcome outcome = judge(part, wo, normal, Cells(normal, 1), true);
        INFO((front ? "front" : "back") << ", roughness " << roughness << ", wo at " << angle << " degrees");
        CHECK(outcome.deviation < 4);
        CHECK(outcome.worst_length < 1e-5);
      }
}

TEST_CASE("f of a sample is that of evaluate()") {
  Random random(8);
  for (const double roughness : {0.1, 0.4, 1.0}) {
    const GlassBsdf bsdf = glass(1.5, roughness, true);
    const MetalBsdf rough = metal(roughness, {0.9, 0.6, 0.3});
    double worst = 0;
    for (int i = 0; i < 200; ++i) {
      const Vec3<FloatN> wo = spread(at_angle({0, 0, 1}, 80 * random.unit(), 6 * random.unit()));
      const FloatN u1(static_cast<float>(random.unit())), u2(static_cast<float>(random.unit()));
      const auto compare = [&](const auto& of, float u) {
        const auto sample = of.sample(wo, FloatN(u), u1, u2);
        if (!(sample.wi.z.get(0) > 0) || !(sample.f.green.get(0) > 0)) return;
        const double f = of.evaluate(wo, sample.wi, local_normal<FloatN>()).green.get(0),
                     pdf = of.pdf(wo, sample.wi).get(0);
        worst = std::max(
            {worst, std::abs(f / double{sample.f.green.get(0)} - 1), std::abs(pdf / double{sample.pdf.get(0)} - 1)});
      };
      compare(bsdf, 0);
      compare(rough, 0);
    }
    INFO("roughness " << roughness);
    CHECK(worst < 2e-3);
  }
}

TEST_CASE("what single facets reflect is reciprocal") {
  Random random(5);
  for (const double alpha : {0.01, 0.1, 0.5, 1.0}) {
    const Ggx<FloatN> ggx{FloatN(static_cast<float>(alpha))};
    double worst = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3<FloatN> a = spread(at_angle({0, 0, 1}, 88 * random.unit(), 6 * random.unit())),
                         b = spread(at_angle({0, 0, 1}, 88 * random.unit(), 6 * random.unit()));
      const double forth = ggx.reflection(a, b, local_normal<FloatN>()).f.get(0),
                   back = ggx.reflection(b, a, local_normal<FloatN>()).f.get(0);
      worst = std::max(worst, std::abs(forth / back - 1));
    }
    CHECK(worst < 1e-4);
  }
}

TEST_CASE("white metals send all light on, as rough as they are") {
  for (const double roughness : {0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8, 1.0})
    for (const double angle : {0.0, 30.0, 60.0, 80.0, 87.0}) {
      INFO("roughness " << roughness << ", wo at " << angle << " degrees");
      CHECK(sent_share(metal(roughness), at_angle({0, 0, 1}, angle, 1)) == Approx(1).epsilon(0.005));
    }
}

TEST_CASE("white brushed metals send all light on, along their grooves and across") {
  for (const double roughness : {0.05, 0.2, 0.45, 0.8, 1.0})
    for (const double anisotropy : {0.05, 0.3, 0.7, 0.9, 1.0})
      for (const double angle : {0.0, 30.0, 60.0, 80.0})
        for (const double turn : {0.0, 0.4, 1.2, 1.57}) {
          INFO("roughness " << roughness << ", anisotropy " << anisotropy << ", wo at " << angle << ", turned by "
                            << turn);
          MetalBsdf bsdf = metal(roughness);
          bsdf.anisotropy = FloatN(static_cast<float>(anisotropy));
          CHECK(sent_share(bsdf, at_angle({0, 0, 1}, angle, turn)) == Approx(1).epsilon(0.02));
        }
}

TEST_CASE("clear glass sends all light on, as rough as it is, from both sides") {
  const bool thin = GENERATE(false, true);
  for (const double ior : {1.002, 1.006, 1.33, 1.5, 2.4})
    for (const bool front : {true, false})
      for (const double roughness : {0.05, 0.1, 0.2, 0.3, 0.45, 0.6, 0.8, 1.0}) {
        double mean = 0;
        for (const double angle : {0.0, 30.0, 60.0, 80.0, 87.0}) {
          const double share = sent_share(glass(ior, roughness, front, thin), at_angle({0, 0, 1}, angle, 1));
          INFO(ior << (front ? " front" : " back") << ", roughness " << roughness << ", wo at " << angle << " degrees");
          CHECK(share == Approx(1).epsilon(0.02));
          mean += share / 5;
        }
        INFO(ior << (front ? " front" : " back") << ", roughness " << roughness);
        CHECK(mean == Approx(1).epsilon(0.005));
      }
}

TEST_CASE("a lane's sample does not depend on its neighbours") {
  const auto same_bits_in_lane = [](const BsdfSample<FloatN>& a, const BsdfSample<FloatN>& b, std::size_t lane) {
    const auto numbers = [&](const BsdfSample<FloatN>& s) {
      return std::array{s.wi.x.get(lane),    s.wi.y.get(lane), s.wi.z.get(lane), s.f.red.get(lane),
                        s.f.green.get(lane), s.pdf.get(lane),  s.eta2.get(lane)};
    };
    return std::bit_cast<std::array<std::uint32_t, 7>>(numbers(a)) ==
           std::bit_cast<std::array<std::uint32_t, 7>>(numbers(b));
  };
  const std::array<GlassBsdf, 3> glasses{glass(1.5, 0, true), glass(1.5, 0.4, false), glass(1.5, 0.7, true, true)};
  GlassBsdf mixed = glasses[0];
  for (std::size_t number = 0; number < sizeof mixed / sizeof(FloatN); ++number) {
    auto* const to = reinterpret_cast<FloatN*>(&mixed) + number;
    *to = batch_of<FloatN>(
        [&](std::size_t lane) { return (reinterpret_cast<const FloatN*>(&glasses[lane % 3]) + number)->get(lane); });
  }
  Random random(4);
  int wrong = 0;
  for (int i = 0; i < 200; ++i) {
    const auto numbers = [&] { return batch_of<FloatN>([&](std::size_t) { return random.unit(); }); };
    const Vec3<FloatN> wo =
        vectors_of([&](std::size_t) { return at_angle({0, 0, 1}, 89 * random.unit(), 6 * random.unit()); });
    const FloatN u = numbers(), u1 = numbers(), u2 = numbers();
    const auto together = mixed.sample(wo, u, u1, u2);
    for (std::size_t type = 0; type < 3; ++type) {
      const auto alone = glasses[type].sample(wo, u, u1, u2);
      for (std::size_t lane = type; lane < lanes; lane += 3) wrong += !same_bits_in_lane(together, alone, lane);
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("dielectric: in another one, the ratio of the two indices counts") {
  const auto in_water = [](bool front) {
    Dielectric::Parameters parameters;
    parameters.ior = 1.8;
    GlassBsdf bsdf = spread_bsdf<Kernel<Dielectric>::Bsdf>(Kernel<Dielectric>::bsdf(parameters));
    bsdf.set_side(MaskN(front), FloatN(1.2F));
    return bsdf;
  };
  for (const bool front : {true, false}) {
    const GlassBsdf bsdf = in_water(front), in_air = glass(1.5, 0, front);
    CHECK(std::abs(bsdf.eta.get(0) / in_air.eta.get(0) - 1) < 1e-6F);
  }
}

TEST_CASE("dielectric: at a wavelength, it is glass of the index that it has there") {
  for (const bool front : {true, false})
    for (const double roughness : {0.0, 0.3}) {
      Dielectric::Parameters parameters;
      parameters.ior = 1.5;
      parameters.roughness = roughness;
      GlassBsdf bsdf = spread_bsdf<Kernel<Dielectric>::Bsdf>(Kernel<Dielectric>::bsdf(parameters));
      Refraction<FloatN> media(FloatN(1.25F));
      media.disperses = true;
      media.factor = batch_of<FloatN>([](std::size_t lane) { return 1 + 0.01 * static_cast<double>(lane); });
      bsdf.set_side(MaskN(front), media);
      Random random(9);
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const GlassBsdf there = glass((1 + 0.5 * (1 + 0.01 * static_cast<double>(lane))) / 1.25, roughness, front);
        const Vec3<FloatN> wo = spread(at_angle({0, 0, 1}, 80 * random.unit(), 6 * random.unit()));
        const FloatN u(static_cast<float>(random.unit())), u1(static_cast<float>(random.unit())),
            u2(static_cast<float>(random.unit()));
        const auto got = bsdf.sample(wo, u, u1, u2), wanted = there.sample(wo, u, u1, u2);
        CHECK(std::abs(got.pdf.get(lane) / wanted.pdf.get(lane) - 1) < 1e-3F);
        CHECK(std::abs(got.wi.z.get(lane) - wanted.wi.z.get(lane)) < 1e-4F);
      }
    }
}

}  // namespace raytrace::test
