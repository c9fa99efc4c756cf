// Hair: fibres against a reference of the formulas in double precision, against Mitsuba's, and sample() against pdf().
//
// The reference is written in another way: it follows a ray through a circle for where light leaves, integrates
// Bessel's function, and normalises its lobes by numeric integrals.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "bsdfs/judge.h"
#include "bsdfs/mitsuba_hair.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

using HairBsdf = Kernel<Hair>::Bsdf<FloatN>;
constexpr double pi = std::numbers::pi;

Hair::Parameters absorbing(const Rgb<double>& absorption, double roughness = 0.3, double radialroughness = 0.3) {
  Hair::Parameters hair;
  hair.absorption = absorption;
  hair.roughness = roughness;
  hair.radialroughness = radialroughness;
  return hair;
}

HairBsdf bsdf_of(const Hair::Parameters& hair) { return spread_bsdf<Kernel<Hair>::Bsdf>(Kernel<Hair>::bsdf(hair)); }

/// theta: the angle from the plane across the fibre towards its tip; phi: around it, from the normal.
Vec3d direction(double theta, double phi) {
  return {std::sin(theta), std::cos(theta) * std::sin(phi), std::cos(theta) * std::cos(phi)};
}
Vec3d at_degrees(double theta, double phi) { return direction(theta * pi / 180, phi * pi / 180); }

struct Reference {
  std::array<double, 3> scattered{};  ///< f times the cosine
  std::array<double, 3> sent_on{};    ///< the integral of that over all directions
};

/// Where light leaves a circle of that index that came in at the angle gamma from the normal at angle 0, by a ray that
/// is refracted, runs straight and is reflected. It came from the direction of angle gamma; `times` through the inside.
double leaves_at(double gamma, double index, int times) {
  const double inside = std::asin(std::sin(gamma) / index);
  if (times == 0) return -gamma;
  double x = 1, y = 0, way = pi + inside;  // at angle 0 of the circle, on its way in
  for (int i = 0; i < times; ++i) {
    const double dx = std::cos(way), dy = std::sin(way), length = -2 * (x * dx + y * dy);
    x += length * dx, y += length * dy;
    if (i + 1 < times) {
      const double along = dx * x + dy * y;  // the circle's normal there is (x, y)
      way = std::atan2(dy - 2 * along * y, dx - 2 * along * x);
    }
  }
  // Out: from the normal there, as far to the other side as it came in.
  const double normal = std::atan2(y, x), from_normal = std::remainder(way - normal, 2 * pi);
  return normal + std::copysign(std::abs(gamma), from_normal);
}

double bessel_i0(double x, double exponent) {  // times exp(exponent)
  constexpr int steps = 4000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += std::exp(x * std::cos((i + 0.5) / steps * pi) + exponent);
  return sum / steps;
}

double longitudinal(double theta_i, double theta_o, double v) {
  // Without its factor of the variance alone, over the integral of that.
  const auto shape = [&](double theta) {
    return bessel_i0(std::cos(theta) * std::cos(theta_o) / v, -std::sin(theta) * std::sin(theta_o) / v - 1 / v);
  };
  return shape(theta_i) / (v * (1 - std::exp(-2 / v)));
}

double azimuthal(double angle, double s) {
  const double x = std::remainder(angle, 2 * pi);
  const auto below = [&](double a) { return 0.5 * (1 + std::tanh(a / (2 * s))); };
  const double root = std::cosh(x / (2 * s));
  return 1 / (4 * s * root * root) / (below(pi) - below(-pi));
}

