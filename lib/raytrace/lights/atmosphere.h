// The air over the ground: what it takes away of sunlight, and what it scatters.
//
// Molecules, haze and ozone in layers around a round Earth. Sunlight that is scattered once is integrated along each
// ray; all further scatterings come from a table of their mean over all directions (Hillaire, "A Scalable and
// Production Ready Sky and Atmosphere Rendering Technique", EGSR 2020). What haze sends straight on counts there as not
// scattered (Nakajima and Tanaka, "Algorithms for radiative intensity calculations in moderately thick atmospheres
// using a truncation approximation", 1988). The air is that of Bruneton, "A Qualitative and Quantitative Evaluation of
// 8 Clear Sky Models", 2017.
#pragma once

#include <array>
#include <vector>

#include "raytrace/math/color.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

/// At the wavelengths 400, 420 ... 700 nm.
using SkySpectrum = std::array<double, 16>;

/// Lengths are in kilometres, irradiances in W/m^2/nm, and radiances per steradian.
class Atmosphere {
 public:
  /// turbidity: 1 is pure air; by each 1 more, haze takes 5 per cent of green light that comes straight down.
  explicit Atmosphere(double turbidity);

  /// Of the sun, on a surface that faces it. cosine: between up and the sun.
  SkySpectrum sun(double height, double cosine) const;

  /// What comes to the ground along a ray of sky, in parts that depend on the angle between ray and sun by a factor.
  struct Scattered {
    SkySpectrum by_molecules, by_haze;  ///< once: times molecule_phase() and haze_phase()
    SkySpectrum further;                ///< more than once: as it is
  };
  static double molecule_phase(double cosine);
  static double haze_phase(double cosine);

  /// What light brings that is scattered more than once, for each unit of scattering, by height and the sun's cosine.
  class FurtherScattering {
   public:
    /// albedo: of the ground. threads: so many at most share the work.
    FurtherScattering(const Atmosphere& air, const SkySpectrum& albedo, int threads);
    SkySpectrum at(double height, double cosine) const;

   private:
    static constexpr int heights = 12, cosines = 24;
    static constexpr std::size_t place(int height, int cosine) {
      return static_cast<std::size_t>(height) * cosines + static_cast<std::size_t>(cosine);
    }
    std::vector<SkySpectrum> table_;
  };

  /// From the ground, where up is +y. Neither of the unit vectors points below the horizon.
  Scattered scattered(const Vec3d& direction, const Vec3d& to_sun, const FurtherScattering& further) const;

 private:
  /// Molecules, haze and ozone: their densities, or how much of them is on a way, each in units of what there is at
  /// the ground (of ozone, where there is most).
  struct Amounts {
    double molecules = 0, haze = 0, ozone = 0;
  };
  static Amounts density(double height);
  /// Up to where the air ends, as long as the Earth is not in the way; else nothing.
  static bool amounts_above(double height, double cosine, Amounts& amounts);

  /// With that share of the haze.
  SkySpectrum sun(double height, double cosine, double share_of_haze) const;

  SkySpectrum molecules_, haze_, ozone_;  ///< extinction per kilometre at density 1
};

/// Linear light with the sRGB primaries, where luminance is in thousands of candela per square metre, by the fits of
/// the CIE's 1931 observer of Wyman, Sloan and Shirley, "Simple Analytic Approximations to the CIE XYZ Color Matching
/// Functions", 2013. Saturated colours have negative components.
Rgb<double> kilocandela(const SkySpectrum& radiance);

/// A reflectance that the eye takes for that colour.
SkySpectrum reflectance_spectrum(const Rgb<double>& color);

}  // namespace raytrace
