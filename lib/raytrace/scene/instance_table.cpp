#include "raytrace/scene/instance_table.h"

#include <algorithm>
#include <array>

#include "raytrace/description/motion.h"

namespace raytrace {

void InstanceTable::add(const InstanceTarget& target, const Affine& world_from_object, const Bounds& box,
                        std::int32_t object, std::int32_t material) {
  targets_.push_back(target);
  world_from_object_.push_back(to_float(world_from_object));
  object_from_world_.push_back(to_float(world_from_object.inverse()));
  bounds_.push_back(transformed_bounds(world_from_object, box));
  scales_.push_back(static_cast<float>(world_from_object.uniform_scale().value_or(0)));
  groups_.push_back(target.group);
  objects_.push_back(object);
  materials_.push_back(material);
  first_moments_.push_back(-1);
  if (has_places_in_files()) file_from_object_.push_back(to_float(Affine()));
}

void InstanceTable::set_place_in_file(const Affine& file_from_object) {
  file_from_object_.resize(size(), to_float(Affine()));
  file_from_object_.back() = to_float(file_from_object);
}

void InstanceTable::add_moving(const InstanceTarget& target, std::span<const Affine> world_from_object,
                               const Bounds& box, std::int32_t object, std::int32_t material) {
  moving_.push_back(static_cast<std::uint32_t>(targets_.size()));
  add(target, world_from_object.front(), box, object, material);
  first_moments_.back() = static_cast<std::int32_t>(moments_.size());
  for (const Affine& map : world_from_object) {
    moments_.push_back(map);
    // Between two moments all points move straight, and so stay in the box that moves as these do.
    moving_bounds_.push_back(transformed_bounds(map, box));
    bounds_.back() = join(bounds_.back(), moving_bounds_.back());
  }
}

InstanceTable::Maps InstanceTable::maps(std::size_t i, float time) const {
  if (!moves(i)) return {world_from_object_[i], object_from_world_[i]};
  // NaN is the first moment.
  const double place = time > 0 ? std::min(double{time}, 1.0) * (shutter_moments - 1) : 0;
  const int before = std::min(static_cast<int>(place), shutter_moments - 2);
  const double part = place - before;
  const Affine* const moment = &moments_[static_cast<std::size_t>(first_moments_[i] + before)];
  const auto between = [&](Vec3d Affine::* column) {
    return moment[0].*column * (1 - part) + moment[1].*column * part;
  };
  const Affine map{between(&Affine::x), between(&Affine::y), between(&Affine::z), between(&Affine::origin)};
  return {to_float(map), to_float(map.inverse())};
}

std::span<const Affine> InstanceTable::moments(std::size_t i) const {
  return std::span(moments_).subspan(static_cast<std::size_t>(first_moments_[i]), std::size_t{shutter_moments});
}

InstanceTable::LaneMaps InstanceTable::moving_maps(const UintN& number, const FloatN& time) const {
  std::array<AffineRecord<float>, packet_lanes> world_from_object, object_from_world;
  const IntN indices = index(number);
  for (std::size_t lane = 0; lane < packet_lanes; ++lane) {
    const Maps of_lane = maps(static_cast<std::size_t>(indices.get(lane)), time.get(lane));
    world_from_object[lane] = of_lane.world_from_object;
    object_from_world[lane] = of_lane.object_from_world;
  }
  const LaneIndices lanes(lane_numbers<IntN>());
  return {gather_records<AffineRecord, FloatN>(world_from_object.data(), lanes),
          gather_records<AffineRecord, FloatN>(object_from_world.data(), lanes)};
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