Reference reference(const Hair::Parameters& hair, const Vec3d& wo, const Vec3d& wi) {
  const double theta_o = std::asin(std::clamp(wo.x, -1.0, 1.0)), theta_i = std::asin(std::clamp(wi.x, -1.0, 1.0));
  const double gamma = std::atan2(wo.y, wo.z), phi_i = std::atan2(wi.y, wi.z);
  const double b = hair.roughness, n = hair.radialroughness;
  const double v = std::pow(0.726 * b + 0.812 * b * b + 3.7 * std::pow(b, 20), 2);
  const double s = std::sqrt(pi / 8) * (0.265 * n + 1.194 * n * n + 5.372 * std::pow(n, 22));
  // The plane across sees another index (Bravais); the way along the axis is longer.
  const double theta_t = std::asin(std::sin(theta_o) / hair.ior);
  const double index = hair.ior * std::cos(theta_t) / std::cos(theta_o);
  const double gamma_t = std::asin(std::sin(gamma) / index);
  const double cosine = std::cos(theta_o) * std::cos(gamma), cosine_t = std::cos(theta_t) * std::cos(gamma_t);
  const double across = (cosine - hair.ior * cosine_t) / (cosine + hair.ior * cosine_t);
  const double along = (hair.ior * cosine - cosine_t) / (hair.ior * cosine + cosine_t);
  const double fresnel = (across * across + along * along) / 2;
  const std::array<double, 3> absorptions{hair.absorption.red, hair.absorption.green, hair.absorption.blue};
  const double tilt = hair.scaletilt * pi / 180;
  Reference result;
  for (std::size_t c = 0; c < 3; ++c) {
    const double left = std::exp(-absorptions[c] * 2 * std::cos(gamma_t) / std::cos(theta_t));
    double part = fresnel, all_before = 0;
    for (int p = 0; p < 40; ++p) {
      if (p == 1) part = (1 - fresnel) * (1 - fresnel) * left;
      if (p > 1) part *= fresnel * left;
      const std::array<double, 3> tilts{-2 * tilt, tilt, 4 * tilt};
      const std::array<double, 3> variances{v, v / 4, 4 * v};
      const auto order = static_cast<std::size_t>(std::min(p, 3));
      const double m = longitudinal(theta_i, order < 3 ? theta_o + tilts[order] : theta_o,
                                    variances[std::min<std::size_t>(order, 2)]);
      const double around = order < 3 ? azimuthal(phi_i - leaves_at(gamma, index, p), s) : 1 / (2 * pi);
      result.scattered[c] += m * part * around;
      all_before += part;
    }
    result.sent_on[c] = all_before;
  }
  return result;
}

/// Of f times the cosine, as the contract has it.
Rgb<FloatN> scattered(const HairBsdf& bsdf, const Vec3d& wo, const Vec3<FloatN>& wi) {
  return bsdf.evaluate(spread(wo), wi, local_normal<FloatN>()) * abs(wi.z);
}

constexpr std::size_t heights = 32, turns = 32;

/// The sphere of directions in equal cells of the sine of theta and of phi; visit(cell, wi) at the middles of fine
/// ones, whose solid angle is the result.
template <class Visit>
double for_each_direction(std::size_t fine, const Visit& visit) {
  const std::size_t rows = heights * fine, columns = turns * fine;
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t first = 0; first < columns; first += lanes) {
      const Vec3<FloatN> wi = vectors_of([&](std::size_t lane) {
        const double sine = 2 * (static_cast<double>(row) + 0.5) / static_cast<double>(rows) - 1;
        const double phi = 2 * pi * (static_cast<double>(first + lane) + 0.5) / static_cast<double>(columns) - pi;
        return direction(std::asin(sine), phi);
      });
      visit(row / fine, first, wi);
    }
  return 4 * pi / static_cast<double>(rows * columns);
}

const std::vector<double> roughnesses{0.1, 0.3, 0.6, 1};
const std::vector<Vec3d> outgoing{at_degrees(0, 0), at_degrees(25, 40), at_degrees(-60, -75), at_degrees(70, 10)};

}  // namespace

