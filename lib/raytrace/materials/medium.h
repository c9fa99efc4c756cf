// What clear materials and fogs have inside.
#pragma once

#include "raytrace/math/color.h"

namespace raytrace {

struct Medium {
  float ior = 1;  ///< index of refraction
  int priority = 0;
  Rgb<float> extinction{0, 0, 0};  ///< for a unit of length
  float dispersion = 0;            ///< dispersion_of()
  Rgb<float> scattering{0, 0, 0};  ///< for a unit of length; a part of the extinction
  float anisotropy = 0;            ///< of the scattering, as Subsurface has it
  Rgb<float> emission{0, 0, 0};    ///< of fog: the radiance of so much that nothing shines through

  /// Fog counts less than all that has a surface.
  static constexpr int fog_priority = -1;
  bool is_fog() const { return priority == fog_priority; }
};

/// The indices of refraction on both sides of a surface, for each lane's light. T: a batch.
template <class T>
struct Refraction {
  T outside = T(1);
  T factor = T(1);         ///< of n - 1 inside, where the material says n
  bool disperses = false;  ///< whether factors may differ from 1; the same for all of a scene

  Refraction() = default;
  Refraction(const T& index_outside) : outside(index_outside) {}  // implicit: nothing disperses

  /// n: the material's, of yellow light.
  T inside(const T& n) const { return disperses ? T(1) + (n - T(1)) * factor : n; }
};

}  // namespace raytrace
