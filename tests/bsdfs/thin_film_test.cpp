// Thin films against Airy's formula with complex numbers in double precision, integrated over the spectrum in steps of
// a nanometre.
#include "raytrace/bsdfs/thin_film.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "bsdfs/judge.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

using Complex = std::complex<double>;
using Colors = std::array<double, 3>;

/// What a wavelength weighs in linear sRGB's channels, whose sums are 1.
struct SpectralWeights {
  static constexpr int first = 380, last = 780;
  std::vector<Colors> values;

  SpectralWeights() {
    // Daylight D65 (CIE 15), every 20 nanometres.
    constexpr std::array d65 = {49.98, 82.75, 93.43, 104.86, 117.81, 115.92, 109.35, 104.79, 104.41, 100.0, 95.79,
                                90.01, 87.70, 83.70, 80.21,  78.28,  71.61,  61.60,  75.09,  46.42,  63.38};
    const auto lobe = [](double at, double mean, double below, double above) {
      const double t = (at - mean) * (at < mean ? below : above);
      return std::exp(-0.5 * t * t);
    };
    Colors sum{};
    for (int l = first; l <= last; ++l) {
      const std::size_t i = static_cast<std::size_t>(l - first) / 20, next = std::min<std::size_t>(i + 1, 20);
      const double light = d65[i] + (d65[next] - d65[i]) * ((l - first) % 20) / 20;
      // Wyman, Sloan and Shirley, 2013.
      const double x = 1.056 * lobe(l, 599.8, 0.0264, 0.0323) + 0.362 * lobe(l, 442.0, 0.0624, 0.0374) -
                       0.065 * lobe(l, 501.1, 0.0490, 0.0382);
      const double y = 0.821 * lobe(l, 568.8, 0.0213, 0.0247) + 0.286 * lobe(l, 530.9, 0.0613, 0.0322);
      const double z = 1.217 * lobe(l, 437.0, 0.0845, 0.0278) + 0.681 * lobe(l, 459.0, 0.0385, 0.0725);
      values.push_back({light * (3.2404542 * x - 1.5371385 * y - 0.4985314 * z),
                        light * (-0.9692660 * x + 1.8760108 * y + 0.0415560 * z),
                        light * (0.0556434 * x - 0.2040259 * y + 1.0572252 * z)});
      for (std::size_t c = 0; c < 3; ++c) sum[c] += values.back()[c];
    }
    for (Colors& value : values)
      for (std::size_t c = 0; c < 3; ++c) value[c] /= sum[c];
  }
};

/// film, base: indices over that above. thickness: in micrometres. own: the film's index, which waves have.
Colors reference(double cosine, double film, double thickness, double own, Complex base) {
  static const SpectralWeights weights;
  const double sine2 = 1 - cosine * cosine;
  const Complex g1 = cosine, g2 = std::sqrt(Complex(film * film - sine2)), g3 = std::sqrt(base * base - sine2);
  const auto r = [](const Complex& a, const Complex& b) { return (a - b) / (a + b); };
  Colors result{};
  for (int l = SpectralWeights::first; l <= SpectralWeights::last; ++l) {
    const Complex wave =
        std::exp(Complex(0, 4 * std::numbers::pi * own * thickness / (l * 1e-3)) * (g2 / Complex(film)));
    double reflected = 0;
    for (const bool along : {false, true}) {
      const Complex e2 = along ? film * film : 1.0, e3 = along ? base * base : 1.0;
      const Complex upper = r(g1, g2 / e2), lower = r(g2 / e2, g3 / e3);
      reflected += std::norm((upper + lower * wave) / (1.0 + upper * lower * wave)) / 2;
    }
    for (std::size_t c = 0; c < 3; ++c)
      result[c] += weights.values[static_cast<std::size_t>(l - SpectralWeights::first)][c] * reflected;
  }
  for (double& value : result) value = std::clamp(value, 0.0, 1.0);
  return result;
}

Colors first_lane(const Rgb<FloatN>& color) {
  return {double{color.red.get(0)}, double{color.green.get(0)}, double{color.blue.get(0)}};
}
FloatN wide(double value) { return FloatN(static_cast<float>(value)); }

ThinFilm<FloatN> film_of(double thickness, double ior, double weight = 1) {
  return {wide(weight), wide(ior), wide(2 * thickness * ior)};
}

struct Difference {
  double worst = 0, squares = 0;
  int count = 0;

