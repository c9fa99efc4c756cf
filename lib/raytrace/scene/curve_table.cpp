#include "raytrace/scene/curve_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "raytrace/math/lanes.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

namespace {

/// A corner is one, and not part of a smooth curve, if pieces turn by more: cosines.
constexpr double sharpest = 0.8;

/// Level and upright for one that an axis points to, as TangentFrame has it.
struct AxisFrame {
  Vec3d right, up;

  explicit AxisFrame(const Vec3d& axis) {
    const double level = std::hypot(axis.x, axis.z);
    right = level > 1e-6 ? Vec3d(axis.z / level, 0, -axis.x / level) : Vec3d(1, 0, 0);
    up = cross(axis, right);
  }
  /// Anticlockwise about the axis from the lowest place, in turns from -1/2 to 1/2.
  double turns(const Vec3d& v) const {
    const double x = -dot(v, up), y = dot(v, right);
    return x == 0 && y == 0 ? 0 : std::atan2(y, x) / (2 * std::numbers::pi);
  }
  Vec3d at(double turns) const {
    const double angle = turns * 2 * std::numbers::pi;
    return right * std::sin(angle) - up * std::cos(angle);
  }
};

/// By the least turn from one direction to another, which is not its opposite.
Vec3d turned(const Vec3d& v, const Vec3d& from, const Vec3d& to) {
  const Vec3d half = from + to;
  const double square = dot(half, half);
  if (square < 1e-12) return v;
  // Two mirrorings.
  const Vec3d once = v - from * (2 * dot(v, from));
  return once - half * (2 * dot(once, half) / square);
}

/// Lane by lane: vectors of floats, as packets have them.
struct LaneVectors {
  alignas(64) std::array<float, packet_lanes> x{}, y{}, z{};

  void set(std::size_t lane, const Vec3d& v) {
    x[lane] = static_cast<float>(v.x);
    y[lane] = static_cast<float>(v.y);
    z[lane] = static_cast<float>(v.z);
  }
  Vec3<FloatN> load() const {
    return {FloatN::load_aligned(x.data()), FloatN::load_aligned(y.data()), FloatN::load_aligned(z.data())};
  }
};

}  // namespace

CurveTable::CurveTable(const ObjectItem<Curve>& curve, const Vec3d& origin, std::int32_t material,
                       std::span<const std::uint8_t> fibres, int threads)
    : data_(curve.data), material_(material), fibres_(fibres.begin(), fibres.end()) {
  Affine affine = curve.transform.affine();
  const double scale = curve.transform.empty() ? 1 : affine.uniform_scale().value_or(1);
  Affine to_world = affine;
  to_world.origin += -origin;
  object_from_world_ = to_float(to_world.inverse());
  affine.origin = affine.point(data_->origin) + -origin;
  if (!affine.is_identity()) move(affine, scale, threads);
  std::vector<Bounds> chunks(chunk_count(point_count()), empty_bounds);
  for_each_chunk(point_count(), threads, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      chunks[chunk] = join(chunks[chunk], bounds_around(point(i), {radius(i), radius(i), radius(i)}));
  });
  for (const Bounds& chunk : chunks) bounds_ = join(bounds_, chunk);
  set_turns();
}

void CurveTable::move(const Affine& affine, double scale, int threads) {
  moved_ = MeshBuffer<float>(4 * point_count());
  for_each_chunk(point_count(), threads, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      const float* const p = data_->points.data() + 4 * i;
      const Vec3d moved = affine.point({p[0], p[1], p[2]});
      // As far as Embree takes them.
      const auto limited = [](double x) { return static_cast<float>(std::clamp(x, -5e17, 5e17)); };
      const float values[] = {limited(moved.x), limited(moved.y), limited(moved.z), limited(p[3] * scale)};
      std::copy_n(values, 4, &moved_[4 * i]);
    }
  });
}

void CurveTable::set_turns() {
  turns_.resize(point_count());
  Vec3d start{}, before{};  // where v begins on the piece before, and its direction
  for (std::size_t i = 0; i < point_count(); ++i) {
    if (!has_piece(i)) continue;
    const Vec3d axis = cone(i).axis;
    const AxisFrame frame(axis);
    start = has_before(i) ? turned(start, before, axis) : frame.at(0);
    turns_[i] = static_cast<float>(frame.turns(start));
    before = axis;
  }
}

