// The atmosphere's light against random walks through the same air, and against what is measured outdoors.
#include "raytrace/lights/atmosphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "support/catch.h"

namespace raytrace::test {

namespace {

constexpr double sky_pi = std::numbers::pi;

constexpr double earth_radius = 6360, air_radius = 6460;

/// Of wavelength number i: the same air, written down again.
struct Air {
  double molecules, haze, ozone;

  Air(std::size_t i, double turbidity) {
    static constexpr double absorption[] = {1.53e-27, 5.52e-27, 1.58e-26, 3.67e-26, 7.75e-26, 1.48e-25,
                                            2.14e-25, 3.09e-25, 4.27e-25, 4.40e-25, 5.02e-25, 3.74e-25,
                                            2.66e-25, 1.85e-25, 1.21e-25, 7.46e-26};
    const double micrometres = 0.4 + 0.02 * static_cast<double>(i);
    molecules = 1.24062e-3 / (micrometres * micrometres * micrometres * micrometres);
    haze = 0.05 * (turbidity - 1) * std::pow(0.55 / micrometres, 1.3) / 1.2;
    ozone = absorption[i] * 300 * 2.687e20 / 15;
  }
  double of_molecules(double height) const { return molecules * std::exp(-height / 8); }
  double of_haze(double height) const { return haze * std::exp(-height / 1.2); }
  double extinction(double height) const {
    const double layer = height > 10 && height < 40 ? 1 - std::abs(height - 25) / 15 : 0;
    return of_molecules(height) + of_haze(height) + ozone * layer;
  }
};

double height_of(const Vec3d& p) { return length(p) - earth_radius; }

/// How far a ray gets until it leaves the air or, if `down`, meets the ground.
double way_of(const Vec3d& p, const Vec3d& d, bool& down) {
  const double along = dot(p, d), squared = dot(p, p);
  const double under = along * along - squared + earth_radius * earth_radius;
  down = along < 0 && under > 0;
  return down ? -along - std::sqrt(under) : -along + std::sqrt(along * along - squared + air_radius * air_radius);
}

/// Short steps, which are longer where the air is thin.
double step_at(double height) { return 0.1 + 0.06 * std::max(height, 0.0); }

double transmittance_to_sun(const Air& air, const Vec3d& p, const Vec3d& to_sun) {
  bool down = false;
  const double way = way_of(p, to_sun, down);
  if (down) return 0;
  double depth = 0;
  for (double t = 0; t < way;) {
    const double step = std::min(step_at(height_of(p + to_sun * t)), way - t);
    depth += air.extinction(height_of(p + to_sun * (t + step / 2))) * step;
    t += step;
  }
  return std::exp(-depth);
}

double molecules_send(double cosine) { return 0.75 * (1 + cosine * cosine) / (4 * sky_pi); }
double haze_sends(double cosine) { return 0.36 / (4 * sky_pi * std::pow(1.64 - 1.6 * cosine, 1.5)); }

/// The radiance that a walk from the ground brings, in units of the sun's irradiance above the air.
double walk(const Air& air, Vec3d direction, const Vec3d& to_sun, double albedo, std::mt19937& bits) {
  std::uniform_real_distribution<double> unit;
  Vec3d p(0, earth_radius + 1e-6, 0);
  double light = 0, weight = 1;
  for (int bounces = 0; bounces < 30; ++bounces) {
    bool down = false;
    const double way = way_of(p, direction, down), wanted = -std::log(1 - unit(bits));
    double t = 0, depth = 0;
    while (t < way && depth < wanted) {
      const double step = std::min(step_at(height_of(p + direction * t)), way - t);
      const double extinction = air.extinction(height_of(p + direction * (t + step / 2)));
      if (depth + extinction * step >= wanted) {
        t += (wanted - depth) / extinction;
        depth = wanted;
        break;
      }
      depth += extinction * step;
      t += step;
    }
    const auto any_direction = [&] {
      const double y = 2 * unit(bits) - 1, turn = 2 * sky_pi * unit(bits), level = std::sqrt(1 - y * y);
      return Vec3d(level * std::cos(turn), y, level * std::sin(turn));
    };
    if (depth < wanted) {
      if (!down) return light;
      p = p + direction * way;
      const Vec3d up = normalize(p);
      p = up * (earth_radius + 1e-6);
      weight *= albedo;
      light += weight / sky_pi * std::max(dot(up, to_sun), 0.0) * transmittance_to_sun(air, p, to_sun);
      direction = normalize(up + any_direction() * 0.999999);
    } else {
      p = p + direction * t;
      const double height = height_of(p), molecules = air.of_molecules(height), haze = air.of_haze(height) * 0.9;
      weight *= (molecules + haze) / air.extinction(height);
      const double share = molecules / (molecules + haze);
      const auto sent = [&](double cosine) {
        return share * molecules_send(cosine) + (1 - share) * haze_sends(cosine);
      };
      light += weight * sent(dot(direction, to_sun)) * transmittance_to_sun(air, p, to_sun);
      const Vec3d next = any_direction();
      weight *= sent(dot(direction, next)) * 4 * sky_pi;
      direction = next;
      if (weight < 0.1) {
        if (unit(bits) > weight / 0.1) return light;
        weight = 0.1;
      }
    }
  }
  return light;
}

Vec3d at_height(double degrees, double turn) {
  const double up = degrees * sky_pi / 180, around = turn * sky_pi / 180;
  return {std::cos(up) * std::cos(around), std::sin(up), std::cos(up) * std::sin(around)};
}

double kilolux(const SkySpectrum& light) {
  const Rgb<double> color = kilocandela(light);
  return 0.2126 * color.red + 0.7152 * color.green + 0.0722 * color.blue;
}

}  // namespace

TEST_CASE("the sky is as bright as random walks through its air find it") {
  const double turbidity = GENERATE(1.0, 4.0), sun_height = GENERATE(60.0, 8.0);
  const Vec3d to_sun = at_height(sun_height, 0);
  const double albedo = 0.3;
  SkySpectrum even{};
  even.fill(albedo);
  const Atmosphere air(turbidity);
  const Atmosphere::FurtherScattering further(air, even, 1);
  std::mt19937 bits(7);
  for (const Vec3d& direction : {at_height(85, 60), at_height(20, 100), at_height(4, 170)}) {
    const auto scattered = air.scattered(direction, to_sun, further);
    for (const std::size_t i : {std::size_t{2}, std::size_t{11}}) {
      INFO("turbidity " << turbidity << ", the sun at " << sun_height << " degrees, direction " << direction.y
                        << ", wavelength " << 400 + 20 * i);
      const double cosine = dot(direction, to_sun);
      const double got = scattered.by_molecules[i] * Atmosphere::molecule_phase(cosine) +
                         scattered.by_haze[i] * Atmosphere::haze_phase(cosine) + scattered.further[i];
      constexpr int walks = 1500;
      double sum = 0, squares = 0;
      for (int k = 0; k < walks; ++k) {
        const double light = walk(Air(i, turbidity), direction, to_sun, albedo, bits);
        sum += light;
        squares += light * light;
      }
      // Light above the air, by what the model's own sun has left of it.
      const double above =
          air.sun(0, to_sun.y)[i] / transmittance_to_sun(Air(i, turbidity), {0, earth_radius + 1e-6, 0}, to_sun);
      const double mean = sum / walks * above, deviation = std::sqrt(squares / walks - sum / walks * (sum / walks)) /
                                                           std::sqrt(double{walks}) * above;
      CHECK(std::abs(got - mean) < 0.13 * mean + 3 * deviation);
    }
  }
}

TEST_CASE("daylight has the illuminances that are measured on clear days") {
  // The sun at 60 degrees: some 90 to 105 thousand lux; above the air 133.
  const Atmosphere air(3);
  CHECK(kilolux(air.sun(100, 1)) == Approx(133).epsilon(0.03));
  CHECK(kilolux(air.sun(0, std::sin(sky_pi / 3))) == Approx(98).epsilon(0.08));
  // At 10 degrees some 30 to 45.
  CHECK(kilolux(air.sun(0, std::sin(10 * sky_pi / 180))) == Approx(37).epsilon(0.2));
}

TEST_CASE("a spectrum of a colour has it under even light") {
  for (const Rgb<double>& color :
       {Rgb<double>(0.5, 0.5, 0.5), Rgb<double>(0.4, 0.2, 0.1), Rgb<double>(0.1, 0.3, 0.1)}) {
    SkySpectrum even{};
    even.fill(1);
    const Rgb<double> seen = kilocandela(reflectance_spectrum(color)), white = kilocandela(even);
    CHECK(seen.green / white.green == Approx(color.green).margin(0.04));
    CHECK(seen.red / white.red == Approx(color.red).margin(0.04));
    CHECK(seen.blue / white.blue == Approx(color.blue).margin(0.04));
  }
}

}  // namespace raytrace::test
