#include "raytrace/lights/atmosphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

namespace {

using std::numbers::pi;
constexpr std::size_t wavelengths = std::tuple_size_v<SkySpectrum>;
constexpr double step = 0.02;  ///< between wavelengths, in micrometres

constexpr double earth = 6360, thickness = 100;  ///< the Earth's radius, and the height up to which there is air

/// How much of what haze takes away of light it scatters; the rest is absorbed.
constexpr double haze_albedo = 0.9;
/// The mean cosine between the ways before and after (Henyey and Greenstein), and what part of it counts as sent on.
constexpr double haze_forward = 0.8, sent_on = haze_forward * haze_forward;
/// Of the haze, what takes light away then, and what scatters it evenly.
constexpr double haze_share = 1 - haze_albedo * sent_on, haze_scattering = haze_albedo * (1 - sent_on);

double wavelength_of(std::size_t i) { return 0.4 + step * static_cast<double>(i); }

/// Above the air, in W/m^2/nm (ASTM E490).
constexpr SkySpectrum sunlight = {1.728, 1.689, 1.912, 2.020, 1.934, 1.917, 1.869, 1.851,
                                  1.834, 1.815, 1.753, 1.682, 1.605, 1.556, 1.474, 1.410};

/// What a molecule of ozone absorbs, in 1e-25 m^2 (Serdyuchenko and others, 2014).
constexpr SkySpectrum ozone_absorption = {0.0153, 0.0552, 0.158, 0.367, 0.775, 1.48, 2.14, 3.09,
                                          4.27,   4.40,   5.02,  3.74,  2.66,  1.85, 1.21, 0.746};

/// 300 Dobson units of it, in molecules per square metre.
constexpr double ozone_column = 300 * 2.687e20;
/// It is most at 25 km, and none from 15 km below and above.
constexpr double ozone_height = 25, ozone_extent = 15;

constexpr double molecule_scale = 8, haze_scale = 1.2;  ///< heights within which they become e times less

/// Along a ray from a height: where it is after a way, and how high above the ground.
double height_after(double height, double cosine, double way) {
  const double radius = earth + height;
  // The difference to the ground, of numbers of thousands, without cancellation.
  const double rise = way * (way + 2 * radius * cosine);
  return height + rise / (radius + std::sqrt(radius * radius + rise));
}

/// Until the air ends.
double way_out(double height, double cosine) {
  const double radius = earth + height, along = radius * cosine;
  return std::sqrt(along * along + (thickness - height) * (2 * earth + thickness + height)) - along;
}

/// Until it meets the ground; negative if it does not.
double way_down(double height, double cosine) {
  const double radius = earth + height, along = radius * cosine;
  const double square = along * along - height * (2 * earth + height);
  return cosine < 0 && square >= 0 ? -along - std::sqrt(square) : -1;
}

/// The middle and the length of part i of a way, short ones first, since air is densest below.
struct Part {
  double middle, length;
  Part(int i, int parts, double way) {
    const double first = static_cast<double>(i) / parts, last = static_cast<double>(i + 1) / parts;
    length = way * (last * last - first * first);
    middle = way * first * first + length / 2;
  }
};

/// Each number by what is at its wavelength.
template <class Function>
void for_each_wavelength(const Function& f) {
  for (std::size_t i = 0; i < wavelengths; ++i) f(i);
}

double lobe(double wavelength, double center, double below, double above) {
  const double x = (wavelength * 1000 - center) / (wavelength * 1000 < center ? below : above);
  return std::exp(-x * x / 2);
}

}  // namespace

Atmosphere::Atmosphere(double turbidity) {
  for_each_wavelength([&](std::size_t i) {
    const double w = wavelength_of(i);
    molecules_[i] = 1.24062e-3 * std::pow(w, -4);
    haze_[i] = 0.05 * (turbidity - 1) * std::pow(w / 0.55, -1.3) / haze_scale;
    ozone_[i] = ozone_absorption[i] * 1e-25 * ozone_column / ozone_extent;
  });
}

double Atmosphere::molecule_phase(double cosine) { return 3 / (16 * pi) * (1 + cosine * cosine); }

