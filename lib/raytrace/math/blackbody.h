// The colours of black bodies, by which white light is named: a candle's 1,900 K, a lamp's 2,700, the sun's 5,500.
#pragma once

#include <algorithm>
#include <cstddef>

#include "raytrace/math/color.h"
#include "raytrace/math/color_matrix.h"

namespace raytrace {

/// In kelvin: for which the functions below hold.
inline constexpr double least_temperature = 1000, most_temperature = 15000;
inline bool is_temperature(double kelvin) { return kelvin >= least_temperature && kelvin <= most_temperature; }

namespace detail {

inline constexpr ColorMatrix rec709_of_xyz{{{3.2409699419045213, -1.5373831775700932, -0.4986107602930032},
                                            {-0.9692436362808794, 1.8759675015077202, 0.04155505740717556},
                                            {0.055630079696993594, -0.20397695888897646, 1.0569715142428784}}};
inline constexpr ColorMatrix cones_of_rec709{{{0.4226580414464341, 0.4913566407473868, 0.027364497137486118},
                                              {0.05569079999837241, 0.9615562080812273, 0.023189374899123684},
                                              {0.02137924113882071, 0.08764392158298846, 0.9807434330228718}}};

/// The same with parts below 0.
inline Rgb<double> unclipped_color(double kelvin) {
  const double t = kelvin;
  const double u =
      (0.860117757 + t * (1.54118254e-4 + t * 1.28641212e-7)) / (1 + t * (8.42420235e-4 + t * 7.08145163e-7));
  const double v =
      (0.317398726 + t * (4.22806245e-5 + t * 4.20481691e-8)) / (1 + t * (-2.89741816e-5 + t * 1.61456053e-7));
  // x = 3u / (2u - 8v + 4), y = 2v / (2u - 8v + 4); X = x / y, Z = (1 - x - y) / y
  return product(rec709_of_xyz, {3 * u / (2 * v), 1, (4 - u - 10 * v) / (2 * v)});
}

}  // namespace detail

/// In linear Rec. 709, with a luminance of 1, which is 0.2126 red + 0.7152 green + 0.0722 blue. Below 1,900 K it is
/// more orange than Rec. 709 has colours: blue then is 0. As Krystek, An algorithm to calculate correlated colour
/// temperature (1985), has it: within 0.0001 of Planck's law in the CIE's u and v of 1960.
inline Rgb<double> blackbody_color(double kelvin) {
  const auto positive = [](double part) { return std::max(part, 0.0); };
  const Rgb<double> whole = detail::unclipped_color(kelvin);
  const Rgb<double> color{positive(whole.red), positive(whole.green), positive(whole.blue)};
  const double luminance = 0.2126 * color.red + 0.7152 * color.green + 0.0722 * color.blue;
  return color * (1 / luminance);
}

/// What makes the light of a black body white: of linear Rec. 709. Von Kries' rule in the cones of Bradford (Lam,
/// 1985), from that light, with a luminance of 1, to D65.
inline ColorMatrix white_balance(double kelvin) {
  const Rgb<double> from = product(detail::cones_of_rec709, detail::unclipped_color(kelvin));
  const Rgb<double> gain = product(detail::cones_of_rec709, {1, 1, 1}) / from;
  ColorMatrix matrix = detail::cones_of_rec709;
  for (std::size_t column = 0; column < 3; ++column) {
    const Rgb<double> cones{matrix[0][column], matrix[1][column], matrix[2][column]};
    const Rgb<double> balanced = product(inverse(detail::cones_of_rec709), cones * gain);
    matrix[0][column] = balanced.red;
    matrix[1][column] = balanced.green;
    matrix[2][column] = balanced.blue;
  }
  return matrix;
}

}  // namespace raytrace
