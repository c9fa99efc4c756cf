// Where rays meet spheres.
//
// Solved in float, with the cancellations taken out: the ray's origin is moved, exactly, next to the center first, so
// that neither the distance from the origin of the world nor the length of the ray costs precision (the idea of
// Haines et al., "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems chapter 7, carried on with
// error-free transformations). Only hits close to the ray's origin and the shortest chords are solved again in double.
#pragma once

#include <cmath>
#include <type_traits>

#include "raytrace/math/bounds.h"
#include "raytrace/math/doubles.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/surface_uv.h"
#include "raytrace/shapes/light_patch.h"
#include "raytrace/shapes/sphere.h"

namespace raytrace {

template <>
class Kernel<Sphere> {
 public:
  using Parameters = Sphere::Parameters;

  /// What the tracer keeps: T is float in the table, FloatN where lanes hit different spheres.
  template <class T>
  struct Record {
    Vec3<T> center;
    T radius;
  };
  static Record<float> record(const Parameters& parameters);
  static void add_patches(const Record<float>& sphere, std::vector<LightPatch>& patches) {
    patches.push_back({PatchShape::sphere, Vec3d(sphere.center), {sphere.radius, 0, 0}, {0, 0, 0}});
  }
  static Bounds bounds(const Record<float>& sphere);
  static double bounding_radius(const Record<float>& sphere);
  static constexpr bool is_its_bounding_sphere = true;  ///< so that nothing is seen through it

  /// The nearest distance inside (ray.near, ray.far) in each lane of `active`; infinity elsewhere.
  /// Rays: Ray<F> or RaysFromPoint<F>. T: float, or F where lanes have different spheres.
  template <class F, class T, class Rays>
  static F intersect(const Record<T>& sphere, const Rays& ray, const Mask<F>& active);

  /// The surface at a distance that intersect() gave.
  template <class F>
  static SurfacePoint<F> surface(const Record<F>& sphere, const Ray<F>& ray, const F& distance);

  /// Longitude about y, from +z (0) over +x to +z (1), and latitude, from -y (0) to +y (1).
  template <class F>
  static SurfaceUv<F> uv(const Record<F>& sphere, const Vec3<F>& position, const Vec3<F>& normal);

  /// The surface's point on a ray that hits it from nearby, and its error: intersect() is as precise there as floats
  /// allow.
  template <class F>
  static SurfacePosition<F> position_on_ray(const Record<F>&, const Ray<F>& ray) {
    const Vec3<F> position = ray.at(ray.far);
    return {position,
            rounding_error(position, max(largest_component(ray.origin), largest_component(ray.direction) * ray.far))};
  }

