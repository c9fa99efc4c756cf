// Wavelengths for paths that come to what disperses light (materials/dispersion.h).
//
// Red, green and blue each weigh the wavelengths by a hat: from 0 up to its top and down to 0 again, on straight lines,
// about where linear sRGB of equal energy has that channel's positive part. A hat is drawn, then a wavelength below it,
// and the channels' weights are their hats over the density of all three: their mean is 1 for each, and their sum 3, so
// that white light stays white, and no light is lost or made.
#pragma once

#include <array>

#include "raytrace/materials/dispersion.h"
#include "raytrace/math/color.h"
#include "raytrace/math/simd.h"

namespace raytrace {

/// What a channel weighs of the wavelengths, which are in micrometres.
struct WavelengthHat {
  float first, top, last;
};

/// Of red, green and blue.
inline constexpr std::array<WavelengthHat, 3> wavelength_hats{
    {{0.552F, 0.605F, 0.68F}, {0.47F, 0.542F, 0.607F}, {0.4F, 0.447F, 0.512F}}};

struct WavelengthSample {
  FloatN deviation;     ///< wavelength_deviation(), never 0
  Rgb<FloatN> weights;  ///< of light at that wavelength
};

/// u: in [0, 1).
inline WavelengthSample sample_wavelength(const FloatN& u) {
  const auto& [red, green, blue] = wavelength_hats;
  const MaskN is_red = u >= FloatN(2.0F / 3), is_blue = u < FloatN(1.0F / 3);
  const auto chosen = [&](float WavelengthHat::* member) {
    return select(is_red, FloatN(red.*member), select(is_blue, FloatN(blue.*member), FloatN(green.*member)));
  };
  const FloatN first = chosen(&WavelengthHat::first), top = chosen(&WavelengthHat::top),
               last = chosen(&WavelengthHat::last);
  // Not at the very ends, where no hat weighs anything.
  const FloatN third = u * FloatN(3) - select(is_red, FloatN(2), select(is_blue, FloatN(0), FloatN(1)));
  const FloatN share = min(max(third, FloatN(1e-6F)), FloatN(1 - 1e-6F)), width = last - first;
  const FloatN wavelength = select(share * width < top - first, first + sqrt(share * width * (top - first)),
                                   last - sqrt((FloatN(1) - share) * width * (last - top)));
  const auto height = [&](const WavelengthHat& hat) {
    const FloatN left = (wavelength - FloatN(hat.first)) * FloatN(1 / (hat.top - hat.first)),
                 right = (FloatN(hat.last) - wavelength) * FloatN(1 / (hat.last - hat.top));
    return max(min(left, right), FloatN(0)) * FloatN(1 / (hat.last - hat.first));
  };
  const Rgb<FloatN> heights{height(red), height(green), height(blue)};
  const FloatN deviation = wavelength_deviation(wavelength);
  return {select(deviation != FloatN(0), deviation, FloatN(1e-9F)),
          heights * (FloatN(3) / (heights.red + heights.green + heights.blue))};
}

}  // namespace raytrace
