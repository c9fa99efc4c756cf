#include "raytrace/lights/sky_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <vector>

#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double radiance_unit = 40;  ///< thousands of candela per square metre that are a radiance of 1

/// Of what the sun sends before the air takes some away, on a surface that faces it: thousands of lux.
constexpr double sun_illuminance = 127.5;

/// CIE 1931 xy and luminance to linear light with the sRGB primaries.
Rgb<double> from_chromaticity(double luminance, double x, double y) {
  const double big_x = luminance * x / y, big_z = luminance * (1 - x - y) / y;
  return {std::max(3.2404542 * big_x - 1.5371385 * luminance - 0.4985314 * big_z, 0.0),
          std::max(-0.9692660 * big_x + 1.8760108 * luminance + 0.0415560 * big_z, 0.0),
          std::max(0.0556434 * big_x - 0.2040259 * luminance + 1.0572252 * big_z, 0.0)};
}

double cubic(const std::array<double, 4>& c, double t) { return ((c[0] * t + c[1]) * t + c[2]) * t + c[3]; }

/// What is left of sunlight behind the air: molecules and haze (Preetham et al., appendix A.1), at one wavelength for
/// each of red, green and blue, in micrometres; and ozone, by its absorption there.
Rgb<double> transmittance(double turbidity, double sun_angle) {
  const double degrees = sun_angle * 180 / pi;
  const double mass = 1 / (std::cos(sun_angle) + 0.15 * std::pow(93.885 - degrees, -1.253));
  const double haze = 0.04608 * turbidity - 0.04586;
  const auto channel = [&](double wavelength, double ozone) {
    return std::exp(-mass * (0.008735 * std::pow(wavelength, -4.08) + haze * std::pow(wavelength, -1.3) + ozone));
  };
  return {channel(0.61, 0.042), channel(0.55, 0.030), channel(0.465, 0.003)};
}

}  // namespace

double SkyModel::Distribution::at(double cosine, double angle, double cosine_of_angle) const {
  return (1 + a * std::exp(b / std::max(cosine, 0.01))) *
         (1 + c * std::exp(d * angle) + e * cosine_of_angle * cosine_of_angle);
}

SkyModel::SkyModel(const SkyLight::Parameters& parameters)
    : parameters_(parameters), to_sun_(normalize(parameters.sundirection)) {
  const double t = parameters.turbidity, angle = std::acos(std::min(to_sun_.y, 1.0)), cosine = to_sun_.y;
  luminance_ = {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                -0.0670 * t + 0.3703};
  x_ = {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989, -0.0033 * t + 0.0452};
  y_ = {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537, -0.0109 * t + 0.0529};
  // Of the zenith.
  const double chi = (4.0 / 9 - t / 120) * (pi - 2 * angle);
  const double luminance = std::max((4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192, 0.0);
  const double x = t * t * cubic({0.00166, -0.00375, 0.00209, 0}, angle) +
                   t * cubic({-0.02903, 0.06377, -0.03202, 0.00394}, angle) +
                   cubic({0.11693, -0.21196, 0.06052, 0.25886}, angle);
  const double y = t * t * cubic({0.00275, -0.00610, 0.00317, 0}, angle) +
                   t * cubic({-0.04214, 0.08970, -0.04153, 0.00516}, angle) +
                   cubic({0.15346, -0.26756, 0.06670, 0.26688}, angle);
  scale_ = luminance / luminance_.at(1, angle, cosine) / radiance_unit * parameters.scaleradiance;
  scale_x_ = x / x_.at(1, angle, cosine);
  scale_y_ = y / y_.at(1, angle, cosine);
  sun_ = transmittance(t, angle) * (sun_illuminance / radiance_unit * parameters.scaleradiance);
}

Rgb<double> SkyModel::sky(const Vec3d& direction) const {
  const double to_sun = std::clamp(dot(direction, to_sun_), -1.0, 1.0), angle = std::acos(to_sun);
  const auto at = [&](const Distribution& distribution) { return distribution.at(direction.y, angle, to_sun); };
  return from_chromaticity(scale_ * at(luminance_), scale_x_ * at(x_), scale_y_ * at(y_));
}

Picture SkyModel::picture(int threads) const {
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
  for_each_index(height / 2, threads, [&](int row) {
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
  Rgb<double> all = sun_ * to_sun_.y;
  for (const Rgb<double>& part : arriving) all += part;
  const Rgb<double> ground = parameters_.groundalbedo * all * (1 / pi);
  for (int row = height / 2; row < height; ++row)
    for (int column = 0; column < width; ++column) put(row, column, ground);
  return result;
}

}  // namespace raytrace