double Atmosphere::haze_phase(double cosine) {
  constexpr double g = haze_forward;
  return (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

Atmosphere::Amounts Atmosphere::density(double height) {
  return {std::exp(-height / molecule_scale), std::exp(-height / haze_scale),
          std::max(1 - std::abs(height - ozone_height) / ozone_extent, 0.0)};
}

bool Atmosphere::amounts_above(double height, double cosine, Amounts& amounts) {
  if (way_down(height, cosine) >= 0) return false;
  // A ray that falls first is densest where it is lowest: from there, both ways.
  const double fall = cosine < 0 ? -(earth + height) * cosine : 0;
  const auto add = [&](double from, double to) {
    constexpr int parts = 24;
    for (int i = 0; i < parts; ++i) {
      const Part part(i, parts, std::abs(to - from));
      const Amounts here = density(height_after(height, cosine, from < to ? from + part.middle : from - part.middle));
      amounts.molecules += here.molecules * part.length;
      amounts.haze += here.haze * part.length;
      amounts.ozone += here.ozone * part.length;
    }
  };
  if (fall > 0) add(fall, 0);
  add(fall, way_out(height, cosine));
  return true;
}

SkySpectrum Atmosphere::sun(double height, double cosine, double share_of_haze) const {
  Amounts amounts;
  if (!amounts_above(height, cosine, amounts)) return {};
  SkySpectrum result{};
  for_each_wavelength([&](std::size_t i) {
    const double depth =
        molecules_[i] * amounts.molecules + haze_[i] * share_of_haze * amounts.haze + ozone_[i] * amounts.ozone;
    result[i] = sunlight[i] * std::exp(-depth);
  });
  return result;
}

SkySpectrum Atmosphere::sun(double height, double cosine) const { return sun(height, cosine, 1); }

Atmosphere::FurtherScattering::FurtherScattering(const Atmosphere& air, const SkySpectrum& albedo, int threads)
    : table_(place(heights, 0)) {
  for_each_index(heights, threads, [&](int row) {
    const double share = static_cast<double>(row) / (heights - 1), height = thickness * share * share;
    for (int column = 0; column < cosines; ++column) {
      const double sun_y = 2 * static_cast<double>(column) / (cosines - 1) - 1;
      const Vec3d to_sun(std::sqrt(1 - sun_y * sun_y), sun_y, 0);
      // Of light that is scattered once and comes here from all sides, the mean; and of light that comes evenly from
      // all places, how much is scattered to here.
      SkySpectrum once{}, again{};
      constexpr int turns = 6, slopes = 8, parts = 16;
      for (int i = 0; i < turns * slopes; ++i) {
        const int slope = i / turns;
        const double y = (2 * slope + 1.0) / slopes - 1, turn = pi * (i % turns + 0.5) / turns;
        const double level = std::sqrt(1 - y * y);
        const Vec3d direction(level * std::cos(turn), y, level * std::sin(turn));
        const double down = way_down(height, y), way = down >= 0 ? down : way_out(height, y);
        // The sun's cosine at a point of the ray, above which up is another direction.
        const auto sun_cosine = [&](double at, double there) {
          return ((earth + height) * to_sun.y + at * dot(direction, to_sun)) / (earth + there);
        };
        SkySpectrum left;
        left.fill(1.0 / (turns * slopes));
        for (int k = 0; k < parts; ++k) {
          const Part part(k, parts, way);
          const double there = std::max(height_after(height, y, part.middle), 0.0);
          const Amounts here = density(there);
          const SkySpectrum lit = air.sun(there, sun_cosine(part.middle, there), haze_share);
          for_each_wavelength([&](std::size_t w) {
            const double scattering = air.molecules_[w] * here.molecules + air.haze_[w] * haze_scattering * here.haze;
            const double extinction = air.molecules_[w] * here.molecules + air.haze_[w] * haze_share * here.haze +
                                      air.ozone_[w] * here.ozone + 1e-12;
            const double through = std::exp(-extinction * part.length);
            const double met = left[w] * (1 - through) / extinction * scattering;
            once[w] += met * lit[w] / (4 * pi);
            again[w] += met;
            left[w] *= through;
          });
        }
        if (down < 0) continue;
        const double cosine = sun_cosine(down, 0);
        const SkySpectrum lit = air.sun(0, cosine, haze_share);
        for_each_wavelength(
            [&](std::size_t w) { once[w] += left[w] * albedo[w] / pi * lit[w] * std::max(cosine, 0.0); });
      }
      SkySpectrum& result = table_[place(row, column)];
      for_each_wavelength([&](std::size_t w) { result[w] = once[w] / (1 - again[w]); });
    }
  });
}

SkySpectrum Atmosphere::FurtherScattering::at(double height, double cosine) const {
  const double row = std::sqrt(std::clamp(height / thickness, 0.0, 1.0)) * (heights - 1),
               column = (std::clamp(cosine, -1.0, 1.0) + 1) / 2 * (cosines - 1);
  const int low = std::min(static_cast<int>(row), heights - 2), left = std::min(static_cast<int>(column), cosines - 2);
  const double up = row - low, right = column - left;
  const SkySpectrum* const first = &table_[place(low, left)];
  SkySpectrum result{};
  for_each_wavelength([&](std::size_t w) {
    result[w] = (first[0][w] * (1 - right) + first[1][w] * right) * (1 - up) +
                (first[cosines][w] * (1 - right) + first[cosines + 1][w] * right) * up;
  });
  return result;
}

Atmosphere::Scattered Atmosphere::scattered(const Vec3d& direction, const Vec3d& to_sun,
                                            const FurtherScattering& further) const {
  Scattered result{};
  SkySpectrum left;
  left.fill(1);
  constexpr int parts = 48;
  const double way = way_out(0, direction.y);
  for (int k = 0; k < parts; ++k) {
    const Part part(k, parts, way);
    const double height = height_after(0, direction.y, part.middle);
    const double cosine = (earth * to_sun.y + part.middle * dot(direction, to_sun)) / (earth + height);
    const Amounts here = density(height);
    const SkySpectrum lit = sun(height, cosine, haze_share), again = further.at(height, cosine);
    for_each_wavelength([&](std::size_t w) {
      const double by_molecules = molecules_[w] * here.molecules, haze = haze_[w] * here.haze;
      const double extinction = by_molecules + haze * haze_share + ozone_[w] * here.ozone + 1e-12;
      const double through = std::exp(-extinction * part.length), met = left[w] * (1 - through) / extinction;
      result.by_molecules[w] += met * by_molecules * lit[w];
      result.by_haze[w] += met * haze * haze_albedo * lit[w];
      result.further[w] += met * (by_molecules + haze * haze_scattering) * again[w];
      left[w] *= through;
    });
  }
  return result;
}

Rgb<double> kilocandela(const SkySpectrum& radiance) {
  double x = 0, y = 0, z = 0;
  for_each_wavelength([&](std::size_t i) {
    const double w = wavelength_of(i), lumens = 683 * step * radiance[i];  // per nm times 1000: thousands
    x += lumens *
         (1.056 * lobe(w, 599.8, 37.9, 31.0) + 0.362 * lobe(w, 442.0, 16.0, 26.7) - 0.065 * lobe(w, 501.1, 20.4, 26.2));
    y += lumens * (0.821 * lobe(w, 568.8, 46.9, 40.5) + 0.286 * lobe(w, 530.9, 16.3, 31.1));
    z += lumens * (1.217 * lobe(w, 437.0, 11.8, 36.0) + 0.681 * lobe(w, 459.0, 26.0, 13.8));
  });
  return {3.2404542 * x - 1.5371385 * y - 0.4985314 * z, -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
          0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
}

SkySpectrum reflectance_spectrum(const Rgb<double>& color) {
  SkySpectrum result{};
  for_each_wavelength([&](std::size_t i) {
    const double w = wavelength_of(i);
    const double red = std::clamp((w - 0.57) / 0.03, 0.0, 1.0), blue = std::clamp((0.505 - w) / 0.03, 0.0, 1.0);
    result[i] = color.red * red + color.green * (1 - red - blue) + color.blue * blue;
  });
  return result;
}

}  // namespace raytrace
