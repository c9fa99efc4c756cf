#include "raytrace/scene/patch_sampling.h"

#include <numbers>

#include "raytrace/math/frame.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/turns.h"
#include "raytrace/math/unit_disk.h"

namespace raytrace {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

MaskN is(const PatchRecord<FloatN>& patch, PatchShape shape) {
  return patch.shape == FloatN(static_cast<float>(shape));
}

/// Of a density per area.
FloatN per_solid_angle(const FloatN& density, const Vec3<FloatN>& from, const Vec3<FloatN>& p,
                       const Vec3<FloatN>& normal) {
  const Vec3<FloatN> way = p - from;
  const FloatN squared = dot(way, way), slant = abs(dot(way, normal));
  return select(slant > FloatN(0), density * squared * (sqrt(squared) / slant), FloatN(0));
}

/// The directions to a sphere from a point outside of it.
struct SphereCone {
  Vec3<FloatN> axis;  ///< from the center to the point, of unit length
  MaskN outside;
  FloatN sine2;             ///< of half the cone's angle, squared
  FloatN one_minus_cosine;  ///< of that angle, without cancellation

  SphereCone(const PatchRecord<FloatN>& sphere, const Vec3<FloatN>& from) {
    constexpr float least = 1e-37F;
    const Vec3<FloatN> way = from - sphere.origin;
    const FloatN squared = max(dot(way, way), FloatN(least)), radius2 = sphere.a.x * sphere.a.x;
    axis = way * (FloatN(1) / sqrt(squared));
    outside = squared > radius2;
    sine2 = min(max(radius2 / squared, FloatN(least)), FloatN(1));
    one_minus_cosine = sine2 / (FloatN(1) + sqrt(FloatN(1) - sine2));
  }
  FloatN pdf() const { return FloatN(1 / (2 * pi)) / one_minus_cosine; }
};

FloatN sphere_density(const PatchRecord<FloatN>& sphere) { return FloatN(1 / (4 * pi)) / (sphere.a.x * sphere.a.x); }

FloatN flat_density(const PatchRecord<FloatN>& patch) {
  return select(is(patch, PatchShape::triangle), FloatN(2), FloatN(1)) / length(cross(patch.a, patch.b));
}

FloatN band_density(const PatchRecord<FloatN>& band) {
  const FloatN rise = band.b.y - band.b.x;
  return FloatN(1 / pi) / ((band.b.x + band.b.y) * sqrt(rise * rise + band.b.z * band.b.z));
}

FloatN torus_density(const PatchRecord<FloatN>& torus, const Vec3<FloatN>& p) {
  const FloatN from_axis = length(cross(p - torus.origin, torus.a)), &tube = torus.b.y;
  return FloatN(1 / (4 * pi * pi)) / (tube * max(from_axis, tube * FloatN(1e-6F)));
}

void set(const MaskN& here, const Vec3<FloatN>& p, const Vec3<FloatN>& normal, const FloatN& size,
         PatchSample& result) {
  result.p = select(here, p, result.p);
  result.normal = select(here, normal, result.normal);
  result.error = select(here, rounding_error(p, size), result.error);
}

void sample_flat(const PatchRecord<FloatN>& patch, const MaskN& here, const FloatN& u1, const FloatN& u2,
                 PatchSample& result) {
  // Triangles by halves of the square: Heitz, "A Low-Distortion Map Between Triangle and Square", 2019.
  const MaskN triangle = is(patch, PatchShape::triangle), below = u1 < u2;
  const FloatN half1 = u1 * FloatN(0.5F), half2 = u2 * FloatN(0.5F);
  result.u = select(triangle, select(below, half1, u1 - half2), u1);
  result.v = select(triangle, select(below, u2 - half1, half2), u2);
  const Vec3<FloatN> across = cross(patch.a, patch.b);
  set(here, patch.origin + patch.a * result.u + patch.b * result.v, across * (FloatN(1) / length(across)),
      max(largest_component(patch.a), largest_component(patch.b)), result);
}

void sample_sphere(const PatchRecord<FloatN>& patch, const MaskN& here, const Vec3<FloatN>& from, const FloatN& u1,
                   const FloatN& u2, PatchSample& result) {
  const SphereCone cone(patch, from);
  const DiskPoint<FloatN> point = on_unit_disk(u1, u2);
  const FloatN radius2 = min(point.x * point.x + point.y * point.y, FloatN(1));
  const FloatN one_minus_cosine = cone.one_minus_cosine * radius2;
  const FloatN sine2 = one_minus_cosine * (FloatN(2) - one_minus_cosine);
  // The angle at the sphere's center. share: of the cone's sine, squared.
  const FloatN share = min(sine2 / cone.sine2, FloatN(1));
  const FloatN at_center = share * sqrt(cone.sine2) + (FloatN(1) - one_minus_cosine) * sqrt(FloatN(1) - share);
  const FloatN cosine = select(cone.outside, min(at_center, FloatN(1)), FloatN(1) - FloatN(2) * radius2);
  const FloatN sine = sqrt(max((FloatN(1) - cosine) * (FloatN(1) + cosine), FloatN(0)));
  const FloatN across = sine / max(sqrt(radius2), FloatN(1e-18F));
  const Vec3<FloatN> normal = Frame<FloatN>(cone.axis).to_world({point.x * across, point.y * across, cosine});
  set(here, patch.origin + normal * patch.a.x, normal, patch.a.x, result);
}

void sample_band(const PatchRecord<FloatN>& band, const MaskN& here, const FloatN& u1, const Vec3<FloatN>& outwards,
                 PatchSample& result) {
  const auto& [first, last, height] = band.b;
  const FloatN rise = last - first;
  const FloatN radius = sqrt(max(first * first + u1 * (last - first) * (last + first), FloatN(0)));
  const FloatN along = u1 * (first + last) / max(first + radius, FloatN(1e-37F));
  const FloatN slope = FloatN(1) / sqrt(rise * rise + height * height);
  set(here, band.origin + band.a * (height * along) + outwards * radius,
      outwards * (height * slope) - band.a * (rise * slope), max(max(first, last), height), result);
}

void sample_torus(const PatchRecord<FloatN>& torus, const MaskN& here, const FloatN& u1, const Vec3<FloatN>& outwards,
                  PatchSample& result) {
  const auto [sine, cosine] = sin_cos_of_turns(u1);
  const Vec3<FloatN> normal = outwards * cosine + torus.a * sine;
  set(here, torus.origin + outwards * torus.b.x + normal * torus.b.y, normal, torus.b.x + torus.b.y, result);
}

}  // namespace

