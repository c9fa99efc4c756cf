// What a boundary reflects with a film on it that is about as thin as light's waves are long: light from its upper and
// its lower side interferes, to and fro again and again (Airy's sum), and a sum of the spectrum leaves colours.
//
// The spectral integral is analytic, after Belcour and Barla, "A Practical Extension to Microfacet Theory for the
// Modeling of Varying Iridescence", 2017: what red, green and blue weigh of the spectrum is a sum of Gaussians of the
// wavenumber, and a Gaussian damps the m-th cosine of Airy's series by exp(-m^2 a). Two things differ. The Gaussians
// are fitted to linear sRGB itself and not to XYZ, so that each channel has what the base reflects of that channel.
// And the series is not cut off: with exp(-m a) in place of exp(-m^2 a) it is Poisson's kernel, which has a closed form
// that no film lets reflect more than all, and is exact for thin films (a = 0: without a thickness, it is what the
// boundary reflects alone) and for thick ones; the second term and the third are put right.
#pragma once

#include <array>

#include "raytrace/bsdfs/fresnel.h"
#include "raytrace/math/color.h"
#include "raytrace/math/rgba.h"
#include "raytrace/math/turns.h"

namespace raytrace {

namespace detail {

/// A part of what the channels weigh of the spectrum, by wavenumber: the reciprocal of the length of waves in
/// micrometres.
struct SpectralGaussian {
  float mean, deviation;
  std::array<float, 3> share;  ///< of red, green and blue; each one's sum is 1
};

/// Linear sRGB of daylight D65, where white has 1, by the fits of the CIE's 1931 observer of Wyman, Sloan and Shirley,
/// "Simple Analytic Approximations to the CIE XYZ Color Matching Functions", 2013. Least squares of the Fourier
/// transforms: within 0.015 in red and 0.017 in green, 0.037 in blue, of 1 at thickness 0.
inline constexpr std::array<SpectralGaussian, 5> spectral_gaussians{{
    {1.63139301F, 0.06596894F, {0.9013187F, -0.18826088F, 0.01500862F}},
    {1.73423061F, 0.09311861F, {1.41261516F, -0.18208441F, -0.05729953F}},
    {1.82400627F, 0.12059645F, {-1.35125171F, 1.46374337F, -0.08675854F}},
    {2.11958858F, 0.07702157F, {-0.09873232F, 0.02573856F, 0.28990879F}},
    {2.23914757F, 0.09330862F, {0.13605017F, -0.11913664F, 0.83914066F}},
}};

}  // namespace detail

namespace detail {

/// For light at an angle. T: a batch.
template <class T>
class Interference {
 public:
  /// cosine: of the light's angle, in [0, 1]. eta, depth: ThinFilm's.
  Interference(const T& cosine, const T& eta, const T& depth)
      : c_(min(max(cosine, T(1e-4F)), T(1))), eta2_(eta * eta), sine2_(T(1) - c_ * c_) {
    g_ = sqrt(max(eta2_ - sine2_, T(1e-8F)));
    across_ = (c_ - g_) / (c_ + g_);
    along_ = (eta2_ * c_ - g_) / (eta2_ * c_ + g_);
    const T path = depth * g_ / eta;
    for (std::size_t i = 0; i < gaussians; ++i) {
      const SpectralGaussian& gaussian = spectral_gaussians[i];
      turn_[i] = sin_cos_of_turns(path * T(gaussian.mean));
      const T angle = path * T(gaussian.deviation * (2 * std::numbers::pi_v<float>));
      damping_[i] = exp(angle * angle * T(-0.5F));
    }
  }

  /// On a clear boundary: what it reflects alone becomes that. eta: the index on its other side, over that on the
  /// light's. It is the same from both sides, at angles that belong together.
  Rgb<T> on_dielectric(const T& eta) const {
    const T eta2 = eta * eta, squared_cosine = eta2 - sine2_, below = sqrt(max(squared_cosine, T(0))), none(0);
    const Rgb<T> s = channels(across_, (g_ - below) / (g_ + below), none);
    const Rgb<T> p = channels(along_, (eta2 * g_ - eta2_ * below) / (eta2 * g_ + eta2_ * below), none);
    const auto all = !(squared_cosine > T(0));
    const auto clamped = [&](const T& a, const T& b) { return select(all, T(1), within((a + b) * T(0.5F))); };
    return {clamped(s.red, p.red), clamped(s.green, p.green), clamped(s.blue, p.blue)};
  }

  /// On a metal. normal: what it reflects straight back without a film; reflectance: at this angle. A colour does not
  /// say how waves turn when they are reflected: here by as much as by measured metals on average (26.6 degrees less
  /// than half a turn, straight on; silver has 41 to 27, gold 43 to 35, iron 20, aluminium 21 to 15). The film's part
  /// is the difference between a metal of such refractive indices with the film and without.
  Rgb<T> on_metal(const Rgb<T>& normal, const Rgb<T>& reflectance) const {
    return {on_metal(normal.red, reflectance.red, 0), on_metal(normal.green, reflectance.green, 1),
            on_metal(normal.blue, reflectance.blue, 2)};
  }

 private:
  static constexpr std::size_t gaussians = spectral_gaussians.size();

