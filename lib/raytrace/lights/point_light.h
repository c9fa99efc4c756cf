// Point light without fall-off: the same radiance at every distance, as in the seed (Suffern, chapter 14).
//
//   <pointlight>
//     <location x="1" y="5" z="0"/> <scaleradiance>3</scaleradiance> <color red="1" green="1" blue="1"/>
//     <shadows>true</shadows>
//   </pointlight>
#pragma once

#include "raytrace/lights/light.h"
#include "raytrace/parameters/fields.h"

namespace raytrace {

class PointLight {
 public:
  struct Parameters {
    Vec3d location{};
    double scaleradiance = 1;
    Rgb<double> color{1, 1, 1};
    bool shadows = true;
  };
  static constexpr std::string_view group = "pointlights";
  static constexpr std::string_view element = "pointlight";
  static Fields<Parameters> fields();

  explicit PointLight(const Parameters& parameters)
      : location_(parameters.location),
        radiance_(parameters.color * parameters.scaleradiance),
        shadows_(parameters.shadows) {}

  static constexpr bool ambient = false;
  bool shadows() const { return shadows_; }
  Vec3f location() const { return location_; }
  Rgb<float> largest_radiance() const { return radiance_; }

  template <class F>
  LightSample<F> sample(const Vec3<F>& position) const {
    return {Vec3<F>(location_) - position, F(1), Rgb<F>(radiance_)};
  }

 private:
  Vec3f location_;
  Rgb<float> radiance_;
  bool shadows_;
};

}  // namespace raytrace
