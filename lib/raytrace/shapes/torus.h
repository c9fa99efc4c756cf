// Torus (Suffern, chapter 19.6).
//
//   <torus>
//     <center x="0" y="1" z="0"/> <axis x="0" y="1" z="0"/>
//     <sweptradius>2</sweptradius> <tuberadius>0.5</tuberadius> <material>red</material>
//   </torus>
//
// Solved in double. The quartic's stationary points (a cubic, in float, by Newton's method and deflation) cut the ray
// into pieces with at most one root each, so that no root is missed or invented at the silhouette; the root itself is
// found in a form that keeps its digits when the tube is thin. Nothing depends on the distance from the world's origin
// or on the ray's length: the quartic is set up about the ray's point closest to the center.
#pragma once

#include <cmath>

#include "raytrace/description/fields.h"
#include "raytrace/math/bounds.h"
#include "raytrace/math/doubles.h"
#include "raytrace/math/ray.h"

namespace raytrace {

class Torus {
 public:
  struct Parameters {
    Vec3d center{0, 0, 0};
    Vec3d axis{0, 1, 0};     ///< of symmetry; any length but 0
    double sweptradius = 0;  ///< from the center to the middle of the tube
    double tuberadius = 0;   ///< of the tube; may exceed sweptradius (a spindle torus)
  };
  static constexpr std::string_view group = "toruses";
  static constexpr std::string_view element = "torus";
  static Fields<Parameters> fields();

  template <class T>
  struct Record {
    Vec3<T> center;
    Vec3<T> side1, axis, side2;  ///< orthonormal
    T swept, tube;
  };
  static Record<double> record(const Parameters& parameters);
  static Bounds bounds(const Record<double>& torus);
  static double bounding_radius(const Record<double>& torus);

  /// The nearest distance inside (ray.near, ray.far) in each lane of `active`; infinity elsewhere.
  template <class F>
  static F intersect(const Record<double>& torus, const Ray<F>& ray, const Mask<F>& active);

  /// The surface at a distance that intersect() gave.
  template <class F>
  static SurfacePoint<F> surface(const Record<Doubles<F>>& torus, const Ray<F>& ray, const F& distance);
};

namespace detail {

/// The torus along a ray, in the torus' frame (axis = y), with `position` the ray's point closest to the center and a
/// direction of unit length, so that the quartic of Suffern's chapter 19.6 has no cubic term:
///   F(s) = s^4 + quadratic s^2 + linear s + constant.
template <class F>
struct TorusProfile {
  using D = Doubles<F>;
  Vec3<D> position, direction;
  D swept, tube;

  /// Positive outside of the torus, negative inside its tube. As a difference of lengths, (rho - R)^2 + y^2 - r^2, it
  /// keeps the digits that the quartic loses when the tube is thin. `side` is 1, or -1 for the inner sheet
  /// (the "lemon") of a torus whose tube is wider than its hole.
  struct Value {
    D value, newton_step;  ///< the step: value over slope
  };
  Value distance_form(const D& s, const D& side) const {
    const D x = multiply_add(direction.x, s, position.x), y = multiply_add(direction.y, s, position.y),
            z = multiply_add(direction.z, s, position.z);
    const D rho = sqrt(x * x + z * z);
    const D from_circle = rho - side * swept;
    const D value = multiply_add(from_circle, from_circle, (y - tube) * (y + tube));
    // The slope is 2 (from_circle * (x dx + z dz) / rho + y dy): one division does for both.
    const D slope_rho = D(2.0) * multiply_add(from_circle, x * direction.x + z * direction.z, y * direction.y * rho);
    return {value, value * rho / slope_rho};
  }

