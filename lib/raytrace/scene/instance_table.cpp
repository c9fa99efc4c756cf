#include "raytrace/scene/instance_table.h"

namespace raytrace {

namespace {

AffineRecord<float> to_float(const Affine& a) { return {Vec3f(a.x), Vec3f(a.y), Vec3f(a.z), Vec3f(a.origin)}; }

}  // namespace

void InstanceTable::add(const InstanceTarget& target, const Affine& world_from_object, const Bounds& bounds,
                        std::int32_t object, std::int32_t material) {
  targets_.push_back(target);
  world_from_object_.push_back(to_float(world_from_object));
  object_from_world_.push_back(to_float(world_from_object.inverse()));
  bounds_.push_back(bounds);
  scales_.push_back(static_cast<float>(world_from_object.uniform_scale().value_or(0)));
  groups_.push_back(target.group);
  objects_.push_back(object);
  materials_.push_back(material);
}

Bounds transformed_bounds(const Affine& affine, const Bounds& box) {
  const Vec3d lower(box.lower), upper(box.upper);
  const Vec3d center = affine.point((lower + upper) * 0.5), half = (upper - lower) * 0.5;
  const auto reach = [&](double x, double y, double z, double at) {
    const double extent = std::abs(x) * half.x + std::abs(y) * half.y + std::abs(z) * half.z;
    // By more than the rounding of rays on their way there, which are floats.
    return extent + (extent + std::abs(at)) * 0x1p-20;
  };
  return bounds_around(
      center, {reach(affine.x.x, affine.y.x, affine.z.x, center.x), reach(affine.x.y, affine.y.y, affine.z.y, center.y),
               reach(affine.x.z, affine.y.z, affine.z.z, center.z)});
}

}  // namespace raytrace
