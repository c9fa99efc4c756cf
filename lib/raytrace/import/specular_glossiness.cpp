#include "raytrace/import/specular_glossiness.h"

#include <algorithm>
#include <cmath>

namespace raytrace {
namespace {

constexpr double dielectric = 0.04;  // of index 1.5, straight on

double brightness(const Rgb<double>& c) {
  return std::sqrt(0.299 * c.red * c.red + 0.587 * c.green * c.green + 0.114 * c.blue * c.blue);
}

/// The share m of a metal of colour c with m c + (1 - m) dielectric = specular and (1 - m) c = diffuse.
double metalness_of(double diffuse, double specular) {
  if (specular < dielectric) return 0;
  const double b = diffuse + specular - 2 * dielectric, c = dielectric - specular;
  const double root = std::sqrt(std::max(b * b - 4 * dielectric * c, 0.0));
  return std::clamp((root - b) / (2 * dielectric), 0.0, 1.0);
}

}  // namespace

MetalShare metal_share(const Rgb<double>& diffuse, const Rgb<double>& specular) {
  constexpr double least = 1e-6;
  const double left = 1 - std::max({specular.red, specular.green, specular.blue}), mirrored = brightness(specular);
  const Rgb<double> scattered = diffuse * (left / (1 - dielectric));
  const double metalness = metalness_of(brightness(scattered), mirrored);
  const auto base = [&](double of_diffuse, double of_specular) {
    const double by_diffuse = of_diffuse / std::max(1 - metalness, least);
    const double by_specular = (of_specular - dielectric * (1 - metalness)) / std::max(metalness, least);
    const double part = metalness * metalness;
    return std::clamp(by_diffuse * (1 - part) + by_specular * part, 0.0, 1.0);
  };
  return {
      {base(scattered.red, specular.red), base(scattered.green, specular.green), base(scattered.blue, specular.blue)},
      metalness,
      std::min(mirrored / dielectric, 1.0)};
}

}  // namespace raytrace