Vec3d CurveTable::tangent_at(std::size_t i, const Vec3d& of_piece) const {
  if (!data_->is_smooth || is_root(i) || !has_piece(i)) return of_piece;
  const Vec3d before = cone(i - 1).axis, behind = cone(i).axis;
  return dot(before, behind) < sharpest ? of_piece : normalize(before + behind);
}

CurveTable::Place CurveTable::place(std::size_t piece, const Vec3d& p) const {
  Place place{cone(piece), {}, {}, {}, {}, 0, 0};
  const RoundCone& cone = place.cone;
  const double foot = cone.foot_of(p);
  place.share = cone.length > 0 ? foot / cone.length : 0;
  place.radius = cone.radius + (cone.end_radius - cone.radius) * place.share;
  const Vec3d center = cone.start + cone.axis * foot, from = p - center;
  const double distance = length(from);
  // At a tip, along the axis.
  place.normal = distance > 0 ? from * (1 / distance) : cone.axis * (place.share > 0.5 ? 1.0 : -1.0);
  place.position = center + place.normal * place.radius;
  place.tangent =
      normalize(tangent_at(piece, cone.axis) * (1 - place.share) + tangent_at(piece + 1, cone.axis) * place.share);
  // At the strand's ends, the spheres' own.
  const bool on_end = (foot <= cone.first_foot && !has_before(piece)) || (foot >= cone.last_foot && !has_behind(piece));
  const Vec3d across = place.normal - place.tangent * dot(place.normal, place.tangent);
  const double size = length(across);
  place.smooth_normal = on_end || !data_->is_smooth || size < 0.1
                            ? place.normal
                            : across * (cone.cosine / size) + place.tangent * cone.sine;
  return place;
}

void CurveTable::set_surface(const IntN& pieces, const Ray<FloatN>& rays, const MaskN& lanes,
                             SurfaceInteraction<FloatN>& result) const {
  LaneVectors position, normal, smooth_normal;
  for (const std::size_t lane : SetLanes(lanes)) {
    const Vec3d p = Vec3d(in_lane(rays.origin, lane)) +
                    Vec3d(in_lane(rays.direction, lane)) * static_cast<double>(rays.far.get(lane));
    const Place here = place(static_cast<std::size_t>(pieces.get(lane)), p);
    position.set(lane, here.position);
    normal.set(lane, here.normal);
    smooth_normal.set(lane, here.smooth_normal);
  }
  result.p = position.load();
  result.ng = normal.load();
  result.ns = smooth_normal.load();
  result.error = rounding_error(result.p, FloatN(0));
  const FloatN slope = dot(result.ng, rays.direction);
  result.front = slope < FloatN(0);
  result.ng = select(slope > FloatN(0), -result.ng, result.ng);
  result.ns = select(dot(result.ns, result.ng) < FloatN(0), -result.ns, result.ns);
}

SurfaceUv<FloatN> CurveTable::uv(const IntN& pieces, const Vec3<FloatN>& position, const MaskN& lanes) const {
  alignas(64) std::array<float, packet_lanes> u{}, v{};
  LaneVectors along, around;
  for (const std::size_t lane : SetLanes(lanes)) {
    const auto piece = static_cast<std::size_t>(pieces.get(lane));
    const Place here = place(piece, Vec3d(in_lane(position, lane)));
    const double first = data_->along[piece], width = std::max(data_->along[piece + 1] - first, 1e-9);
    u[lane] = static_cast<float>(first + width * here.share);
    const double turns = static_cast<double>(turns_[piece]) - AxisFrame(here.cone.axis).turns(here.normal);
    v[lane] = static_cast<float>(turns - std::floor(turns));
    along.set(lane, here.tangent * (here.cone.length / width));
    around.set(lane, cross(here.normal, here.tangent) * (here.radius * 2 * std::numbers::pi));
  }
  return {FloatN::load_aligned(u.data()), FloatN::load_aligned(v.data()), along.load(), around.load()};
}

Rgb<FloatN> CurveTable::color(const IntN& pieces, const FloatN& share, const MaskN& lanes) const {
  LaneVectors colors;
  for (const std::size_t lane : SetLanes(lanes)) {
    const float* const c = data_->colors.data() + 3 * static_cast<std::size_t>(pieces.get(lane));
    const double t = share.get(lane);
    colors.set(lane, Vec3d(c[0], c[1], c[2]) * (1 - t) + Vec3d(c[3], c[4], c[5]) * t);
  }
  const Vec3<FloatN> all = colors.load();
  return {all.x, all.y, all.z};
}

}  // namespace raytrace