TEST_CASE("hair: f is that of a ray followed through a fibre, in double precision") {
  Random random(5);
  for (int i = 0; i < 60; ++i) {
    Hair::Parameters hair = absorbing({random.unit(), 2 * random.unit(), 4 * random.unit()}, 0.08 + 0.9 * random.unit(),
                                      0.08 + 0.9 * random.unit());
    hair.ior = 1.2 + random.unit();
    hair.scaletilt = 10 * (2 * random.unit() - 1);
    const HairBsdf bsdf = bsdf_of(hair);
    for (int k = 0; k < 8; ++k) {
      const Vec3d wo = direction((random.unit() - 0.5) * 2.9, (random.unit() - 0.5) * 3.0);
      // Half of them near where light goes through.
      const Vec3d wi = k % 2 == 0 ? random.direction()
                                  : direction(-std::asin(wo.x) + 0.2 * (random.unit() - 0.5), 2 * pi * random.unit());
      if (std::abs(wi.z) < 1e-3) continue;
      const Reference wanted = reference(hair, wo, wi);
      const Rgb<FloatN> got = scattered(bsdf, wo, spread(wi));
      INFO("roughness " << hair.roughness << ", " << hair.radialroughness << ", wo " << wo.x << " " << wo.y << " "
                        << wo.z << ", wi " << wi.x << " " << wi.y << " " << wi.z);
      const double unit = std::max({wanted.scattered[0], wanted.scattered[1], wanted.scattered[2]});
      CHECK(double{got.red.get(0)} == Approx(wanted.scattered[0]).epsilon(2e-4).margin(2e-5 * unit + 1e-9));
      CHECK(double{got.green.get(0)} == Approx(wanted.scattered[1]).epsilon(2e-4).margin(2e-5 * unit + 1e-9));
      CHECK(double{got.blue.get(0)} == Approx(wanted.scattered[2]).epsilon(2e-4).margin(2e-5 * unit + 1e-9));
    }
  }
}

TEST_CASE("hair: f is that of Mitsuba 3's hair") {
  for (const MitsubaHair& row : mitsuba_hairs) {
    Hair::Parameters hair = absorbing(row.absorption, row.roughness, row.radialroughness);
    hair.scaletilt = row.scaletilt;
    hair.ior = row.ior;
    const Rgb<FloatN> got =
        scattered(bsdf_of(hair), at_degrees(row.theta_o, row.phi_o), spread(at_degrees(row.theta_i, row.phi_i)));
    INFO("roughness " << row.roughness << ", theta_o " << row.theta_o << ", theta_i " << row.theta_i);
    CHECK(double{got.red.get(0)} == Approx(row.f.red).epsilon(6e-3));
    CHECK(double{got.green.get(0)} == Approx(row.f.green).epsilon(6e-3));
    CHECK(double{got.blue.get(0)} == Approx(row.f.blue).epsilon(6e-3));
  }
}

TEST_CASE("hair: what absorbs nothing sends on all light, and no hair more, by quadrature") {
  for (const double roughness : roughnesses)
    for (const double radial : roughnesses)
      for (const Vec3d& wo : outgoing) {
        Hair::Parameters white;
        white.color = {1, 1, 1};
        white.roughness = roughness;
        white.radialroughness = radial;
        const Hair::Parameters brown = absorbing({0.1, 0.5, 2}, roughness, radial);
        const HairBsdf bsdf = bsdf_of(white), absorbs = bsdf_of(brown);
        double all = 0, density = 0, red = 0, blue = 0;
        const double cell =
            for_each_direction(roughness < 0.2 || radial < 0.2 ? 12 : 6, [&](auto, auto, const auto& wi) {
              const Rgb<FloatN> sent = scattered(bsdf, wo, wi), left = scattered(absorbs, wo, wi);
              const FloatN pdf = bsdf.pdf(spread(wo), wi);
              for (std::size_t lane = 0; lane < lanes; ++lane) {
                all += double{sent.green.get(lane)}, density += double{pdf.get(lane)};
                red += double{left.red.get(lane)}, blue += double{left.blue.get(lane)};
              }
            });
        INFO("roughness " << roughness << ", " << radial << ", wo " << wo.x << " " << wo.y << " " << wo.z);
        CHECK(all * cell == Approx(1).epsilon(2e-3));
        CHECK(density * cell == Approx(1).epsilon(2e-3));
        const Reference wanted = reference(brown, wo, {0, 0, 1});
        CHECK(red * cell == Approx(wanted.sent_on[0]).epsilon(2e-3));
        CHECK(blue * cell == Approx(wanted.sent_on[2]).epsilon(2e-3));
        CHECK(red * cell < 1);
      }
}