PatchSample sample_patch(const PatchRecord<FloatN>& patch, const Vec3<FloatN>& from, const FloatN& u1,
                         const FloatN& u2) {
  const MaskN sphere = is(patch, PatchShape::sphere), band = is(patch, PatchShape::band),
              torus = is(patch, PatchShape::torus), flat = !(sphere | band | torus);
  PatchSample result{};
  if (any(flat)) sample_flat(patch, flat, u1, u2, result);
  if (any(sphere)) sample_sphere(patch, sphere, from, u1, u2, result);
  if (any(band | torus)) {
    const auto [sine, cosine] = sin_cos_of_turns(u2);
    const Frame<FloatN> frame(select(band | torus, patch.a, Vec3<FloatN>(Vec3f(0, 0, 1))));
    const Vec3<FloatN> outwards = frame.x * cosine + frame.y * sine;
    if (any(band)) sample_band(patch, band, u1, outwards, result);
    if (any(torus)) sample_torus(patch, torus, u1, outwards, result);
  }
  result.error = result.error * patch.error_scale;
  result.pdf = patch_pdf(patch, from, result.p, result.normal);
  return result;
}

FloatN patch_pdf(const PatchRecord<FloatN>& patch, const Vec3<FloatN>& from, const Vec3<FloatN>& p,
                 const Vec3<FloatN>& normal) {
  const MaskN sphere = is(patch, PatchShape::sphere), band = is(patch, PatchShape::band),
              torus = is(patch, PatchShape::torus);
  FloatN density = flat_density(patch);
  if (any(band)) density = select(band, band_density(patch), density);
  if (any(torus)) density = select(torus, torus_density(patch, p), density);
  if (none(sphere)) return per_solid_angle(density, from, p, normal);
  const SphereCone cone(patch, from);
  return select(sphere & cone.outside, cone.pdf(),
                per_solid_angle(select(sphere, sphere_density(patch), density), from, p, normal));
}

}  // namespace raytrace
