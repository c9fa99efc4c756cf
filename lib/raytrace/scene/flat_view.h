// Triangles and parallelograms as light is drawn from them.
#pragma once

#include <array>
#include <numbers>

#include "raytrace/math/turns.h"
#include "raytrace/scene/patch_sampling.h"

namespace raytrace {

inline MaskN is(const PatchRecord<FloatN>& patch, PatchShape shape) {
  const IntN shapes = same_bits<IntN>(patch.code) & IntN((1 << PatchCode::shape_bits) - 1);
  return float_mask<FloatN>(shapes == IntN(static_cast<std::int32_t>(shape)));
}

/// A spherical triangle: unit vectors to its corners, `apex` the corner that lines of points start at.
struct SphericalTriangle {
  Vec3<FloatN> first, apex, last;
  FloatN volume;       ///< of the three vectors
  FloatN denominator;  ///< volume / denominator is the tangent of half the solid angle

  MaskN is_near(const FloatN& least) const {
    // Lines from the apex to its opposite would go anywhere.
    const FloatN from_opposite = FloatN(1) + min(dot(apex, first), dot(apex, last));
    return (volume > least * abs(denominator)) & (from_opposite > FloatN(0x1p-10F));
  }
  FloatN half_turns() const { return turns(volume, denominator); }  ///< half the solid angle over 2 pi

  /// The direction for u2, on the arc that cuts off a part from `first` on whose solid angle's half is that.
  Vec3<FloatN> direction(const FloatN& part_half_turns, const FloatN& u2) const {
    const auto [sine, cosine] = sin_cos_of_turns(part_half_turns);
    const FloatN to_first = FloatN(1) + dot(first, apex);
    const Vec3<FloatN> middle = first * (volume * cosine - sine * dot(last, first + apex)) + last * (sine * to_first);
    const Vec3<FloatN> end = middle * (FloatN(2) * dot(first, middle) / dot(middle, middle)) - first;
    // Evenly in the cosine along the arc from apex to end, written in the chord: 1 - cosine would cancel.
    const Vec3<FloatN> chord = end - apex;
    const FloatN square = min(dot(chord, chord), FloatN(3.9999F));
    const FloatN t = sqrt(u2 * (FloatN(4) - u2 * square) / (FloatN(4) - square));
    return apex * (FloatN(1) - t + FloatN(0.5F) * square * (t - u2)) + end * t;
  }
};

/// A triangle or parallelogram as it is from a point: one or two spherical triangles.
struct FlatView {
  /// Where patches are near, by the tangent of half the solid angle: even ones, and such whose textures are not.
  static constexpr float near_even = 0x1p-8F, near_uneven = 0.1F;

  Vec3<FloatN> to_origin;
  std::array<SphericalTriangle, 2> triangles;  ///< a triangle is the first
  MaskN near;
  std::array<FloatN, 2> half_turns{};  ///< of solid angle, where any lane is near
  MaskN uneven{false};                 ///< whether textures are
  FloatN share;                        ///< where they are: how dense points drawn evenly in light are, on the mean 1

  FlatView(const PatchRecord<FloatN>& patch, const Vec3<FloatN>& from, const PatchTextures* textures)
      : to_origin(patch.origin - from) {
    FloatN least(near_even);
    if (textures != nullptr) {
      uneven = textures->shares.uneven(textures->patch);
      least = select(uneven, FloatN(near_uneven), least);
    }
    const MaskN is_triangle = is(patch, PatchShape::triangle);
    const FloatN height = abs(dot(to_origin, cross(patch.a, patch.b)));
    const Vec3<FloatN> second = to_origin + patch.a, fourth = to_origin + patch.b;
    const Vec3<FloatN> third = select(is_triangle, fourth, second + patch.b);
    const FloatN inverse1 = FloatN(1) / length(to_origin), inverse2 = FloatN(1) / length(second),
                 inverse3 = FloatN(1) / length(third), inverse4 = FloatN(1) / length(fourth);
    const Vec3<FloatN> apex = to_origin * inverse1, w2 = second * inverse2, w3 = third * inverse3,
                       w4 = fourth * inverse4;
    const FloatN volume = height * inverse1 * inverse3, diagonal = FloatN(1) + dot(apex, w3);
    triangles = {{{w2, apex, w3, volume * inverse2, diagonal + dot(w2, apex + w3)},
                  {w3, apex, w4, volume * inverse4, diagonal + dot(w4, apex + w3)}}};
    near = triangles[0].is_near(least) & (is_triangle | triangles[1].is_near(least));
    if (any(near)) half_turns = {triangles[0].half_turns(), select(is_triangle, FloatN(0), triangles[1].half_turns())};
  }
  /// by_area: the density where points are drawn by area.
  FloatN pdf(const FloatN& by_area) const {
    const FloatN by_angle = FloatN(1 / (4 * std::numbers::pi_v<float>)) / (half_turns[0] + half_turns[1]);
    return select(uneven, (by_area + by_angle) * FloatN(0.5F), by_angle);
  }

  /// How far along a and b the drawn point is.
  std::array<FloatN, 2> sample(const PatchRecord<FloatN>& patch, const FloatN& u1, const FloatN& u2) const {
    const FloatN part = u1 * (half_turns[0] + half_turns[1]), rest = part - half_turns[0];
    const MaskN in_first = rest < FloatN(0);
    const auto& [one, two] = triangles;
    const SphericalTriangle chosen{select(in_first, one.first, two.first), one.apex,
                                   select(in_first, one.last, two.last), select(in_first, one.volume, two.volume),
                                   FloatN(0)};
    const Vec3<FloatN> direction = chosen.direction(select(in_first, part, rest), u2);
    const Vec3<FloatN> across = cross(direction, patch.b), moment = cross(patch.a, to_origin);
    const FloatN inverse = FloatN(1) / dot(patch.a, across);
    const FloatN along_a = -dot(to_origin, across) * inverse, along_b = dot(direction, moment) * inverse;
    const FloatN u = min(max(along_a, FloatN(0)), FloatN(1));
    return {u, min(max(along_b, FloatN(0)), select(is(patch, PatchShape::triangle), FloatN(1) - u, FloatN(1)))};
  }
};

/// How far along a and b of a flat patch the point is that is drawn evenly in area out of u1 and u2. Triangles by
/// halves of the square: Heitz, "A Low-Distortion Map Between Triangle and Square", 2019.
inline Vec2<FloatN> flat_point(const MaskN& triangle, const FloatN& u1, const FloatN& u2) {
  const MaskN below = u1 < u2;
  const FloatN half1 = u1 * FloatN(0.5F), half2 = u2 * FloatN(0.5F);
  return {select(triangle, select(below, half1, u1 - half2), u1),
          select(triangle, select(below, u2 - half1, half2), u2)};
}

/// The way back.
inline Vec2<FloatN> square_of(const MaskN& triangle, const Vec2<FloatN>& point) {
  const FloatN &u = point.x, &v = point.y, both = u + v;
  const MaskN below = u < v;
  return {select(triangle, select(below, u + u, both), u), select(triangle, select(below, both, v + v), v)};
}

}  // namespace raytrace
