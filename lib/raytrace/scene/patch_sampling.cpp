#include "raytrace/scene/patch_sampling.h"

#include <array>
#include <numbers>
#include <optional>

#include "raytrace/math/frame.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/surface_uv.h"
#include "raytrace/math/unit_disk.h"
#include "raytrace/scene/flat_view.h"

namespace raytrace {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
/// By how many times a patch's points may be farther off the surface that rays meet than rounding alone puts them.
FloatN error_factor(const PatchRecord<FloatN>& patch) {
  const IntN instanced = same_bits<IntN>(patch.code) & IntN(PatchCode::instanced);
  return select(float_mask<FloatN>(instanced == IntN(0)), FloatN(1), FloatN(32));
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
  Vec3<FloatN> axis;        ///< from the center to the point, of unit length
  FloatN distance;          ///< from there to there
  MaskN outside;            ///< so far that it is no point of the sphere itself, which its inside lights
  FloatN sine2;             ///< of half the cone's angle, squared
  FloatN one_minus_cosine;  ///< of that angle, without cancellation

  /// way: from the center to the point; margin: how far above the sphere its own points may be.
  SphereCone(const FloatN& radius, const Vec3<FloatN>& way, const FloatN& margin) {
    constexpr float least = 1e-37F;
    const FloatN squared = max(dot(way, way), FloatN(least)), radius2 = radius * radius, far = radius + margin;
    distance = sqrt(squared);
    axis = way * (FloatN(1) / distance);
    outside = squared > far * far;
    sine2 = min(max(radius2 / squared, FloatN(least)), FloatN(1));
    one_minus_cosine = sine2 / (FloatN(1) + sqrt(FloatN(1) - sine2));
  }
  FloatN pdf() const { return FloatN(1 / (2 * pi)) / one_minus_cosine; }
};

/// How far off the surface its own points may be, as rays see it that start there. size: of the patch.
FloatN margin_of(const PatchRecord<FloatN>& patch, const Vec3<FloatN>& from, const FloatN& size) {
  return rounding_error(from, max(largest_component(patch.origin), size)) * error_factor(patch) * FloatN(4);
}

SphereCone cone_of(const PatchRecord<FloatN>& sphere, const Vec3<FloatN>& from) {
  return {sphere.a.x, from - sphere.origin, margin_of(sphere, from, sphere.a.x)};
}

/// An ellipsoid, as where a map takes the unit sphere: points drawn on that, mapped, and its cone of directions.
struct Ellipsoid {
  struct Symmetric {
    Vec3<FloatN> x, y, z;
    Vec3<FloatN> operator()(const Vec3<FloatN>& v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
  };
  FloatN size;             ///< about that; the maps are without it
  Symmetric map, inverse;  ///< from the unit sphere, and back
  FloatN determinant;

  explicit Ellipsoid(const PatchRecord<FloatN>& patch) : size((patch.a.x + patch.a.y + patch.a.z) * FloatN(1.0F / 3)) {
    const FloatN scale = FloatN(1) / size;
    const Vec3<FloatN> a = patch.a * scale, b = patch.b * scale;
    map = {{a.x, b.z, b.y}, {b.z, a.y, b.x}, {b.y, b.x, a.z}};
    const Vec3<FloatN> x = cross(map.y, map.z), y = cross(map.z, map.x), z = cross(map.x, map.y);
    determinant = dot(map.x, x);
    const FloatN by_determinant = FloatN(1) / determinant;
    inverse = {x * by_determinant, y * by_determinant, z * by_determinant};
  }
  Vec3<FloatN> to_unit(const Vec3<FloatN>& way) const { return inverse(way * (FloatN(1) / size)); }
  SphereCone cone(const PatchRecord<FloatN>& patch, const Vec3<FloatN>& from) const {
    const FloatN narrow = length(inverse.x) + length(inverse.y) + length(inverse.z);  // no less than how narrow it is
    return {FloatN(1), to_unit(from - patch.origin), margin_of(patch, from, size) * narrow / size};
  }
  /// Where directions of the unit sphere's cone are drawn evenly.
  FloatN cone_pdf(const SphereCone& cone, const Vec3<FloatN>& way) const {
    const FloatN stretch = length(way) / (size * length(to_unit(way)));
    return cone.pdf() * stretch * stretch * stretch / determinant;
  }
  /// Where points of the unit sphere are.
  FloatN density(const Vec3<FloatN>& normal) const {
    return FloatN(1 / (4 * pi)) * length(map(normal)) / (determinant * size * size);
  }
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

/// An ellipse, as where a map takes the unit disk, or a ring of it.
struct Ellipse {
  FloatN hole;  ///< how large it is
  Vec3<FloatN> across, other_axis;

