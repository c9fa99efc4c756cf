// Dispersion: the index of refraction of what is clear is another for each wavelength.
//
// By Cauchy's equation n = A + B / w^2, so n = n_d + B d, where d = 1 / w^2 - 1 / w_d^2 is how far the wavelength
// deviates from the one that n_d is of: helium's yellow line, 587.6 nm. Abbe's number V = (n_d - 1) / (n_F - n_C), of
// hydrogen's blue and red lines, says how much. So n - 1 is (n_d - 1) (1 + d / (V d_FC)), with d_FC the deviation
// between those two: a factor, whatever n_d is.
#pragma once

namespace raytrace {

/// The deviation of light of that wavelength in micrometres. T: a number, or a batch.
template <class T>
constexpr T wavelength_deviation(const T& wavelength) {
  constexpr double of_yellow = 1 / (0.5876 * 0.5876);
  return T(1) / (wavelength * wavelength) - T(static_cast<float>(of_yellow));
}

/// The part of n - 1 that is added for a deviation of 1. abbe: 0 for none.
constexpr double dispersion_of(double abbe) {
  constexpr double blue_to_red = 1 / (0.4861 * 0.4861) - 1 / (0.6563 * 0.6563);
  return abbe > 0 ? 1 / (abbe * blue_to_red) : 0;
}

/// Wavelengths that paths have, in micrometres.
inline constexpr double shortest_wavelength = 0.4, longest_wavelength = 0.68;

/// Abbe's numbers are at least that. No glass has less than 17.
inline constexpr double least_abbe = 1;

/// Whether something is left of that index at all wavelengths: below 1, it falls where others grow.
constexpr bool has_all_indices(double ior, double abbe) {
  return 1 + (ior - 1) * (1 + dispersion_of(abbe) * wavelength_deviation(shortest_wavelength)) >= 0.05;
}

}  // namespace raytrace