  void add(const Colors& a, const Colors& b) {
    for (std::size_t c = 0; c < 3; ++c) {
      worst = std::max(worst, std::abs(a[c] - b[c]));
      squares += (a[c] - b[c]) * (a[c] - b[c]);
      ++count;
    }
  }
  double rms() const { return std::sqrt(squares / count); }
};

constexpr std::array film_angles{0.0, 20.0, 40.0, 60.0, 75.0, 85.0};
const std::vector<double> thicknesses{0.02, 0.05, 0.1, 0.15, 0.2, 0.27, 0.35, 0.42, 0.5, 0.6, 0.75, 0.9, 1.2, 1.6, 3};

double cosine_of(double degrees) { return std::cos(degrees * std::numbers::pi / 180); }

}  // namespace

TEST_CASE("a film on a clear boundary reflects what Airy's formula has over the spectrum") {
  Difference off;
  for (const double film : {1.2, 1.33, 1.5, 2.0, 2.6})
    for (const double base : {1.0, 1.33, 1.5, 2.4})
      for (const double thickness : thicknesses)
        for (const double angle : film_angles) {
          const double c = cosine_of(angle);
          const Colors ours = first_lane(film_of(thickness, film).on_dielectric(wide(c), wide(base)));
          const Colors exact = reference(c, film, thickness, film, base);
          off.add(ours, exact);
          INFO("index " << film << " on " << base << ", " << thickness << " micrometres, " << angle << " degrees");
          for (std::size_t i = 0; i < 3; ++i) CHECK(std::abs(ours[i] - exact[i]) < (angle < 80 ? 0.04 : 0.09));
        }
  CAPTURE(off.worst);
  CHECK(off.rms() < 0.005);
}

TEST_CASE("a film on a metal reflects what Airy's formula has, of an index that gives its reflectance") {
  Difference off;
  const auto index = [](double reflectance) {
    const Complex turned = std::sqrt(reflectance) * std::polar(1.0, std::atan(0.5));
    return (1.0 + turned) / (1.0 - turned);
  };
  for (const double film : {1.3, 1.5, 2.3})
    for (const double thickness : thicknesses)
      for (const double angle : film_angles) {
        const double c = cosine_of(angle);
        Rgb<FloatN> normal(Rgb<float>(0.95F, 0.6F, 0.05F)), edge(Rgb<float>(0.9F, 0.95F, 1.0F));
        const Colors ours = first_lane(film_of(thickness, film).on_metal(wide(c), normal, edge));
        const Colors bare = first_lane(film_of(thickness, film, 0).on_metal(wide(c), normal, edge));
        Colors wanted{};
        for (std::size_t i = 0; i < 3; ++i) {
          const Complex n = index(std::array{0.95, 0.6, 0.05}[i]);
          wanted[i] = std::clamp(
              bare[i] + reference(c, film, thickness, film, n)[i] - reference(c, film, 0, film, n)[i], 0.0, 1.0);
        }
        off.add(ours, wanted);
        INFO("index " << film << ", " << thickness << " micrometres, " << angle << " degrees");
        for (std::size_t i = 0; i < 3; ++i) CHECK(std::abs(ours[i] - wanted[i]) < (angle < 80 ? 0.05 : 0.16));
      }
  CAPTURE(off.worst);
  CHECK(off.rms() < 0.01);
}

TEST_CASE("a film without thickness or of weight 0 reflects what is below it") {
  double worst = 0;
  for (const double angle : film_angles)
    for (const double base : {0.7, 1.0, 1.5, 2.4}) {
      const FloatN c = wide(cosine_of(angle));
      const double bare = fresnel_reflection(c, wide(base)).reflectance.get(0);
      for (const double value : first_lane(film_of(0, 1.8).on_dielectric(c, wide(base))))
        worst = std::max(worst, std::abs(value - bare));
      for (const double value : first_lane(film_of(0.4, 1.8, 0).on_dielectric(c, wide(base)))) CHECK(value == bare);
      const Rgb<FloatN> normal(Rgb<float>(1, 0.5F, 0)), edge(Rgb<float>(1, 1, 1));
      const Colors metal = first_lane(film_of(0, 1.8).on_metal(c, normal, edge)),
                   none = first_lane(film_of(0, 1.8, 0).on_metal(c, normal, edge));
      for (std::size_t i = 0; i < 3; ++i) worst = std::max(worst, std::abs(metal[i] - none[i]));
    }
  CHECK(worst < 2e-5);
}