  explicit Ellipse(const PatchRecord<FloatN>& patch)
      : hole(max(dot(patch.a, patch.b) / dot(patch.a, patch.a), FloatN(0))),
        across(cross(patch.a, patch.b)),
        other_axis(patch.b - patch.a * hole) {}
  FloatN ring() const { return (FloatN(1) - hole) * (FloatN(1) + hole); }  ///< the part of the disk that it is
  FloatN density() const { return FloatN(1 / pi) / (ring() * length(across)); }
};

void set(const MaskN& here, const Vec3<FloatN>& from, const Vec3<FloatN>& p, const Vec3<FloatN>& normal,
         const FloatN& size, PatchSample& result) {
  result.p = select(here, p, result.p);
  result.way = select(here, p - from, result.way);
  result.normal = select(here, normal, result.normal);
  result.error = select(here, rounding_error(p, size), result.error);
}

/// view: its share is set.
void sample_flat(const PatchRecord<FloatN>& patch, const MaskN& here, const Vec3<FloatN>& from,
                 const PatchTextures* textures, const FloatN& u1, const FloatN& u2, FlatView& view,
                 PatchSample& result) {
  const MaskN triangle = is(patch, PatchShape::triangle);
  MaskN by_angle = view.near;
  FloatN first = u1;
  Vec2<FloatN> square{u1, u2};
  if (any(view.uneven)) {
    const MaskN lower = u1 < FloatN(0.5F);
    by_angle = view.near & (lower | !view.uneven);
    first = select(view.near & view.uneven, u1 + u1 - select(lower, FloatN(0), FloatN(1)), u1);
    const PatchShares::Draw drawn = textures->shares.draw(textures->patch, first, u2);
    square = {select(view.uneven, drawn.square.x, u1), select(view.uneven, drawn.square.y, u2)};
    view.share = drawn.density;
  }
  const Vec2<FloatN> point = flat_point(triangle, square.x, square.y);
  result.u = point.x;
  result.v = point.y;
  if (any(by_angle)) {
    const auto [u, v] = view.sample(patch, first, u2);
    result.u = select(by_angle, u, result.u);
    result.v = select(by_angle, v, result.v);
    if (any(by_angle & view.uneven))
      view.share = select(by_angle, textures->shares.density(textures->patch, square_of(triangle, {u, v})), view.share);
  }
  const Vec3<FloatN> across = cross(patch.a, patch.b);
  set(here, from, patch.origin + patch.a * result.u + patch.b * result.v, across * (FloatN(1) / length(across)),
      max(largest_component(patch.a), largest_component(patch.b)), result);
  result.way = select(here, view.to_origin + patch.a * result.u + patch.b * result.v, result.way);
}

/// A point drawn on a sphere.
struct SpherePoint {
  Vec3<FloatN> normal;  ///< there, out
  Vec3<FloatN> way;     ///< to it, where the cone's point is outside
};
SpherePoint point_on_sphere(const SphereCone& cone, const FloatN& radius, const FloatN& u1, const FloatN& u2) {
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
  const Frame<FloatN> frame(cone.axis);
  // In the cone, by the angle there: near a large sphere, points of it are too coarse.
  const FloatN to_axis = FloatN(1) - one_minus_cosine;
  const FloatN far = (cone.distance - radius) * (cone.distance + radius) /
                     (cone.distance * to_axis + radius * sqrt(FloatN(1) - share));
  const FloatN aside = sqrt(sine2) / max(sqrt(radius2), FloatN(1e-18F));
  return {frame.to_world({point.x * across, point.y * across, cosine}),
          frame.to_world({point.x * aside, point.y * aside, -to_axis}) * far};
}

void sample_sphere(const PatchRecord<FloatN>& patch, const MaskN& here, const Vec3<FloatN>& from, const FloatN& u1,
                   const FloatN& u2, PatchSample& result) {
  const SphereCone cone = cone_of(patch, from);
  const SpherePoint point = point_on_sphere(cone, patch.a.x, u1, u2);
  set(here, from, patch.origin + point.normal * patch.a.x, point.normal, patch.a.x, result);
  result.way = select(here & cone.outside, point.way, result.way);
}

void sample_ellipsoid(const PatchRecord<FloatN>& patch, const MaskN& here, const Vec3<FloatN>& from, const FloatN& u1,
                      const FloatN& u2, PatchSample& result) {
  const Ellipsoid ellipsoid(patch);
  const SphereCone cone = ellipsoid.cone(patch, from);
  const SpherePoint point = point_on_sphere(cone, FloatN(1), u1, u2);
  const FloatN& size = ellipsoid.size;
  set(here, from, patch.origin + ellipsoid.map(point.normal) * size, normalize(ellipsoid.inverse(point.normal)), size,
      result);
  result.way = select(here & cone.outside, ellipsoid.map(point.way) * size, result.way);
}

void sample_ellipse(const PatchRecord<FloatN>& patch, const MaskN& here, const Vec3<FloatN>& from, const FloatN& u1,
                    const FloatN& u2, PatchSample& result) {
  const Ellipse ellipse(patch);
  const DiskPoint<FloatN> point = on_unit_disk(u1, u2);
  const FloatN radius2 = max(point.x * point.x + point.y * point.y, FloatN(1e-37F));
  const FloatN outwards = sqrt(ellipse.ring() + ellipse.hole * ellipse.hole / radius2);
  set(here, from, patch.origin + patch.a * (point.x * outwards) + ellipse.other_axis * (point.y * outwards),
      normalize(ellipse.across), max(largest_component(patch.a), largest_component(patch.b)), result);
}

void sample_band(const PatchRecord<FloatN>& band, const MaskN& here, const Vec3<FloatN>& from, const FloatN& u1,
                 const Vec3<FloatN>& outwards, PatchSample& result) {
  const auto& [first, last, height] = band.b;
  const FloatN rise = last - first;
  const FloatN radius = sqrt(max(first * first + u1 * (last - first) * (last + first), FloatN(0)));
  const FloatN along = u1 * (first + last) / max(first + radius, FloatN(1e-37F));
  const FloatN slope = FloatN(1) / sqrt(rise * rise + height * height);
  set(here, from, band.origin + band.a * (height * along) + outwards * radius,
      outwards * (height * slope) - band.a * (rise * slope), max(max(first, last), height), result);
}

void sample_torus(const PatchRecord<FloatN>& torus, const MaskN& here, const Vec3<FloatN>& from, const FloatN& u1,
                  const Vec3<FloatN>& outwards, PatchSample& result) {
  const auto [sine, cosine] = sin_cos_of_turns(u1);
  const Vec3<FloatN> normal = outwards * cosine + torus.a * sine;
  set(here, from, torus.origin + outwards * torus.b.x + normal * torus.b.y, normal, torus.b.x + torus.b.y, result);
}

/// patch_pdf(). view: where any lane's patch is flat.
FloatN density(const PatchRecord<FloatN>& patch, const std::optional<FlatView>& view, const Vec3<FloatN>& from,
               const Vec3<FloatN>& p, const Vec3<FloatN>& normal) {
  const MaskN sphere = is(patch, PatchShape::sphere), ellipsoid = is(patch, PatchShape::ellipsoid),
              band = is(patch, PatchShape::band), torus = is(patch, PatchShape::torus),
              ellipse = is(patch, PatchShape::ellipse), flat = !(sphere | ellipsoid | band | torus | ellipse);
  FloatN per_area = flat_density(patch);
  if (view && any(view->uneven)) per_area = select(view->uneven, per_area * view->share, per_area);
  if (any(band)) per_area = select(band, band_density(patch), per_area);
  if (any(torus)) per_area = select(torus, torus_density(patch, p), per_area);
  if (any(ellipse)) per_area = select(ellipse, Ellipse(patch).density(), per_area);
  if (any(sphere)) per_area = select(sphere, sphere_density(patch), per_area);
  FloatN pdf = per_solid_angle(per_area, from, p, normal);
  if (any(sphere)) {
    const SphereCone cone = cone_of(patch, from);
    pdf = select(sphere & cone.outside, cone.pdf(), pdf);
  }
  if (any(ellipsoid)) {
    const Ellipsoid one(patch);
    const SphereCone cone = one.cone(patch, from);
    const FloatN inside = per_solid_angle(one.density(normal), from, p, normal);
    pdf = select(ellipsoid, select(cone.outside, one.cone_pdf(cone, p - from), inside), pdf);
  }
  if (view && any(view->near)) pdf = select(flat & view->near, view->pdf(pdf), pdf);
  return pdf;
}

}  // namespace

PatchSample sample_patch(const PatchRecord<FloatN>& patch, const Vec3<FloatN>& from, const FloatN& u1, const FloatN& u2,
                         const PatchTextures* textures) {
  const MaskN sphere = is(patch, PatchShape::sphere), ellipsoid = is(patch, PatchShape::ellipsoid),
              band = is(patch, PatchShape::band), torus = is(patch, PatchShape::torus),
              ellipse = is(patch, PatchShape::ellipse), flat = !(sphere | ellipsoid | band | torus | ellipse);
  PatchSample result{};
  std::optional<FlatView> view;
  if (any(flat)) {
    view.emplace(patch, from, textures);
    sample_flat(patch, flat, from, textures, u1, u2, *view, result);
  }
  if (any(sphere)) sample_sphere(patch, sphere, from, u1, u2, result);
  if (any(ellipsoid)) sample_ellipsoid(patch, ellipsoid, from, u1, u2, result);
  if (any(ellipse)) sample_ellipse(patch, ellipse, from, u1, u2, result);
  if (any(band | torus)) {
    const auto [sine, cosine] = sin_cos_of_turns(u2);
    const Frame<FloatN> frame(select(band | torus, patch.a, Vec3<FloatN>(Vec3f(0, 0, 1))));
    const Vec3<FloatN> outwards = frame.x * cosine + frame.y * sine;
    if (any(band)) sample_band(patch, band, from, u1, outwards, result);
    if (any(torus)) sample_torus(patch, torus, from, u1, outwards, result);
  }
  result.error = result.error * error_factor(patch);
  result.pdf = density(patch, view, from, result.p, result.normal);
  return result;
}

FloatN patch_pdf(const PatchRecord<FloatN>& patch, const Vec3<FloatN>& from, const Vec3<FloatN>& p,
                 const Vec3<FloatN>& normal, const PatchTextures* textures) {
  std::optional<FlatView> view;
  if (const MaskN triangle = is(patch, PatchShape::triangle); any(triangle | is(patch, PatchShape::parallelogram))) {
    view.emplace(patch, from, textures);
    if (any(view->uneven)) {
      const Vec3<FloatN> way = p - patch.origin, across = cross(patch.a, patch.b);
      const FloatN scale = FloatN(1) / dot(across, across);
      view->share = textures->shares.density(
          textures->patch,
          square_of(triangle, {dot(cross(way, patch.b), across) * scale, dot(cross(patch.a, way), across) * scale}));
    }
  }
  return density(patch, view, from, p, normal);
}

}  // namespace raytrace
