// What a spotlight sends to a point.
#pragma once

#include <cmath>
#include <numbers>

#include "raytrace/lights/light_sample.h"
#include "raytrace/lights/photometric_share_kernel.h"
#include "raytrace/lights/point_radiance.h"
#include "raytrace/lights/point_source.h"
#include "raytrace/lights/spot_light.h"
#include "raytrace/math/kernel.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"

namespace raytrace {

template <>
class Kernel<SpotLight> {
 public:
  explicit Kernel(const SpotLight::Parameters& parameters, const LoadedPhotometry& photometry = {})
      : location_(parameters.location),
        towards_(normalize(parameters.location - parameters.lookat)),
        photometric_(photometry, -towards_),
        radiance_(parameters.color * parameters.scaleradiance, parameters.falloff),
        shadows_(parameters.shadows) {
    const double degree = std::numbers::pi / 180, edge = parameters.coneangle / 2;
    edge_cosine_ = static_cast<float>(std::cos(edge * degree));
    const double inner_cosine = std::cos((edge - parameters.penumbraangle) * degree);
    inverse_width_ = parameters.penumbraangle > 0 ? static_cast<float>(1 / (inner_cosine - edge_cosine_)) : 0;
  }

  static constexpr bool ambient = false;
  bool shadows() const { return shadows_; }
  Vec3f location() const { return location_; }
  Rgb<float> largest_radiance() const { return radiance_.at_distance_1(); }
  bool falls_off() const { return radiance_.falls_off(); }
  PointSource<float> source() const {
    return {location_, radiance_.at_distance_1(), radiance_.largest_share(), towards_, edge_cosine_, inverse_width_};
  }
  const PhotometricShare& photometric_share() const { return photometric_; }

  template <class F>
  RAYTRACE_INLINE LightSample<F> sample(const Vec3<F>& p) const {
    const Vec3<F> to_light = Vec3<F>(location_) - p;
    const F cone = cone_share(dot(normalize(to_light), Vec3<F>(towards_)), F(edge_cosine_), F(inverse_width_));
    return {to_light, F(1), radiance_.at(to_light) * (cone * photometric_.towards(to_light))};
  }

  /// Where rays, of unit length, are in its cone: cuts begin and end to it, of rays that are not, to one distance.
  template <class F>
  void cut_to_cone(const Ray<F>& rays, F& begin, F& end) const {
    if (edge_cosine_ <= 0) return;  // more than one piece
    const Vec3<F> from = rays.origin - Vec3<F>(location_), axis(-towards_);
    const F cosine2 = F(edge_cosine_ * edge_cosine_), along = dot(from, axis), forwards = dot(rays.direction, axis);
    // a t^2 + 2 b t + c is not negative in the cone, and in its mirror image behind the light.
    const F a = forwards * forwards - cosine2, b = along * forwards - cosine2 * dot(from, rays.direction);
    const F c = along * along - cosine2 * dot(from, from), root = b * b - a * c;
    const F q = -b - select(b < F(0), -sqrt(max(root, F(0))), sqrt(max(root, F(0))));
    const F one = q / a, other = c / q, near = min(one, other), far = max(one, other);
    const F room = max(abs(near), abs(far)) * F(1e-4F);  // for rounding
    const Mask<F> crosses = (a < F(0)) & (root > F(0)), is_ahead = along + forwards * (near + far) * F(0.5F) > F(0);
    const Mask<F> enters = (a > F(0)) & (forwards > F(0)), leaves = (a > F(0)) & (forwards < F(0));
    const F first = select((crosses & is_ahead), near - room, select(enters, far - room, begin));
    const F last = select((crosses & is_ahead), far + room, select(leaves, near + room, end));
    const Mask<F> misses = (a < F(0)) & !(crosses & is_ahead);
    const F cut_begin = min(max(first, begin), end);
    end = select(misses, begin, max(min(last, end), cut_begin));
    begin = select(misses, begin, cut_begin);
  }

 private:
  Vec3f location_;
  Vec3f towards_;  ///< against the axis of the cone, of unit length
  PhotometricShare photometric_;
  PointRadiance radiance_;
  bool shadows_;
  float edge_cosine_, inverse_width_;  ///< of the penumbra, in cosines; 0: there is none
};

}  // namespace raytrace