TEST_CASE("a film reflects as much from inside as from outside, and all where nothing comes out") {
  double worst = 0;
  for (const double thickness : thicknesses)
    for (const double angle : film_angles) {
      const double c = cosine_of(angle), base = 1.6, film = 1.4, inside = std::sqrt(1 - (1 - c * c) / (base * base));
      ThinFilm<FloatN> from_inside = film_of(thickness, film);
      from_inside.eta = wide(film / base);
      const Colors a = first_lane(film_of(thickness, film).on_dielectric(wide(c), wide(base))),
                   b = first_lane(from_inside.on_dielectric(wide(inside), wide(1 / base)));
      for (std::size_t i = 0; i < 3; ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
      CHECK(first_lane(from_inside.on_dielectric(wide(0.6), wide(1 / base)))[1] == 1);
    }
  CHECK(worst < 1e-3);
}

TEST_CASE("a film on what reflects all light reflects all, and a thick one has no colours") {
  const Rgb<FloatN> white(Rgb<float>(1, 1, 1));
  for (const double angle : film_angles) {
    for (const double value : first_lane(film_of(0.3, 1.5).on_metal(wide(cosine_of(angle)), white, white)))
      CHECK(value == Approx(1).epsilon(1e-5));
    const Colors thick = first_lane(film_of(40, 1.5).on_dielectric(wide(cosine_of(angle)), wide(1)));
    CHECK(thick[0] == Approx(thick[1]).epsilon(1e-5));
    CHECK(thick[2] == Approx(thick[1]).epsilon(1e-5));
  }
  CHECK(first_lane(film_of(40, 1.5).on_dielectric(wide(1), wide(1)))[0] == Approx(2 * 0.04 / 1.04).epsilon(1e-4));
}

TEST_CASE("OpenPBR: a film of weight 0 changes no bit, and of thickness 0 little, in lanes beside those with films") {
  OpenPbr::Parameters plain;
  plain.transmission_weight = plain.base_metalness = plain.fuzz_weight = 0.3;
  plain.specular_roughness = 0.4;
  OpenPbr::Parameters filmed = plain, empty = plain, weightless = plain;
  filmed.thin_film_weight = empty.thin_film_weight = 1;
  empty.thin_film_thickness = 0;
  weightless.thin_film_thickness = 0.9;
  using Bsdf = Kernel<OpenPbr>::Bsdf<FloatN>;
  const auto bsdf_of = [](const OpenPbr::Parameters& p) {
    return spread_bsdf<Kernel<OpenPbr>::Bsdf>(Kernel<OpenPbr>::bsdf(p));
  };
  // Every second lane has a film.
  const std::array records{Kernel<OpenPbr>::bsdf(weightless), Kernel<OpenPbr>::bsdf(filmed)};
  const auto mixed = gather_records<Kernel<OpenPbr>::Bsdf, FloatN>(
      records.data(), LaneIndices(to_int(batch_of<FloatN>([](std::size_t lane) { return lane % 2; }))));
  Random random(4);
  double worst = 0;
  for (int i = 0; i < 100; ++i) {
    const Vec3<FloatN> wo = spread(at_angle({0, 0, 1}, 80 * random.unit(), 6 * random.unit())),
                       wi = spread(at_angle({0, 0, 1}, 80 * random.unit(), 6 * random.unit()));
    const FloatN u = wide(random.unit()), u1 = wide(random.unit()), u2 = wide(random.unit());
    const auto f = [&](const Bsdf& bsdf) { return first_lane(bsdf.evaluate(wo, wi, local_normal<FloatN>())); };
    const auto drawn = [&](const Bsdf& bsdf) { return first_lane(bsdf.sample(wo, u, u1, u2).f); };
    CHECK(f(mixed) == f(bsdf_of(plain)));
    CHECK(drawn(mixed) == drawn(bsdf_of(plain)));
    const Colors none = f(bsdf_of(plain)), thin = f(bsdf_of(empty)), film = f(bsdf_of(filmed));
    for (std::size_t c = 0; c < 3; ++c) worst = std::max(worst, std::abs(thin[c] / none[c] - 1));
    CHECK(film != none);
  }
  CHECK(worst < 1e-3);
}

}  // namespace raytrace::test
