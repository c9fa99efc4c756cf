// What is below the surface of materials that light goes into and comes out of elsewhere: skin, wax, marble, milk.
#pragma once

#include "raytrace/math/color.h"
#include "raytrace/math/simd.h"

namespace raytrace {

/// T: a batch.
template <class T>
struct Subsurface {
  Rgb<T> albedo;     ///< of one scattering
  Rgb<T> free_path;  ///< the mean free path
  T anisotropy;      ///< of Henyey and Greenstein's phase function: the mean cosine between the ways before and after
  Mask<T> is_sheet;  ///< it has no depth: what goes in comes out on the other side

  /// color: the share of evenly spread light that comes out again from below a plane. By van de Hulst's approximation,
  /// as it is inverted in OpenPBR 1.1.1, "Subsurface".
  static Subsurface of(const Rgb<T>& color, const Rgb<T>& free_path, const T& anisotropy, const Mask<T>& is_sheet) {
    // Beyond that, light of one direction would go on in one direction.
    const T g = min(max(anisotropy, T(-0.98F)), T(0.98F));
    const auto of_channel = [&](const T& given) {
      const T c = min(max(given, T(0)), T(1));
      const T s = T(4.09712F) + T(4.20863F) * c - sqrt(T(9.59217F) + T(41.6808F) * c + T(17.7126F) * c * c);
      const T s2 = max(s, T(0)) * max(s, T(0));
      return (T(1) - s2) / (T(1) - g * s2);
    };
    return {{of_channel(color.red), of_channel(color.green), of_channel(color.blue)}, free_path, g, is_sheet};
  }
};

}  // namespace raytrace
