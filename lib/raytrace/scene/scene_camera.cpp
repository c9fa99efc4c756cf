// The camera of SceneTables.
#include <utility>
#include <variant>

#include "raytrace/description/motion.h"
#include "raytrace/math/lanes.h"
#include "raytrace/sampling/ray_ids.h"
#include "raytrace/scene/scene_tables.h"

namespace raytrace {

namespace {

template <class CameraKernel>
constexpr bool has_lens = requires(const CameraKernel& camera, const FloatN& f) { camera.generate(f, f, f, f); };

template <class F, class CameraKernel>
Ray<F> generate(const CameraKernel& camera, const F& x, const F& y, const Sample2D& lens) {
  if constexpr (has_lens<CameraKernel>)
    return camera.generate(x, y, lens.x, lens.y);
  else
    return camera.generate(x, y);
}

/// The third column turns points into -z, behind the camera.
Vec3f direction_of(const CameraMatrices& matrices) {
  const float* const m = matrices.world_to_camera;
  return {-m[2], -m[6], -m[10]};
}

}  // namespace

void SceneTables::set_camera(const SceneDescription& description) {
  for_each_type(Cameras{}, [&]<class Type>(std::type_identity<Type>) {
    const auto* parameters = std::get_if<typename Type::Parameters>(&description.camera);
    if (parameters == nullptr) return;
    const Kernel<Type> camera(moved<Type>(*parameters), viewplane_);
    camera_ = camera;
    for (const CameraParameters& moment : description.moving_camera)
      moving_camera_.push_back(Kernel<Type>(moved<Type>(std::get<typename Type::Parameters>(moment)), viewplane_));
    const auto near_clip_of = [](const auto& its) {
      if constexpr (requires { its.nearclip; })
        return static_cast<float>(its.nearclip);
      else
        return 0.0F;
    };
    near_clip_ = near_clip_of(*parameters);
    for (const CameraParameters& moment : description.moving_camera)
      moving_near_clips_.push_back(near_clip_of(std::get<typename Type::Parameters>(moment)));
    camera_has_lens_ = has_lens<Kernel<Type>>;
    set_ray_cone(camera);
    camera_eye_ = Vec3f(parameters->eye - origin_);
    if constexpr (requires { camera.origin(); })
      if (!camera_is_far() && moving_camera_.empty() && !has_near_clip())
        camera_origin_ = BufferOrigin{camera.origin()};
    const CameraMatrices matrices = Type::matrices(*parameters, viewplane_);
    viewing_direction_ = direction_of(matrices);
    depth_is_distance_ = !matrices.is_projection;
    for (const CameraParameters& moment : description.moving_camera)
      moving_directions_.push_back(
          direction_of(Type::matrices(std::get<typename Type::Parameters>(moment), viewplane_)));
  });
}

template <class CameraKernel>
void SceneTables::set_ray_cone(const CameraKernel& camera) {
  // By two rays about the view's axis, a pixel apart; in double, since they are almost the same.
  using D = Doubles<FloatN>;
  const Sample2D middle_of_lens{FloatN(0.5F), FloatN(0.5F)};
  Vec2d axis{0, 0};
  if constexpr (requires { camera.axis(); }) axis = camera.axis();
  const Ray<D> middle = generate<D>(camera, D(axis.x), D(axis.y), middle_of_lens);
  const Ray<D> beside = generate<D>(camera, D(axis.x + 1), D(axis.y), middle_of_lens);
  const auto apart = [](const Vec3<D>& a, const Vec3<D>& b) { return length(to_float(b - a)).get(0); };
  ray_cone_ = {apart(middle.origin, beside.origin), apart(middle.direction, beside.direction)};
}

bool SceneTables::camera_is_far_from(const BoundingSphere& sphere, const SceneDescription& description) const {
  constexpr double far = 256;  // radii: a float's rounding at that distance is some 1 / 65,000 of one
  const Vec3d eye = std::visit([](const auto& parameters) { return parameters.eye; }, description.camera) - origin_;
  return sphere.radius >= 0 && length(eye - sphere.center) > far * sphere.radius;
}

std::optional<FilmPoint> SceneTables::project(const Vec3d& p, const Sample2D& lens, std::size_t lane) const {
  auto point = std::visit(
      [&]<class CameraKernel>(const CameraKernel& camera) {
        if constexpr (has_lens<CameraKernel>)
          return camera.project(p, lens.x, lens.y, lane);
        else
          return camera.project(p);
      },
      *camera_);
  if (point && has_near_clip()) {
    const double depth = dot(p - point->from, Vec3d(viewing_direction_)), near = near_clip_;
    if (!(depth > near)) return std::nullopt;
    point->seen = 1 - near / depth;
  }
  return point;
}

template <class F, class CameraKernel>
Ray<F> SceneTables::rays_of(const CameraKernel& camera, const FloatN& x, const FloatN& y, const Sample2D& lens,
                            const CameraRays& ids) const {
  // How far along a ray what it may see begins.
  const auto set_near = [&](Ray<F>& rays, const Vec3f& viewing_direction, float near_clip) {
    if (has_near_clip()) rays.near = F(near_clip) / dot(rays.direction, Vec3<F>(viewing_direction));
  };
  if (moving_camera_.empty()) [[likely]] {
    Ray<F> rays = generate<F>(camera, F(x), F(y), lens);
    set_near(rays, viewing_direction_, near_clip_);
    return rays;
  }
  const FloatN place = RayIds{ids.pixel, ids.sample, 0}.times() * FloatN(shutter_moments - 1);
  const IntN before = min(to_int(place), IntN(shutter_moments - 2));
  const F part(place - to_float(before));
  Ray<F> result = generate<F>(camera, F(x), F(y), lens);
  for (MaskN left(true); any(left);) {
    const auto moment = static_cast<std::size_t>(before.get(first_lane(left)));
    const FloatN number(static_cast<float>(moment));
    const F whole(to_float(before));
    const auto here = (whole > F(number - FloatN(0.5F))) & (whole < F(number + FloatN(0.5F)));
    const auto at = [&](std::size_t i) {
      Ray<F> rays = generate<F>(std::get<CameraKernel>(moving_camera_[i]), F(x), F(y), lens);
      set_near(rays, moving_directions_[i], moving_near_clips_[i]);
      return rays;
    };
    const Ray<F> a = at(moment), b = at(moment + 1);
    result.origin = select(here, a.origin + (b.origin - a.origin) * part, result.origin);
    result.direction = select(here, normalize(a.direction + (b.direction - a.direction) * part), result.direction);
    result.near = select(here, a.near + (b.near - a.near) * part, result.near);
    left = left & (to_float(before) != number);
  }
  return result;
}

MaskN SceneTables::set_camera_rays(const FloatN& x, const FloatN& y, const Sample2D& lens, CameraRays& result) const {
  return std::visit(
      [&](const auto& camera) {
        if (camera_is_far()) {
          const CameraRays far = rays_at(*camera_target_, rays_of<Doubles<FloatN>>(camera, x, y, lens, result));
          result.rays = far.rays;
          result.skipped = far.skipped;
        } else {
          result.rays = rays_of<FloatN>(camera, x, y, lens, result);
          result.skipped = FloatN(0);
          if (has_near_clip()) {
            // They start there, in what medium is there.
            Ray<FloatN>& rays = result.rays;
            result.skipped = std::exchange(rays.near, FloatN(0));
            rays.origin = rays.at(result.skipped);
          }
        }
        if constexpr (requires { camera.has_ray(x, y); })
          return camera.has_ray(x, y);
        else
          return MaskN(true);
      },
      *camera_);
}

}  // namespace raytrace
