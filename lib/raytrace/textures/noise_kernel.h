// Gradient noise.
#pragma once

#include <algorithm>

#include "raytrace/math/kernel.h"
#include "raytrace/math/rgba.h"
#include "raytrace/math/simd.h"
#include "raytrace/textures/noise.h"
#include "raytrace/textures/texture_point.h"

namespace raytrace {

/// Each depends on all of `number`.
template <class U>
U lattice_bits(U number) {
  number = (number ^ (number >> 15)) * U(0x7feb352dU);
  number = (number ^ (number >> 13)) * U(0x846ca68bU);
  return number ^ (number >> 16);
}

/// Between -1 and 1, and 0 in all points of whole coordinates, which follow each other by 1.
template <class F>
F gradient_noise(const Vec3<F>& p) {
  const Vec3<F> corner{floor(p.x), floor(p.y), floor(p.z)};
  const Vec3<F> in_cell = p - corner;
  const auto whole = [](const F& x) { return same_bits<Uints<F>>(to_int(x)); };
  const Uints<F> x = whole(corner.x), y = whole(corner.y), z = whole(corner.z);
  // The gradient at a corner, times the way from it: one of the twelve towards the middles of a cube's edges.
  const auto slope = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k) {
    const Uints<F> bits =
        lattice_bits<Uints<F>>((x + Uints<F>(i)) * Uints<F>(0x9e3779b1U) ^ (y + Uints<F>(j)) * Uints<F>(0x85ebca77U) ^
                               (z + Uints<F>(k)) * Uints<F>(0xc2b2ae3dU));
    const auto bit = [&](std::uint32_t number) { return float_mask<F>((bits & Uints<F>(number)) == Uints<F>(number)); };
    const F a = in_cell.x - F(static_cast<float>(i)), b = in_cell.y - F(static_cast<float>(j)),
            c = in_cell.z - F(static_cast<float>(k));
    const F first = select(bit(1), a, b);
    const F second = select(bit(2), c, select(bit(1), b, a));
    return select(bit(4), -first, first) + select(bit(8), -second, second);
  };
  const auto fade = [](const F& t) { return t * t * t * (t * (t * F(6) - F(15)) + F(10)); };
  const F u = fade(in_cell.x), v = fade(in_cell.y), w = fade(in_cell.z);
  const auto row = [&](std::uint32_t j, std::uint32_t k) { return mix(slope(0, j, k), slope(1, j, k), u); };
  return mix(mix(row(0, 0), row(1, 0), v), mix(row(0, 1), row(1, 1), v), w);
}

template <>
class Kernel<Noise> {
 public:
  explicit Kernel(const Noise::Parameters& noise)
      : color1_(noise.color1),
        color2_(noise.color2),
        frequency_(static_cast<float>(1 / noise.scale)),
        octaves_(noise.octaves),
        space_(noise.space) {}

  TextureSpace space() const { return space_; }

  float largest() const {
    const Rgb<float> both = max(abs(color1_), abs(color2_));
    return std::max({both.red, both.green, both.blue});
  }

  Rgba<FloatN> at(const TexturePoint<FloatN>& point) const {
    const auto& [at, across, along] = point.in(space_);
    const FloatN width = sqrt(max(dot(across, across), dot(along, along)));
    FloatN sum = FloatN(0);
    float frequency = frequency_, strength = 0.5F;
    for (int octave = 0; octave < octaves_; ++octave, frequency *= 2, strength *= 0.5F) {
      // Its mean is 0: it is gone where half of what a pixel covers is as wide as a cloud.
      const FloatN visible = min(max(FloatN(2) - FloatN(2) * width * FloatN(frequency), FloatN(0)), FloatN(1));
      if (none(visible > FloatN(0))) break;
      // Shifted, so that the octaves are not all 0 at the same points.
      const Vec3<FloatN> p = at * FloatN(frequency) + Vec3<FloatN>(Vec3f(0.37F, 0.59F, 0.83F));
      sum = sum + select(visible > FloatN(0), gradient_noise(p) * visible * FloatN(strength), FloatN(0));
    }
    const FloatN second = min(max(FloatN(0.5F) + sum, FloatN(0)), FloatN(1));
    return {mix(Rgb<FloatN>(color1_), Rgb<FloatN>(color2_), second), FloatN(1)};
  }

 private:
  Rgb<float> color1_, color2_;
  float frequency_;
  int octaves_;
  TextureSpace space_;
};

}  // namespace raytrace
