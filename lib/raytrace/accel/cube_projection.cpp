#include "raytrace/accel/cube_projection.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

namespace {

/// Rays from and to further away are Embree's, which cannot take all of them: those here need not be looked at again.
constexpr double most_distance = 1e16;

/// By what part of its length rounding may turn the way from a place to the origin aside, and more.
constexpr double way_rounding = 0x1p-20;

/// More than the rounding of a quotient of floats up to 1.
constexpr double quotient_rounding = 1e-6;

/// What is seen from infinitely far is shown as a picture in the middle of the face z = 1, which is 2 wide and high.
constexpr double picture_size = 1;

/// Of a face, across or up.
constexpr Interval whole_face = {-1 - quotient_rounding, 1 + quotient_rounding};

Vec3d center_of(const BoundedObject& object) { return (Vec3d(object.bounds.lower) + Vec3d(object.bounds.upper)) * 0.5; }

/// Of all b / w for b in `b` and w in `w`, which is positive: what lies on the face.
Interval on_face(const Interval& b, const Interval& w) {
  return {std::max(b.low / (b.low < 0 ? w.low : w.high) - quotient_rounding, whole_face.low),
          std::min(b.high / (b.high > 0 ? w.low : w.high) + quotient_rounding, whole_face.high)};
}

/// What add(sum, object) makes of all objects, from `nothing` on, where the order does not matter; join(sum, another)
/// adds one of others.
template <class Sum, class Add, class Join>
Sum sum_of(std::span<const BoundedObject> objects, int threads, const Sum& nothing, const Add& add, const Join& join) {
  std::vector<Sum> chunks(chunk_count(objects.size()), nothing);
  for_each_chunk(objects.size(), threads, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    Sum here = nothing;
    for (const BoundedObject& object : objects.subspan(first, last - first)) add(here, object);
    chunks[chunk] = here;
  });
  Sum all = nothing;
  for (const Sum& chunk : chunks) join(all, chunk);
  return all;
}

}  // namespace

CubeProjection::CubeProjection(const BufferOrigin& origin, std::span<const BoundedObject> objects, int threads)
    : infinitely_far_(origin.infinitely_far), place_(origin.position) {
  const Vec3d from = infinitely_far_ ? Vec3d(0, 0, 0) : place_;
  struct Reach {
    double farthest = 0;
    Bounds around = empty_bounds;
  };
  const Reach all = sum_of(
      objects, threads, Reach{},
      [&](Reach& reach, const BoundedObject& object) {
        reach.farthest = std::max(reach.farthest, length(center_of(object) - from) + object.radius);
        reach.around = join(reach.around, object.bounds);
      },
      [](Reach& reach, const Reach& other) {
        reach.farthest = std::max(reach.farthest, other.farthest);
        reach.around = join(reach.around, other.around);
      });
  farthest_ = all.farthest;
  around_all_ = all.around;
  if (!is_within_floats()) return;
  // As far again as the objects reach, and more: floors are wider than what stands on them.
  reach_ = static_cast<double>(static_cast<float>(8 * farthest_));
  slack_ = way_rounding * reach_;
  if (infinitely_far_) lay_picture(objects, threads);
}

Bounds CubeProjection::surroundings() const {
  const Vec3d more(slack_, slack_, slack_), center = (Vec3d(around_all_.lower) + Vec3d(around_all_.upper)) * 0.5;
  return bounds_around(center, Vec3d(around_all_.upper) - center + more);
}

bool CubeProjection::is_within_floats() const {
  return (infinitely_far_ ? 0 : length(place_)) + farthest_ < most_distance;
}

void CubeProjection::lay_picture(std::span<const BoundedObject> objects, int threads) {
  place_ = normalize(place_);
  const Vec3d aside = std::abs(place_.x) < 0.6 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  across_ = normalize(cross(aside, place_));
  up_ = cross(place_, across_);
  using Extents = std::array<Interval, 3>;
  constexpr Extents nothing{Interval{1e30, -1e30}, Interval{1e30, -1e30}, Interval{1e30, -1e30}};
  const auto widen = [](Extents& extents, const Extents& more) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      extents[axis] = {std::min(extents[axis].low, more[axis].low), std::max(extents[axis].high, more[axis].high)};
    }
  };
  const Extents all = sum_of(
      objects, threads, nothing,
      [&](Extents& extents, const BoundedObject& object) {
        widen(extents, {extent(object, across_), extent(object, up_), extent(object, place_)});
      },
      widen);
  const double scale = picture_size / std::max(all[0].high - all[0].low, all[1].high - all[1].low);
  across_ = Vec3d(Vec3f(across_ * scale));
  up_ = Vec3d(Vec3f(up_ * scale));
  const auto middle = [scale](const Interval& i) {
    return static_cast<double>(static_cast<float>((i.low + i.high) / 2 * scale));
  };
  start_ = {middle(all[0]), middle(all[1]), static_cast<double>(static_cast<float>(all[2].high + slack_))};
}