  static T within(const T& share) { return min(max(share, T(0)), T(1)); }

  /// The mean over each Gaussian of the light that is not reflected, (1 - x^2) (1 - y^2) / |1 + x y e^(i turn)|^2, of
  /// one polarisation: x the film's upper side, and real and imaginary parts of y, its lower one.
  std::array<T, gaussians> kept(const T& x, const T& y, const T& imaginary) const {
    const T y2 = y * y + imaginary * imaginary, p2 = x * x * y2;
    const T share = (T(1) - x * x) * (T(1) - y2) / max(T(1) - p2, T(1e-6F));
    std::array<T, gaussians> result;
    for (std::size_t i = 0; i < gaussians; ++i) {
      const T &a = damping_[i], a2 = a * a, a3 = a2 * a;
      const T real = x * (y * turn_[i].cosine - imaginary * turn_[i].sine), real2 = real * real;
      const T kernel = (T(1) - a2 * p2) / max(T(1) + a2 * p2 + T(2) * a * real, T(1e-6F));
      const T second = (a2 * a2 - a2) * (T(2) * real2 - p2);
      const T third = (a3 - a3 * a3 * a3) * (T(4) * real2 - T(3) * p2) * real;
      result[i] = share * (kernel + T(2) * (second + third));
    }
    return result;
  }
  static T channel(const std::array<T, gaussians>& kept, std::size_t number) {
    T sum(1);
    for (std::size_t i = 0; i < gaussians; ++i) sum = sum - kept[i] * T(spectral_gaussians[i].share[number]);
    return sum;
  }
  Rgb<T> channels(const T& x, const T& y, const T& imaginary) const {
    const auto of_gaussians = kept(x, y, imaginary);
    return {channel(of_gaussians, 0), channel(of_gaussians, 1), channel(of_gaussians, 2)};
  }

  T on_metal(const T& normal, const T& reflectance, std::size_t number) const {
    constexpr float cosine = 0.894427191F, sine = 0.447213595F;
    const T square = min(max(normal, T(0)), T(1)), size = sqrt(square);
    const T scale = T(1) / (T(1) + square - T(2 * cosine) * size);
    const T n = (T(1) - square) * scale, k = T(2 * sine) * size * scale;
    // The square of its index and, below, its index times the cosine inside, with the imaginary parts.
    const T n2 = n * n - k * k, k2 = T(2) * n * k, z = n2 - sine2_;
    const T z_size = sqrt(z * z + k2 * k2);
    const T b = sqrt(max((z_size + z) * T(0.5F), T(0))), bi = sqrt(max((z_size - z) * T(0.5F), T(0)));
    // (a - b) / (a + b), of complex numbers, as its real and imaginary part.
    const auto ratio = [](const T& a, const T& ai, const T& c, const T& ci) {
      const T real = a + c, imaginary = ai + ci, over = T(1) / max(real * real + imaginary * imaginary, T(1e-12F));
      return std::array{((a - c) * real + (ai - ci) * imaginary) * over,
                        ((ai - ci) * real - (a - c) * imaginary) * over};
    };
    const auto both = [](const auto& y) { return y[0] * y[0] + y[1] * y[1]; };
    const auto across = ratio(g_, T(0), b, bi), along = ratio(n2 * g_, k2 * g_, eta2_ * b, eta2_ * bi);
    const T filmed =
        channel(kept(across_, across[0], across[1]), number) + channel(kept(along_, along[0], along[1]), number);
    const T bare = both(ratio(c_, T(0), b, bi)) + both(ratio(n2 * c_, k2 * c_, b, bi));
    return within(reflectance + (filmed - bare) * T(0.5F));
  }

  T c_, eta2_, sine2_;
  T g_;               ///< the film's index times the cosine in it, over the index on the light's side
  T across_, along_;  ///< what its upper side reflects of the two polarisations
  std::array<SineAndCosine<T>, gaussians> turn_;  ///< of the wave, there and back
  std::array<T, gaussians> damping_;
};

}  // namespace detail

/// A film on a share of a surface. T: a batch, or what records hold.
template <class T>
struct ThinFilm {
  T weight;  ///< that share
  T eta;     ///< its index of refraction, at least 1, over that above it, or over that of the base where light is there
  T depth;   ///< twice its thickness in micrometres, times its index

  /// What a clear boundary reflects at an angle of that cosine, being base_eta of fresnel_reflection().
  Rgb<T> on_dielectric(const T& cosine, const T& base_eta) const {
    const T bare = fresnel_reflection(cosine, base_eta).reflectance;
    return mix({bare, bare, bare}, detail::Interference<T>(cosine, eta, depth).on_dielectric(base_eta), weight);
  }
  /// normal, edge: of f82_reflectance().
  Rgb<T> on_metal(const T& cosine, const Rgb<T>& normal, const Rgb<T>& edge) const {
    const Rgb<T> bare{f82_reflectance(normal.red, edge.red, cosine), f82_reflectance(normal.green, edge.green, cosine),
                      f82_reflectance(normal.blue, edge.blue, cosine)};
    return mix(bare, detail::Interference<T>(cosine, eta, depth).on_metal(normal, bare), weight);
  }
};

}  // namespace raytrace