TEST_CASE("hair: samples follow the pdf, carry f, and send on what is not absorbed") {
  for (const double roughness : roughnesses)
    for (const double radial : roughnesses)
      for (const Vec3d& wo : outgoing) {
        const Hair::Parameters hair = absorbing({0.05, 0.3, 1}, roughness, radial);
        const HairBsdf bsdf = bsdf_of(hair);
        const std::size_t fine = roughness < 0.2 || radial < 0.2 ? 16 : 8;
        std::vector<double> expected(heights * turns), observed(heights * turns);
        const double cell = for_each_direction(fine, [&](std::size_t row, std::size_t first, const auto& wi) {
          const FloatN pdf = bsdf.pdf(spread(wo), wi);
          for (std::size_t lane = 0; lane < lanes; ++lane)
            expected[row * turns + (first + lane) / fine] += double{pdf.get(lane)};
        });
        for (double& value : expected) value *= cell * samples;
        Random random(31);
        double worst_f = 0, worst_pdf = 0, worst_length = 0, red = 0;
        for (int i = 0; i < samples; i += packet_lanes) {
          const auto numbers = [&] { return batch_of<FloatN>([&](std::size_t) { return random.unit(); }); };
          const FloatN u = numbers(), u1 = numbers(), u2 = numbers();
          const BsdfSample<FloatN> drawn = bsdf.sample(spread(wo), u, u1, u2);
          const Rgb<FloatN> f = bsdf.evaluate(spread(wo), drawn.wi, local_normal<FloatN>());
          const FloatN pdf = bsdf.pdf(spread(wo), drawn.wi);
          for (std::size_t lane = 0; lane < lanes; ++lane) {
            const Vec3d wi = lane_of(drawn.wi, lane);
            const double turn = (std::atan2(wi.y, wi.z) + pi) / (2 * pi);
            const auto row = static_cast<std::size_t>(std::clamp((wi.x + 1) / 2 * heights, 0.0, heights - 1.0));
            const auto column = static_cast<std::size_t>(std::clamp(turn * turns, 0.0, turns - 1.0));
            ++observed[row * turns + column];
            const double density = double{drawn.pdf.get(lane)};
            worst_length = std::max(worst_length, std::abs(length(wi) - 1));
            worst_f = std::max(worst_f, std::abs(double{f.blue.get(lane)} - double{drawn.f.blue.get(lane)}));
            worst_pdf = std::max(worst_pdf, std::abs(double{pdf.get(lane)} - density));
            red += double{drawn.f.red.get(lane)} * std::abs(wi.z) / density;
          }
        }
        INFO("roughness " << roughness << ", " << radial << ", wo " << wo.x << " " << wo.y << " " << wo.z);
        CHECK(chi_square_deviation(observed, expected) < 4);
        CHECK(worst_f == 0);
        CHECK(worst_pdf == 0);
        CHECK(worst_length < 1e-6);
        CHECK(red / samples == Approx(reference(hair, wo, {0, 0, 1}).sent_on[0]).epsilon(0.01));
      }
}

TEST_CASE("hair: light drawn evenly from all sides says the same of its energy") {
  for (const double roughness : roughnesses) {
    Hair::Parameters white;
    white.color = {1, 1, 1};
    white.roughness = white.radialroughness = roughness;
    const HairBsdf bsdf = bsdf_of(white);
    Random random(8);
    double sum = 0;
    constexpr int count = 2'000'000;
    const Vec3d wo = at_degrees(20, 30);
    for (int i = 0; i < count; i += packet_lanes) {
      std::array<Vec3d, lanes> from_all_sides;
      for (Vec3d& wi : from_all_sides) wi = random.direction();
      const Rgb<FloatN> sent = scattered(bsdf, wo, vectors_of([&](std::size_t lane) { return from_all_sides[lane]; }));
      for (std::size_t lane = 0; lane < lanes; ++lane) sum += double{sent.red.get(lane)};
    }
    INFO("roughness " << roughness);
    CHECK(sum / count * 4 * pi == Approx(1).epsilon(roughness < 0.2 ? 0.02 : 0.01));
  }
}