/// In the direction of an axis.
Interval CubeProjection::extent(const BoundedObject& object, const Vec3d& axis) const {
  const Vec3d half = (Vec3d(object.bounds.upper) - Vec3d(object.bounds.lower)) * 0.5;
  const double box = std::abs(axis.x) * half.x + std::abs(axis.y) * half.y + std::abs(axis.z) * half.z;
  const double reach = std::min(box, object.radius * length(axis)) + slack_ * length(axis);
  const double middle = dot(axis, center_of(object));
  return {middle - reach, middle + reach};
}

std::optional<ProjectedBounds> CubeProjection::view(const BoundedObject& object) const {
  ProjectedBounds view;
  if (infinitely_far_) {
    const Interval x = extent(object, across_), y = extent(object, up_);
    view.along = {Interval{x.low - start_.x, x.high - start_.x}, Interval{y.low - start_.y, y.high - start_.y},
                  Interval{1, 1}};
    view.nearest = std::max(0.0, start_.z - extent(object, place_).high);
    view.center = {0, 0, 1};
    view.distance = 1;
    view.in_cone = false;
    return view;
  }
  const Vec3d lower(object.bounds.lower), upper(object.bounds.upper);
  for (int axis = 0; axis < 3; ++axis) {
    view.along[static_cast<std::size_t>(axis)] = {component(lower, axis) - component(place_, axis) - slack_,
                                                  component(upper, axis) - component(place_, axis) + slack_};
  }
  view.center = center_of(object) - place_;
  view.distance = length(view.center);
  const double radius = object.radius + slack_;
  if (!(radius <= 0.9 * view.distance)) return std::nullopt;  // nor where one of them is no number
  view.in_cone = true;
  view.sine = radius / view.distance;
  view.cosine = std::sqrt(1 - view.sine * view.sine);
  if (const double inner_radius = object.radius - slack_; object.is_sphere && inner_radius > 0) {
    view.inner_sine = inner_radius / view.distance;
    view.inner_cosine = std::sqrt(1 - view.inner_sine * view.inner_sine);
    // No ray from the place meets its near side further away than the one that touches it.
    const double touching = view.distance * view.inner_cosine + slack_;
    view.behind = touching * touching;
  }
  const auto gap = [](const Interval& i) { return std::max({i.low, -i.high, 0.0}); };
  const Vec3d to_box{gap(view.along[0]), gap(view.along[1]), gap(view.along[2])};
  const double nearest = std::max(length(to_box), view.distance - radius);
  view.nearest = nearest * nearest;
  return view;
}

Vec3d CubeProjection::direction_to(const Vec3f& point) const {
  const Vec3d p(point);
  if (!infinitely_far_) return p - place_;
  return {dot(across_, p) - start_.x, dot(up_, p) - start_.y, 1};
}

EdgePlanes CubeProjection::edge_planes(const BoundedObject& object) const {
  // Where the cross product of two directions is smaller, in proportion, rounding would show in its direction.
  constexpr double least_angle = 1e-6;
  EdgePlanes edge_planes;
  const Vec3d corners[3] = {direction_to(object.corners[0]), direction_to(object.corners[1]),
                            direction_to(object.corners[2])};
  const double side = dot(cross(corners[0], corners[1]), corners[2]) < 0 ? -1 : 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d &a = corners[i], &b = corners[(i + 1) % 3], normal = cross(a, b);
    const double size = length(normal);
    edge_planes.inward[i] = size > least_angle * length(a) * length(b) ? Vec3f(normal * (side / size)) : Vec3f(0, 0, 0);
  }
  const double slack = infinitely_far_ ? 2 * slack_ * std::max(length(across_), length(up_))
                                       : slack_ / (length(center_of(object) - place_) - object.radius);
  edge_planes.slack = static_cast<float>(slack + quotient_rounding);
  return edge_planes;
}

std::optional<FaceRectangle> face_rectangle(int face, const ProjectedBounds& view) {
  // Of the angle between a face's corners and its normal, and more.
  constexpr double corner_sine = 0.8166, corner_cosine = 0.5772;
  const int axis = face / 2;
  const bool negative = face % 2 != 0;
  const double along_normal = (negative ? -1 : 1) * component(view.center, axis);
  if (view.in_cone && along_normal < view.distance * (view.cosine * corner_cosine - view.sine * corner_sine))
    return std::nullopt;
  const auto along = [&](int which) { return view.along[static_cast<std::size_t>(which % 3)]; };
  const Interval depth = negative ? Interval{-along(axis).high, -along(axis).low} : along(axis);
  if (depth.low <= 0) return FaceRectangle{whole_face, whole_face};
  const FaceRectangle rectangle{on_face(along(axis + 1), depth), on_face(along(axis + 2), depth)};
  if (rectangle.across.low > rectangle.across.high || rectangle.up.low > rectangle.up.high) return std::nullopt;
  return rectangle;
}

}  // namespace raytrace
