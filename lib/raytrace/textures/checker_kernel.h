// Checkers, filtered in closed form.
#pragma once

#include <algorithm>
#include <cmath>

#include "raytrace/math/kernel.h"
#include "raytrace/math/rgba.h"
#include "raytrace/math/simd.h"
#include "raytrace/textures/checker.h"
#include "raytrace/textures/texture_point.h"

namespace raytrace {

/// The mean over [x - width / 2, x + width / 2] of what is 1 from 0 to 1, -1 from 1 to 2, and so on.
template <class F>
F mean_square_wave(const F& x, const F& wanted_width) {
  const F width = min(max(wanted_width, F(1e-6F)), F(1e6F));
  const F half = floor(x), period = x - F(2) * floor(x * F(0.5F));
  const F to_edge = F(0.5F) - abs(x - half - F(0.5F));
  const F sign = select(period < F(1), F(1), F(-1));
  const F narrow = sign * min(to_edge * F(2) / width, F(1));  // there is no more than one edge in it
  // The integral from 0 is a triangle: as high as the distance to the nearest even number.
  const auto integral = [](const F& to) { return abs(to - F(2) * floor(to * F(0.5F) + F(0.5F))); };
  const F wide = (integral(period + width * F(0.5F)) - integral(period - width * F(0.5F))) / width;
  return select(width < F(1), narrow, wide);
}

template <>
class Kernel<Checker> {
 public:
  explicit Kernel(const Checker::Parameters& checker)
      : color1_(checker.color1),
        color2_(checker.color2),
        uvscale_{static_cast<float>(checker.uvscale.x), static_cast<float>(checker.uvscale.y)},
        uvset_(checker.uvset),
        space_(checker.space),
        in_space_(checker.scale > 0),
        frequency_(in_space_ ? static_cast<float>(1 / std::max(checker.scale, smallest_size)) : 0) {}

  UvSet uvset() const { return uvset_; }
  TextureSpace space() const { return space_; }
  float largest() const {
    const Rgb<float> both = max(abs(color1_), abs(color2_));
    return std::max({both.red, both.green, both.blue});
  }

  Rgba<FloatN> at(const TexturePoint<FloatN>& point) const {
    const auto wave = [](const FloatN& x, const FloatN& across, const FloatN& along, float frequency) {
      const FloatN scale(frequency);
      return mean_square_wave(x * scale, covered(across, along) * abs(scale));
    };
    FloatN product = FloatN(1);
    if (in_space_) {
      const auto& [p, a, b] = point.in(space_);
      product = wave(p.x, a.x, b.x, frequency_) * wave(p.y, a.y, b.y, frequency_) * wave(p.z, a.z, b.z, frequency_);
    } else {
      const UvPoint<FloatN>& on = point.by(uvset_);
      product = wave(on.uv.x, on.uv_across.x, on.uv_along.x, uvscale_.x) *
                wave(on.uv.y, on.uv_across.y, on.uv_along.y, uvscale_.y);
    }
    const FloatN second = FloatN(0.5F) - FloatN(0.5F) * product;
    return {mix(Rgb<FloatN>(color1_), Rgb<FloatN>(color2_), second), FloatN(1)};
  }

 private:
  Rgb<float> color1_, color2_;
  Vec2<float> uvscale_;
  UvSet uvset_;
  TextureSpace space_;
  bool in_space_;
  float frequency_;
};

}  // namespace raytrace
