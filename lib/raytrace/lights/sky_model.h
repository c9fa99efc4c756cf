// The light of the sky, its sun and the ground below it, of a SkyLight.
#pragma once

#include <vector>

#include "raytrace/lights/sky_light.h"
#include "raytrace/output/picture.h"

namespace raytrace {

// Light is linear, with the sRGB primaries. A radiance of 1 is 40,000 candela per square metre, so that the sun high in
// a clear sky gives a white floor about 0.8.

/// What a surface that faces the sun gets from it.
Rgb<double> sun_irradiance(const SkyLight::Parameters& parameters);

class SkyModel {
 public:
  /// threads: so many at most share the work, of some hundredths of a second.
  SkyModel(const SkyLight::Parameters& parameters, int threads);

  /// Of the sky, without the sun. direction: of unit length, not below the horizon.
  Rgb<double> sky(const Vec3d& direction) const;

  /// The sky, and the ground as the two light it, as a picture of longitude and latitude (environment_light.h).
  Picture picture() const;

 private:
  /// What atmosphere.h has of a ray, as colours.
  struct Scattered {
    Rgb<double> by_molecules, by_haze, further;
  };

  static constexpr int heights = 48, turns = 17;  ///< above the horizon, and from the sun's side to the other
  static constexpr std::size_t place(int height, int turn) {
    return static_cast<std::size_t>(height) * turns + static_cast<std::size_t>(turn);
  }

  SkyLight::Parameters parameters_;
  int threads_;
  Vec3d to_sun_;
  std::vector<Scattered> table_;
};

}  // namespace raytrace
