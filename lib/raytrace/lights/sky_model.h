// The light of the sky, its sun and the ground below it, of a SkyLight.
#pragma once

#include "raytrace/lights/sky_light.h"
#include "raytrace/output/picture.h"

namespace raytrace {

/// Linear, with the sRGB primaries. A radiance of 1 is 40,000 candela per square metre, so that the sun high in a clear
/// sky gives a white floor about 0.8.
class SkyModel {
 public:
  explicit SkyModel(const SkyLight::Parameters& parameters);

  /// Of the sky, without the sun. direction: of unit length, not below the horizon.
  Rgb<double> sky(const Vec3d& direction) const;

  /// What a surface that faces the sun gets from it.
  Rgb<double> sun() const { return sun_; }

  /// The sky, and the ground as the two light it, as a picture of longitude and latitude (environment_light.h).
  /// threads: so many at most share the work.
  Picture picture(int threads) const;

 private:
  /// Perez' formula: how bright a part of the sky is, relative to others.
  struct Distribution {
    double a, b, c, d, e;
    double at(double cosine, double angle, double cosine_of_angle) const;
  };
  SkyLight::Parameters parameters_;
  Vec3d to_sun_;
  Distribution luminance_, x_, y_;
  double scale_, scale_x_, scale_y_;
  Rgb<double> sun_;
};

}  // namespace raytrace