  /// Of the quartic's sign: its two factors are the distance forms of both sheets.
  D sign(const D& s) const {
    const D x = multiply_add(direction.x, s, position.x), y = multiply_add(direction.y, s, position.y),
            z = multiply_add(direction.z, s, position.z);
    const D rho = sqrt(x * x + z * z);
    const D height = (y - tube) * (y + tube);
    const D outer = (rho - swept) * (rho - swept) + height;
    const D inner = (rho + swept) * (rho + swept) + height;
    return outer * select(inner < D(0.0), D(-1.0), D(1.0));
  }
};

/// The real roots of s^3 + p s + q in ascending order; where there is only one, it stands in all three places. To a few
/// units of float's last place of the largest of them.
template <class F>
void depressed_cubic_roots(const F& p, const F& q, F (&root)[3]) {
  // The root on the far side of q's sign always exists and is simple. From beyond it, Newton's method comes down to it
  // monotonically. It is at most u + d where s^3 + p s >= d^3 and >= 2 u^2 d, u^2 = -p, and, where p is positive, at
  // most the lesser of cbrt(|q|) and |q| / p.
  const F zero(0.0F);
  const F abs_q = abs(q);
  const F u2 = max(-p, zero);
  const F quotient = abs_q / max(select(p < zero, u2 + u2, p), F(1e-30F));
  F s = (sqrt(u2) + min(cbrt(abs_q), quotient)) * F(1 + 0x1p-20F);
  Mask<F> moving(true);  // lanes that have arrived stay, whatever the others do
  for (int i = 0; i < 40; ++i) {
    const F slope = multiply_add(F(3.0F) * s, s, p);
    const F step = multiply_add(multiply_add(s, s, p), s, -abs_q) / max(slope, F(1e-30F));
    s = select(moving, s - step, s);
    moving = moving & (step > s * F(1e-4F));  // it converges quadratically
    if (none(moving)) break;
  }
  const F first = select(q < zero, s, -s);
  // The other two are the roots of the quotient s^2 + first s + (first^2 + p).
  const F discriminant = -multiply_add(F(3.0F) * first, first, F(4.0F) * p);
  const F half_width = F(0.5F) * sqrt(max(discriminant, zero));
  const F middle = F(-0.5F) * first;
  const auto single = discriminant < zero;
  const F low = select(single, first, middle - half_width), high = select(single, first, middle + half_width);
  root[0] = min(first, low);
  root[2] = max(first, high);
  root[1] = select(single, first, max(min(first, high), min(max(first, low), high)));
}

/// The root of the distance form between left and right, where it has different signs and one root: Newton's method
/// from `s`, and bisection where that would leave the bracket.
template <class F, class D>
D root_in_bracket(const TorusProfile<F>& profile, const D& side, D s, D left, D right, const D& left_sign,
                  const D& tolerance) {
  auto moving = left <= right;  // all that have a bracket; lanes that have arrived stay, whatever the others do
  for (int i = 0; i < 60; ++i) {
    const auto at = profile.distance_form(s, side);
    const auto still_left = at.value * left_sign > D(0.0);
    left = select(still_left, s, left);
    right = select(still_left, right, s);
    const D newton = s - at.newton_step;
    const auto inside = (newton >= left - tolerance) & (newton <= right + tolerance);
    const D next = select(inside, min(max(newton, left), right), D(0.5) * (left + right));
    const auto moved = abs(next - s) > tolerance;
    s = select(moving, next, s);
    moving = moving & moved;
    if (!any(moving)) break;
  }
  return s;
}

}  // namespace detail

template <class F>
F Torus::intersect(const Record<double>& torus, const Ray<F>& ray, const Mask<F>& active) {
  using D = Doubles<F>;
  const auto rotate = [&](const Vec3<D>& v) {
    return Vec3<D>{dot(v, Vec3<D>(torus.side1)), dot(v, Vec3<D>(torus.axis)), dot(v, Vec3<D>(torus.side2))};
  };
  const Vec3<D> origin = rotate(Vec3<D>(ray.origin) - Vec3<D>(torus.center));
  const Vec3<D> scaled_direction = rotate(Vec3<D>(ray.direction));
  const D scale = sqrt(dot(scaled_direction, scaled_direction));
  detail::TorusProfile<F> profile;
  const D inverse_scale = D(1.0) / scale;
  profile.direction = scaled_direction * inverse_scale;
  const D to_closest = -dot(origin, profile.direction);
  profile.position = origin + profile.direction * to_closest;
  profile.swept = D(torus.swept);
  profile.tube = D(torus.tube);

  // The part of the ray that can hit: inside the sphere and the slab around the torus (a little wider, so that the
  // ends lie outside of the tube), and between near and far.
  const double widened = 1 + 1e-6;
  const double outer = (torus.swept + torus.tube) * widened, tube = torus.tube * widened;
  const D distance2 = dot(profile.position, profile.position);
  const D half_chord2 = D(outer * outer) - distance2;
  const D half_chord = sqrt(max(half_chord2, D(0.0)));
  const D inverse_climb = D(1.0) / profile.direction.y;
  const D slab1 = (D(-tube) - profile.position.y) * inverse_climb,
          slab2 = (D(tube) - profile.position.y) * inverse_climb;
  const D near = D(ray.near) * scale - to_closest, far = D(ray.far) * scale - to_closest;
  const D low = max(max(-half_chord, min(slab1, slab2)), near);
  const D high = min(min(half_chord, max(slab1, slab2)), far);
  const auto possible = (half_chord2 > D(0.0)) & (low < high);
  if (none(active & D::float_mask(possible))) return infinity<F>();

  // Between the quartic's stationary points there is at most one root, and there is one where the sign changes. The
  // points need no precision for that: beside one, the distance form changes with the square of the way. The signs do,
  // and do not come from the quartic.
  const D &py = profile.position.y, &dy = profile.direction.y;
  const D swept2(4 * torus.swept * torus.swept);
  const D k = distance2 + D(torus.swept * torus.swept - torus.tube * torus.tube);
  const D quadratic = D(2.0) * k - swept2 * (D(1.0) - dy * dy);
  const D linear = D(2.0) * swept2 * py * dy;
  const double inverse = 1 / outer;  // in units of the torus' size, for float's range
  F stationary[3];
  detail::depressed_cubic_roots<F>((quadratic * D(0.5 * inverse * inverse)).to_float(),
                                   (linear * D(0.25 * inverse * inverse * inverse)).to_float(), stationary);
  D left = low, right = high, left_sign(0.0), right_sign(0.0);
  D end = high, end_sign = profile.sign(high);
  auto found = possible & (low > high);  // nowhere yet
  for (int i = 2; i >= -1; --i) {
    const D start = i < 0 ? low : min(max(D(stationary[i]) * D(outer), low), high);
    const D start_sign = profile.sign(start);
    const auto change = possible & (start_sign * end_sign < D(0.0));
    left = select(change, start, left);
    right = select(change, end, right);
    left_sign = select(change, start_sign, left_sign);
    right_sign = select(change, end_sign, right_sign);
    found = found | change;
    end = start;
    end_sign = start_sign;
  }
  const Mask<F> hit = active & D::float_mask(found);
  if (none(hit)) return infinity<F>();

  D side(1.0);
  if (torus.tube > torus.swept) {
    const auto outer_sheet =
        profile.distance_form(left, side).value * profile.distance_form(right, side).value <= D(0.0);
    side = select(outer_sheet, side, D(-1.0));
    left_sign = profile.distance_form(left, side).value;
    right_sign = profile.distance_form(right, side).value;
  }
  // Along the ray the distance form is much like a parabola whose vertex is the end that lies in the tube. Where that
  // end is hardly inside, so that Newton's method would creep, it is most like one.
  const F left_value = left_sign.to_float(), right_value = right_sign.to_float();
  const F inside = min(left_value, right_value), outside = max(left_value, right_value);
  const D way(sqrt(inside / min(inside - outside, F(-1e-30f))));
  const D guess = select(left_sign < D(0.0), left + (right - left) * way, right - (right - left) * way);
  // Lanes without a root have nothing to look for, and must not hold up the others.
  const D s = detail::root_in_bracket(profile, side, select(found, guess, left), left, select(found, right, left),
                                      left_sign, D(torus.tube * 1e-9));
  const F t = ((s + to_closest) * inverse_scale).to_float();
  return select(hit & (t > ray.near) & (t < ray.far), t, infinity<F>());
}

template <class F>
SurfacePoint<F> Torus::surface(const Record<Doubles<F>>& torus, const Ray<F>& ray, const F& distance) {
  using D = Doubles<F>;
  const Vec3<D> p = Vec3<D>(ray.origin) - torus.center + Vec3<D>(ray.direction) * D(distance);
  const D y = dot(p, torus.axis);
  const Vec3<D> across = p - torus.axis * y;
  const D rho = max(length(across), D(1e-300));
  const auto off_sheet = [&](const D& swept) {
    return abs((rho - swept) * (rho - swept) + (y - torus.tube) * (y + torus.tube));
  };
  const D swept = select(off_sheet(torus.swept) <= off_sheet(-torus.swept), torus.swept, -torus.swept);
  const Vec3<D> tube_center = across * (swept / rho);
  const Vec3<D> normal = normalize(p - tube_center);
  const Vec3<F> position = to_float(torus.center + tube_center + normal * torus.tube);
  return {position, to_float(normal), rounding_error(position, F(0))};
}

}  // namespace raytrace
