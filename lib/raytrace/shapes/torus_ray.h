// Rays that may meet a torus: where the first root of Suffern's quartic (chapter 19.6) lies, and the root itself.
//
// The quartic's stationary points (a cubic, by Newton's method and deflation) cut the ray into pieces with at most one
// root each, so that no root is missed or invented at the silhouette; the root itself is found in a form that keeps its
// digits when the tube is thin. Nothing depends on the distance from the world's origin or on the ray's length: all is
// set up about the ray's point closest to the center, in double. From there on float, in units of the torus' size, does
// what it can: double has the last word on signs that float leaves open, and finds the root's last digits.
#pragma once

#include "raytrace/math/depressed_cubic.h"
#include "raytrace/math/ray.h"
#include "raytrace/shapes/torus_profile.h"

namespace raytrace {

/// Whether rays come near the torus: into the sphere and the slab around it, both wider than all that is rounded here.
template <class F, class Record>
RAYTRACE_INLINE Mask<F> comes_near(const Record& torus, const Ray<F>& ray) {
  const Vec3<float> center(torus.center);
  const Vec3<F> origin = ray.origin - Vec3<F>(center), direction = ray.direction, axis(Vec3<float>(torus.axis));
  const F inverse_length2 = F(1) / fused_dot(direction, direction);
  const Vec3<F> closest = origin - direction * (fused_dot(origin, direction) * inverse_length2);
  const F rounding = F(0x1p-19F) * (abs(origin.x) + abs(origin.y) + abs(origin.z) +
                                    F(std::abs(center.x) + std::abs(center.y) + std::abs(center.z)));
  const double size = (torus.swept + torus.tube) * (1 + 0x1p-16);
  const F outer = F(static_cast<float>(size)) + rounding;
  const F half_chord2 = outer * outer - fused_dot(closest, closest);
  // Above the slab, or below, where the sphere's chord is on neither of its ends: compared as squares.
  const F climb = fused_dot(direction, axis);
  const F beside =
      max(abs(fused_dot(closest, axis)) - F(static_cast<float>(torus.tube + size * 0x1p-16)) - rounding, F(0));
  return !((half_chord2 < F(0)) | (beside * beside > climb * climb * inverse_length2 * half_chord2));
}

/// A ray and a torus: places on the ray as in TorusProfile, and in float with a direction of unit length, in units of
/// the torus' size.
template <class F>
class TorusRay {
 public:
  /// The part of the ray that has the first root and no other, in the lanes of `found`.
  struct Bracket {
    Mask<F> found = Mask<F>(false);
    F left, right;            ///< its ends, in float's places
    F left_sign, right_sign;  ///< the quartic's there
  };

  /// Record: Kernel<Torus>::Record<double>.
  template <class Record>
  TorusRay(const Record& torus, const Ray<F>& ray);

  Bracket first_root(const Mask<F>& active) const;

  /// Whether the part begins in front of the distance `far`, rounding aside.
  Mask<F> begins_before(const Bracket& bracket, const F& far) const {
    return (exact_place(bracket.left) + to_closest_).to_float() <= far;
  }

  /// Where the root is, on the ray.
  F distance(const Bracket& bracket) const;

 private:
  using D = Doubles<F>;

  D exact_place(const F& s) const { return D(s * from_small_); }

  /// The quartic's sign at the place s, which exactly() has in double. Where float leaves it open, in the lanes of
  /// `asked`, it is found there.
  template <class Exactly>
  RAYTRACE_INLINE F sign(const F& s, const Mask<F>& asked, const Exactly& exactly) const {
    const auto at = small_.place(s);
    const auto rough = small_.sign(at);
    const Mask<F> open = asked & (rough.least * at.rho <= (at.rho + small_.swept) * F(0x1p-17F));
    if (none(open)) return rough.value;
    const auto exact = exact_.sign(exact_.place(exactly()));
    return select(open, (exact.value * D(unit_ * unit_)).to_float(), rough.value);
  }

