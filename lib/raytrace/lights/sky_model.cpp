#include "raytrace/lights/sky_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

#include "raytrace/lights/atmosphere.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

namespace {

using std::numbers::pi;
constexpr double radiance_unit = 40;  ///< thousands of candela per square metre that are a radiance of 1

Rgb<double> positive(const Rgb<double>& color) {
  return {std::max(color.red, 0.0), std::max(color.green, 0.0), std::max(color.blue, 0.0)};
}

Vec3d without_height(const Vec3d& v) {
  const Vec3d level(v.x, 0, v.z);
  return length(level) > 1e-9 ? normalize(level) : Vec3d(0, 0, 1);
}

}  // namespace

Rgb<double> sun_irradiance(const SkyLight::Parameters& parameters) {
  const double scale = parameters.scaleradiance / radiance_unit;
  return positive(kilocandela(Atmosphere(parameters.turbidity).sun(0, normalize(parameters.sundirection).y))) * scale;
}

SkyModel::SkyModel(const SkyLight::Parameters& parameters, int threads)
    : parameters_(parameters),
      threads_(threads),
      to_sun_(normalize(parameters.sundirection)),
      table_(place(heights, 0)) {
  const Atmosphere air(parameters.turbidity);
  const Atmosphere::FurtherScattering further(air, reflectance_spectrum(parameters.groundalbedo), threads);
  const double scale = parameters.scaleradiance / radiance_unit;
  const Vec3d along = without_height(to_sun_), across(along.z, 0, -along.x);
  for_each_index(heights, threads, [&](int row) {
    // Most rows are next to the horizon.
    const double share = static_cast<double>(row) / (heights - 1), height = pi / 2 * share * share;
    for (int column = 0; column < turns; ++column) {
      const double turn = pi * column / (turns - 1);
      const Vec3d direction =
          (along * std::cos(turn) + across * std::sin(turn)) * std::cos(height) + Vec3d(0, std::sin(height), 0);
      const auto [by_molecules, by_haze, more] = air.scattered(direction, to_sun_, further);
      table_[place(row, column)] = {kilocandela(by_molecules) * scale, kilocandela(by_haze) * scale,
                                    kilocandela(more) * scale};
    }
  });
}

Rgb<double> SkyModel::sky(const Vec3d& direction) const {
  const double height = std::asin(std::clamp(direction.y, 0.0, 1.0)),
               turn = std::acos(std::clamp(dot(without_height(direction), without_height(to_sun_)), -1.0, 1.0));
  const double row = std::sqrt(height / (pi / 2)) * (heights - 1), column = turn / pi * (turns - 1);
  const int low = std::min(static_cast<int>(row), heights - 2), left = std::min(static_cast<int>(column), turns - 2);
  const double cosine = std::clamp(dot(direction, to_sun_), -1.0, 1.0),
               of_molecules = Atmosphere::molecule_phase(cosine), of_haze = Atmosphere::haze_phase(cosine);
  const auto at = [&](int i, int k) {
    const Scattered& all = table_[place(i, k)];
    return all.by_molecules * of_molecules + all.by_haze * of_haze + all.further;
  };
  const double up = row - low, right = column - left;
  return positive((at(low, left) * (1 - right) + at(low, left + 1) * right) * (1 - up) +
                  (at(low + 1, left) * (1 - right) + at(low + 1, left + 1) * right) * up);
}

Picture SkyModel::picture() const {
  constexpr int width = 1024, height = 512;
  Picture result{width, height, 4, TexelFormat::floats,
                 LargeArray<std::byte>::unset(std::size_t{width} * height * 4 * sizeof(float))};
  const auto put = [&](int row, int column, const Rgb<double>& color) {
    const std::array<float, 4> texel{static_cast<float>(color.red), static_cast<float>(color.green),
                                     static_cast<float>(color.blue), 1};
    const std::size_t at = static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
    std::memcpy(result.pixels.data() + at * sizeof texel, texel.data(), sizeof texel);
  };
  std::vector<Rgb<double>> arriving(height / 2, Rgb<double>(0, 0, 0));  // at the ground, from each row
  for_each_index(height / 2, threads_, [&](int row) {
    const double angle = pi * (row + 0.5) / height, sine = std::sin(angle), cosine = std::cos(angle);
    Rgb<double> sum(0, 0, 0);
    for (int column = 0; column < width; ++column) {
      const double longitude = 2 * pi * ((column + 0.5) / width - 0.5);
      const Rgb<double> color = sky({-sine * std::sin(longitude), cosine, sine * std::cos(longitude)});
      put(row, column, color);
      sum += color;
    }
    arriving[static_cast<std::size_t>(row)] = sum * (2 * pi * pi / (double{width} * height) * sine * cosine);
  });
  Rgb<double> all = sun_irradiance(parameters_) * to_sun_.y;
  for (const Rgb<double>& part : arriving) all += part;
  const Rgb<double> ground = parameters_.groundalbedo * all * (1 / pi);
  for (int row = height / 2; row < height; ++row)
    for (int column = 0; column < width; ++column) put(row, column, ground);
  return result;
}

}  // namespace raytrace
