#include "raytrace/output/view_transform.h"

#include <algorithm>
#include <cmath>

#include "raytrace/math/color_matrix.h"

namespace raytrace {

namespace {

template <class Function>
Rgb<double> each(const Rgb<double>& color, const Function& f) {
  return {f(color.red), f(color.green), f(color.blue)};
}

// The Khronos PBR Neutral Tone Mapper, https://github.com/KhronosGroup/ToneMapping/tree/main/PBR_Neutral, with the
// names of its specification: base colours are shown as they are, less what glossy surfaces reflect of white
// surroundings.

constexpr double f90 = 0.04;      // reflectance of an index of 1.5, seen head-on
constexpr double ks = 0.8 - f90;  // where the highlights' compression starts
constexpr double kd = 0.15;       // how fast what is brighter loses its colour

Rgb<double> khronos_neutral(const Rgb<double>& color) {
  const double x = std::min({color.red, color.green, color.blue});
  const double f = x <= 2 * f90 ? x - x * x / (4 * f90) : f90;
  const Rgb<double> rest = each(color, [&](double c) { return c - f; });
  const double p = std::max({rest.red, rest.green, rest.blue});
  if (p <= ks) return rest;
  const double pn = 1 - (1 - ks) * (1 - ks) / (p + 1 - 2 * ks);
  const double g = 1 / (kd * (p - pn) + 1);
  return each(rest, [&](double c) { return c * (pn / p) * g + pn * (1 - g); });
}

// AgX: Troy Sobotka's, with the primaries and the curve that Blender has it with (its view "AgX", without a look:
// https://github.com/EaryChow/AgX_LUT_Gen, AgXBaseRec2020.py and sigmoid.py, after Sobotka's SB2383). The inset turns
// and draws in Rec. 2020's primaries, so that bright colours go to white on their way; each then goes through one curve
// over the logarithm, from 10 stops below 0.18 to 6.5 above, which leaves 0.18 as it is; the outset gives back colour.
// Without what Blender's table adds: the hue is the curve's, and what is outside of Rec. 709 is clipped.

constexpr ColorMatrix rec2020_of_rec709{{{0.627403895934699, 0.329283038377884, 0.043313065687417},
                                         {0.069097289358232, 0.919540395075459, 0.011362315566309},
                                         {0.016391438875150, 0.088013307877226, 0.895595253247624}}};
constexpr ColorMatrix rec709_of_rec2020{{{1.660491002108435, -0.587641138788550, -0.072849863319885},
                                         {-0.124550474521591, 1.132899897125960, -0.008349422604369},
                                         {-0.018150763354905, -0.100578898008007, 1.118729661362913}}};
constexpr ColorMatrix inset{{{0.856627153315983, 0.0951212405381588, 0.0482516061458583},
                             {0.137318972929847, 0.761241990602591, 0.101439036467562},
                             {0.11189821299995, 0.0767994186031903, 0.811302368396859}}};
/// What the outset undoes.
constexpr ColorMatrix milder_inset{{{0.899796955911611, 0.0871996192028351, 0.013003424885555},
                                    {0.11142098895748, 0.875575586156966, 0.0130034248855548},
                                    {0.11142098895748, 0.0871996192028349, 0.801379391839686}}};

constexpr ColorMatrix outset = inverse(milder_inset);

constexpr double stops_below = 10, stops_above = 6.5, middle_grey = 0.18;
constexpr double slope = 2.4, power = 1.5, display_power = 2.4;

/// Jed Smith's sigmoid of [0, 1]: through (0, 0), (1, 1) and the pivot, with that slope there.
double sigmoid(double x) {
  if (x <= 0 || x >= 1) return x <= 0 ? 0 : 1;  // without a rounding error
  constexpr double pivot_x = stops_below / (stops_below + stops_above);
  static const double pivot_y = std::pow(middle_grey, 1 / display_power);
  // Between the pivot and an end that is so far from it.
  const auto scale = [](double run, double rise) {
    return std::pow(std::pow(slope * run, -power) * (std::pow(slope * run / rise, power) - 1), -1 / power);
  };
  static const double toe = scale(pivot_x, pivot_y), shoulder = scale(1 - pivot_x, 1 - pivot_y);
  const double size = x < pivot_x ? toe : shoulder;
  const double t = slope * std::abs(x - pivot_x) / size;
  const double rise = size * t / std::pow(1 + std::pow(t, power), 1 / power);
  return x < pivot_x ? std::max(pivot_y - rise, 0.0) : pivot_y + rise;
}

Rgb<double> agx(const Rgb<double>& color) {
  const Rgb<double> formed = each(product(inset, product(rec2020_of_rec709, color)), [](double c) {
    const double stops = std::clamp(std::log2(std::max(c / middle_grey, 1e-300)), -stops_below, stops_above);
    return std::pow(sigmoid((stops + stops_below) / (stops_below + stops_above)), display_power);
  });
  return each(product(rec709_of_rec2020, product(outset, formed)), [](double c) { return std::clamp(c, 0.0, 1.0); });
}

}  // namespace

Rgb<double> view_transformed(ViewTransform transform, const Rgb<double>& color) {
  if (transform == ViewTransform::srgb) return color;
  const Rgb<double> positive = each(color, [](double c) { return std::max(c, 0.0); });
  return transform == ViewTransform::agx ? agx(positive) : khronos_neutral(positive);
}

}  // namespace raytrace