TEST_CASE("hair: a color is its own albedo, and melanin and absorption have those of the colors that absorb the same") {
  for (const double radial : {0.1, 0.3, 0.9}) {
    Hair::Parameters hair;
    hair.color = {0.9, 0.4, 0.05};
    hair.radialroughness = radial;
    const auto bsdf = Kernel<Hair>::bsdf(hair);
    CHECK(double{bsdf.albedo().red} == Approx(0.9).epsilon(1e-5));
    CHECK(double{bsdf.albedo().green} == Approx(0.4).epsilon(1e-5));
    CHECK(double{bsdf.albedo().blue} == Approx(0.05).epsilon(1e-5));
    // Chiang et al., equation 9.
    const double fit = 5.969 - 0.215 * radial + 2.532 * std::pow(radial, 2) - 10.73 * std::pow(radial, 3) +
                       5.574 * std::pow(radial, 4) + 0.245 * std::pow(radial, 5);
    CHECK(double{bsdf.absorption.green} == Approx(std::pow(std::log(0.4) / fit, 2)).epsilon(1e-5));
    const auto same = Kernel<Hair>::bsdf(
        absorbing(Rgb<double>(double{bsdf.absorption.red}, double{bsdf.absorption.green}, double{bsdf.absorption.blue}),
                  0.3, radial));
    CHECK(double{same.albedo().blue} == Approx(0.05).epsilon(1e-5));
  }
  Hair::Parameters hair;
  hair.melanin = 0.6;
  hair.melaninredness = 0.25;
  const double pigment = -std::log(0.4);
  const auto bsdf = Kernel<Hair>::bsdf(hair);
  CHECK(double{bsdf.absorption.red} == Approx(pigment * (0.75 * 0.506 + 0.25 * 0.343)).epsilon(1e-5));
  CHECK(double{bsdf.absorption.green} == Approx(pigment * (0.75 * 0.841 + 0.25 * 0.733)).epsilon(1e-5));
  CHECK(double{bsdf.absorption.blue} == Approx(pigment * (0.75 * 1.653 + 0.25 * 1.924)).epsilon(1e-5));
}

TEST_CASE("hair: a lane knows nothing of its neighbours, and packets of parameters are those of each") {
  Random random(77);
  std::vector<Hair::Parameters> hairs(lanes);
  std::vector<Vec3d> wo(lanes), wi(lanes);
  Hair::Values<FloatN> wide;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    hairs[lane] = absorbing({random.unit(), random.unit(), 3 * random.unit()}, random.unit(), random.unit());
    wo[lane] = direction((random.unit() - 0.5) * 3, (random.unit() - 0.5) * 3);
    wi[lane] = random.direction();
  }
  const auto set = [&](FloatN Hair::Values<FloatN>::* to, double Hair::Values<double>::* from) {
    wide.*to = batch_of<FloatN>([&](std::size_t lane) { return hairs[lane].*from; });
  };
  set(&Hair::Values<FloatN>::melaninredness, &Hair::Values<double>::melaninredness);
  set(&Hair::Values<FloatN>::roughness, &Hair::Values<double>::roughness);
  set(&Hair::Values<FloatN>::radialroughness, &Hair::Values<double>::radialroughness);
  set(&Hair::Values<FloatN>::ior, &Hair::Values<double>::ior);
  wide.absorption = {batch_of<FloatN>([&](std::size_t lane) { return hairs[lane].absorption.red; }),
                     batch_of<FloatN>([&](std::size_t lane) { return hairs[lane].absorption.green; }),
                     batch_of<FloatN>([&](std::size_t lane) { return hairs[lane].absorption.blue; })};
  wide.color = Rgb<FloatN>(Rgb<float>(0, 0, 0));
  const HairBsdf together = Kernel<Hair>::bsdf_of<FloatN>(wide);
  const Vec3<FloatN> all_wo = vectors_of([&](std::size_t lane) { return wo[lane]; });
  const Vec3<FloatN> all_wi = vectors_of([&](std::size_t lane) { return wi[lane]; });
  const FloatN u = batch_of<FloatN>([&](std::size_t lane) { return (static_cast<double>(lane) + 0.5) / lanes; });
  const Rgb<FloatN> f = together.evaluate(all_wo, all_wi, local_normal<FloatN>());
  const BsdfSample<FloatN> drawn = together.sample(all_wo, u, u, u);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const HairBsdf record = bsdf_of(hairs[lane]);
    const Rgb<FloatN> of_record = record.evaluate(spread(wo[lane]), spread(wi[lane]), local_normal<FloatN>());
    INFO("lane " << lane << ", roughness " << hairs[lane].roughness);
    CHECK(double{f.red.get(lane)} == Approx(double{of_record.red.get(0)}).epsilon(1e-3).margin(1e-9));
    // The same parameters in every lane: the same bits.
    Hair::Values<FloatN> alone;
    const auto* const from = reinterpret_cast<const FloatN*>(&wide);
    auto* const to = reinterpret_cast<FloatN*>(&alone);
    for (std::size_t i = 0; i < sizeof wide / sizeof(FloatN); ++i) to[i] = FloatN(from[i].get(lane));
    const HairBsdf single = Kernel<Hair>::bsdf_of<FloatN>(alone);
    const Rgb<FloatN> own = single.evaluate(spread(wo[lane]), spread(wi[lane]), local_normal<FloatN>());
    const BsdfSample<FloatN> own_drawn =
        single.sample(spread(wo[lane]), FloatN(u.get(lane)), FloatN(u.get(lane)), FloatN(u.get(lane)));
    CHECK(f.red.get(lane) == own.red.get(0));
    CHECK(f.blue.get(lane) == own.blue.get(0));
    CHECK(drawn.wi.x.get(lane) == own_drawn.wi.x.get(0));
    CHECK(drawn.wi.y.get(lane) == own_drawn.wi.y.get(0));
    CHECK(drawn.pdf.get(lane) == own_drawn.pdf.get(0));
  }
}

