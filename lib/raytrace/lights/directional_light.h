// Directional light: parallel rays from infinitely far (Suffern, chapter 14).
//
//   <directionallight>
//     <direction x="1" y="1" z="0"/> <scaleradiance>3</scaleradiance> <color red="1" green="1" blue="1"/>
//     <shadows>true</shadows>
//   </directionallight>
#pragma once

#include <limits>

#include "raytrace/lights/light.h"
#include "raytrace/parameters/fields.h"

namespace raytrace {

class DirectionalLight {
 public:
  struct Parameters {
    Vec3d direction{};  ///< from the scene towards the light; any length but 0
    double scaleradiance = 1;
    Rgb<double> color{1, 1, 1};
    bool shadows = true;
  };
  static constexpr std::string_view group = "directionallights";
  static constexpr std::string_view element = "directionallight";
  static Fields<Parameters> fields();

  explicit DirectionalLight(const Parameters& parameters)
      : direction_(normalize(parameters.direction)),
        radiance_(parameters.color * parameters.scaleradiance),
        shadows_(parameters.shadows) {}

  static constexpr bool ambient = false;
  bool shadows() const { return shadows_; }
  Vec3f direction() const { return direction_; }
  Rgb<float> largest_radiance() const { return radiance_; }

  template <class F>
  LightSample<F> sample(const Vec3<F>&) const {
    return {Vec3<F>(direction_), F(std::numeric_limits<float>::infinity()), Rgb<F>(radiance_)};
  }

 private:
  Vec3f direction_;
  Rgb<float> radiance_;
  bool shadows_;
};

}  // namespace raytrace