 private:
  template <class F, class T, class Rays>
  static F intersect_in_double(const Record<T>& sphere, const Rays& ray);
};

namespace detail {
/// difference = round(a - b) and the exact rest, so that a - b == difference + error (Knuth's TwoSum).
template <class F>
RAYTRACE_INLINE void exact_difference(const F& a, const F& b, F& difference, F& error) {
  difference = a - b;
  const F b_virtual = a - difference;
  error = (a - (difference + b_virtual)) + (b_virtual - b);
}
}  // namespace detail

template <class F, class T, class Rays>
RAYTRACE_INLINE F Kernel<Sphere>::intersect(const Record<T>& sphere, const Rays& ray, const Mask<F>& active) {
  const Vec3<F>& d = ray.direction;
  const F radius(sphere.radius);
  // o = origin - center = from_center + rest, exactly.
  auto from = ray.origin, missing = ray.origin;
  const decltype(from) center(sphere.center);
  detail::exact_difference(ray.origin.x, center.x, from.x, missing.x);
  detail::exact_difference(ray.origin.y, center.y, from.y, missing.y);
  detail::exact_difference(ray.origin.z, center.z, from.z, missing.z);
  const Vec3<F> from_center(from), rest(missing);
  // Two steps to the ray's point closest to the center. Neither needs an exact distance, only an exact point: the
  // first brings the cancelling digits in, with one rounding, and the second has nothing left to cancel.
  const F inverse_dd = F(1) / dot(d, d);
  const F to_closest = -dot(from_center, d) * inverse_dd;
  const Vec3<F> near_closest{exact_fma(to_closest, d.x, from_center.x) + rest.x,
                             exact_fma(to_closest, d.y, from_center.y) + rest.y,
                             exact_fma(to_closest, d.z, from_center.z) + rest.z};
  const F correction = -dot(near_closest, d) * inverse_dd;
  const Vec3<F> closest = near_closest + d * correction;
  const F discriminant = radius * radius - dot(closest, closest);
  const Mask<F> possible = active & (discriminant >= F(0));
  if (none(possible)) return infinity<F>();

  const F half_chord = sqrt(max(discriminant, F(0)) * inverse_dd);
  const F entry = to_closest + (correction - half_chord);
  const F exit = to_closest + (correction + half_chord);
  F t = select(entry > ray.near, entry, exit);
  // Again, in double, where a hit is much closer than the terms it is the difference of (an origin near the surface of
  // a large sphere: the rounding may even put it on the other side), or where the chord is so short that its own
  // rounding, about radius^2 / half_chord ulps, shows. Rays that leave the sphere itself stay out of it: they start
  // further away than the rounding.
  const F terms = abs(to_closest) + half_chord, radius2 = radius * radius * inverse_dd;
  const F rounding = terms * F(0x1p-22f);
  const Mask<F> in_question =
      (t > ray.near - rounding) & (t < ray.far + rounding) & ((t * F(64) < terms) | (t * half_chord * F(64) < radius2));
  const Mask<F> on_either_side = abs(entry - ray.near) * half_chord < (terms * half_chord + radius2) * F(0x1p-22f);
  const Mask<F> imprecise = possible & (in_question | on_either_side);
  if (any(imprecise)) t = select(imprecise, intersect_in_double<F>(sphere, ray), t);
  return select(possible & (t > ray.near) & (t < ray.far), t, infinity<F>());
}

template <class F, class T, class Rays>
F Kernel<Sphere>::intersect_in_double(const Record<T>& sphere, const Rays& ray) {
  using D = Doubles<F>;
  using Double = std::conditional_t<std::is_same_v<T, float>, double, D>;  // as wide as the sphere is
  const Vec3<D> o = Vec3<D>(ray.origin) - Vec3<D>(Vec3<Double>(sphere.center));
  const Vec3<D> d(ray.direction);
  const D radius{Double(sphere.radius)};
  const D a = dot(d, d);
  const D half_b = dot(o, d);
  const D c = dot(o, o) - radius * radius;
  const D root = sqrt(max(half_b * half_b - a * c, D(0.0)));
  // The two roots without subtracting numbers of like size.
  const D q = select(half_b < D(0.0), root - half_b, -root - half_b);
  const D t0 = q / a;
  const D t1 = c / q;
  const D near(ray.near), low = min(t0, t1), high = max(t0, t1);
  return select(low > near, low, high).to_float();
}

template <class F>
RAYTRACE_INLINE SurfacePoint<F> Kernel<Sphere>::surface(const Record<F>& sphere, const Ray<F>& ray, const F& distance) {
  const Vec3<F>& d = ray.direction;
  Vec3<F> from_center, rest;
  detail::exact_difference(ray.origin.x, sphere.center.x, from_center.x, rest.x);
  detail::exact_difference(ray.origin.y, sphere.center.y, from_center.y, rest.y);
  detail::exact_difference(ray.origin.z, sphere.center.z, from_center.z, rest.z);
  const Vec3<F> rounded{exact_fma(distance, d.x, from_center.x) + rest.x,
                        exact_fma(distance, d.y, from_center.y) + rest.y,
                        exact_fma(distance, d.z, from_center.z) + rest.z};
  // `distance` is rounded to float, which shows on a small sphere far away: one Newton step of at most that rounding,
  // where the step's own rounding is less than what it corrects.
  const F climb = dot(rounded, d);
  const F radius2 = sphere.radius * sphere.radius;
  const F most = distance * F(0x1p-22f);
  const F step = min(max((radius2 - dot(rounded, rounded)) / (F(2) * climb), -most), most);
  const Mask<F> worth_it = abs(climb) * distance > radius2;
  const Vec3<F> normal = normalize(rounded + d * select(worth_it, step, F(0)));
  const Vec3<F> position = sphere.center + normal * sphere.radius;
  return {position, normal, rounding_error(position, sphere.radius)};
}

template <class F>
SurfaceUv<F> Kernel<Sphere>::uv(const Record<F>& sphere, const Vec3<F>& position, const Vec3<F>& normal) {
  // The normal, which is more precise than a position far from the origin.
  const Vec3<F> n = select(dot(normal, position - sphere.center) < F(0), -normal, normal);
  const F level = sqrt(n.x * n.x + n.z * n.z);
  const F down = -n.y / max(level, F(1e-30F));
  const F half_turn = F(one_turn / 2) * sphere.radius;
  return {turns_about(Vec3<F>(F(0), F(1), F(0)), n), multiply_add(turns(n.y, level), F(2), F(0.5F)),
          Vec3<F>(n.z, F(0), -n.x) * (F(2) * half_turn), Vec3<F>(n.x * down, level, n.z * down) * half_turn};
}

inline Kernel<Sphere>::Record<float> Kernel<Sphere>::record(const Parameters& parameters) {
  return {Vec3f(parameters.center), static_cast<float>(parameters.radius)};
}

inline Bounds Kernel<Sphere>::bounds(const Record<float>& sphere) {
  const double r = sphere.radius;
  return bounds_around(Vec3d(sphere.center), {r, r, r});
}

inline double Kernel<Sphere>::bounding_radius(const Record<float>& sphere) { return sphere.radius; }

}  // namespace raytrace