TEST_CASE("hair: no direction and no parameter gives what is no number") {
  for (const double roughness : {0.0, 0.02, 0.5, 1.0})
    for (const double ior : {1.0, 1.55, 3.0})
      for (const Vec3d& wo : {Vec3d{1, 0, 0}, Vec3d{-1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, -1, 0}, Vec3d{0, 0, 1},
                              Vec3d{0.6, 0.8, -1e-4}, at_degrees(89.9999, 20), at_degrees(0, 89.9999)})
        for (const double absorption : {0.0, 1.0, 1e17}) {
          Hair::Parameters hair = absorbing({absorption, absorption, absorption}, roughness, roughness);
          hair.ior = ior;
          const HairBsdf bsdf = bsdf_of(hair);
          for (const Vec3d& along : {Vec3d{1, 0, 0}, Vec3d{-1, 0, 0}}) {
            CHECK(std::isfinite(bsdf.evaluate(spread(wo), spread(along), local_normal<FloatN>()).red.get(0)));
            CHECK(std::isfinite(bsdf.pdf(spread(wo), spread(along)).get(0)));
          }
          for (const double u : {0.0, 0.05, 0.4, 0.8, 1 - 0x1p-24})
            for (const double u1 : {0.0, 0.5, 1 - 0x1p-24}) {
              const auto number = [](double x) { return FloatN(static_cast<float>(x)); };
              const BsdfSample<FloatN> drawn = bsdf.sample(spread(wo), number(u), number(u1), number(1 - 0x1p-24 - u1));
              const Vec3d wi = lane_of(drawn.wi, 0);
              INFO("roughness " << roughness << ", ior " << ior << ", absorption " << absorption << ", wo " << wo.x
                                << " " << wo.y << " " << wo.z << ", u " << u << ", " << u1);
              CHECK(std::abs(length(wi) - 1) < 1e-5);
              CHECK(std::isfinite(drawn.f.red.get(0)));
              CHECK(drawn.f.red.get(0) >= 0);
              CHECK(std::isfinite(drawn.pdf.get(0)));
              CHECK(drawn.pdf.get(0) >= 0);
            }
        }
}

}  // namespace raytrace::test