  double unit_;            ///< one over the torus' size
  TorusProfile<D> exact_;  ///< in the scene's units
  D to_closest_;           ///< the place s is at to_closest_ + s on the ray
  D near_, far_;           ///< the ray's, as places
  TorusProfile<F> small_;
  F from_small_;  ///< from float's places to double's
};

template <class F>
template <class Record>
RAYTRACE_INLINE TorusRay<F>::TorusRay(const Record& torus, const Ray<F>& ray) : unit_(1 / (torus.swept + torus.tube)) {
  const Vec3<D> origin = Vec3<D>(ray.origin) - Vec3<D>(torus.center), direction(ray.direction), axis(torus.axis);
  const D length2 = fused_dot(direction, direction);
  to_closest_ = -fused_dot(origin, direction) / length2;
  near_ = D(ray.near) - to_closest_;
  far_ = D(ray.far) - to_closest_;
  const Vec3<D> closest = origin + direction * to_closest_;
  exact_ = {fused_dot(closest, closest), fused_dot(closest, axis), length2,
            fused_dot(direction, axis),  D(torus.swept),           D(torus.tube)};
  const F inverse_length = F(1) / sqrt(length2.to_float());
  small_ = {(exact_.distance2 * D(unit_ * unit_)).to_float(),
            (exact_.height * D(unit_)).to_float(),
            F(1),
            exact_.climb.to_float() * inverse_length,
            F(static_cast<float>(torus.swept * unit_)),
            F(static_cast<float>(torus.tube * unit_))};
  from_small_ = F(static_cast<float>(torus.swept + torus.tube)) * inverse_length;
}

template <class F>
RAYTRACE_INLINE typename TorusRay<F>::Bracket TorusRay<F>::first_root(const Mask<F>& active) const {
  // The part of the ray that can hit: inside the sphere and the slab around the torus (wider, so that the ends lie
  // outside of the tube), and between near and far (wider, too: float must not cut).
  const F widened(0x1p-18F);
  const F half_chord2 = F(1) + widened - small_.distance2;
  const F half_chord = sqrt(max(half_chord2, F(0)));
  const F inverse_climb = F(1) / small_.climb;
  const F slab1 = (-small_.tube - widened - small_.height) * inverse_climb,
          slab2 = (small_.tube + widened - small_.height) * inverse_climb;
  const F entry = max(-half_chord, min(slab1, slab2)), exit = min(half_chord, max(slab1, slab2));
  const F to_small = F(1) / from_small_;
  const F rounded_near = near_.to_float() * to_small, rounded_far = far_.to_float() * to_small;
  const F near = rounded_near - abs(rounded_near) * F(0x1p-21F), far = rounded_far + abs(rounded_far) * F(0x1p-21F);
  const F low = max(entry, near), high = min(exit, far);
  const Mask<F> possible = active & (half_chord2 > F(0)) & (low <= high);
  Bracket bracket;
  if (none(possible)) return bracket;

  // Between the quartic's stationary points there is at most one root, and there is one where the sign changes. The
  // points need no precision for that: beside one, the distance form changes with the square of the way. The signs do,
  // and do not come from the quartic.
  const F swept2 = F(2) * small_.swept * small_.swept;
  const F k = small_.distance2 + small_.swept - small_.tube;  // swept + tube = 1
  F stationary[3];
  depressed_cubic_roots<F>(k - swept2 * (F(1) - small_.climb * small_.climb), swept2 * small_.height * small_.climb,
                           stationary);

  // The ends are outside, but where near or far is one.
  const F outside(0x1p-20F);
  const Mask<F> starts_within = near >= entry, stops_within = far <= exit;
  const F near_sign = sign(low, possible & starts_within, [&] { return near_; }),
          far_sign = sign(high, possible & stops_within, [&] { return far_; });
  const F low_sign = select(starts_within, near_sign, max(near_sign, outside)),
          high_sign = select(stops_within, far_sign, max(far_sign, outside));
  F end = high, end_sign = high_sign;
  for (int i = 2; i >= -1; --i) {
    F start = low, start_sign = low_sign;
    if (i >= 0) {
      start = min(max(stationary[i], low), high);
      const Mask<F> between = (start > low) & (start < high);
      start_sign = select(between, sign(start, possible & between, [&] { return exact_place(start); }),
                          select(start <= low, low_sign, high_sign));
    }
    const Mask<F> change = possible & (start_sign * end_sign < F(0));
    bracket.left = select(change, start, bracket.left);
    bracket.right = select(change, end, bracket.right);
    bracket.left_sign = select(change, start_sign, bracket.left_sign);
    bracket.right_sign = select(change, end_sign, bracket.right_sign);
    bracket.found = bracket.found | change;
    end = start;
    end_sign = start_sign;
  }
  return bracket;
}

template <class F>
RAYTRACE_INLINE F TorusRay<F>::distance(const Bracket& bracket) const {
  const F& left = bracket.left;
  // Lanes without a root have nothing to look for, and must not hold up the others.
  const F right = select(bracket.found, bracket.right, left);
  const D exact_left = max(exact_place(left), near_), exact_right = min(exact_place(right), far_);
  F left_sign = bracket.left_sign, right_sign = bracket.right_sign;
  F side(1);
  if (any(small_.tube > small_.swept)) {
    const auto at_left = exact_.place(exact_left), at_right = exact_.place(exact_right);
    const auto value = [&](const auto& at, const F& sheet) {
      return (exact_.distance_form(at, D(sheet)) * D(unit_ * unit_)).to_float();
    };
    side = select(value(at_left, side) * value(at_right, side) <= F(0), side, F(-1));
    left_sign = value(at_left, side);
    right_sign = value(at_right, side);
  }
  // Along the ray the distance form is much like a parabola whose vertex is the end that lies in the tube. Where that
  // end is hardly inside, so that Newton's method would creep, it is most like one.
  const F inside = min(left_sign, right_sign), outside = max(left_sign, right_sign);
  const F way = (right - left) * sqrt(inside / min(inside - outside, F(-1e-30F)));
  const F guess = select(left_sign < F(0), left + way, right - way);
  const F close = F(0x1p-15F) * small_.tube;
  const F rough =
      root_in_bracket<F>(small_, side, select(bracket.found, guess, left), left, right, left_sign, {close, close, 4});
  const D exact_guess = min(max(exact_place(rough), exact_left), exact_right), tube(small_.tube * from_small_);
  return (to_closest_ + root_in_bracket<D>(exact_, D(side), exact_guess, exact_left, exact_right, D(left_sign),
                                           {tube * D(1e-9), tube * D(1e-14), 60}))
      .to_float();
}

}  // namespace raytrace
