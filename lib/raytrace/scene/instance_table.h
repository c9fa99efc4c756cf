// The instances of a scene: groups of objects, or single shapes, under transforms that only a ray can follow.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raytrace/math/affine.h"
#include "raytrace/math/bounds.h"
#include "raytrace/math/gather.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"

namespace raytrace {

/// An affine map of lanes, or of one instance: the columns as Affine has them, in float.
template <class T>
struct AffineRecord {
  Vec3<T> x, y, z, origin;
};

inline AffineRecord<float> to_float(const Affine& a) { return {Vec3f(a.x), Vec3f(a.y), Vec3f(a.z), Vec3f(a.origin)}; }

/// Every coordinate by the same three fused operations, for packets and single rays, so that both find the same.
template <class F, class T>
RAYTRACE_INLINE Vec3<F> apply_vector(const AffineRecord<T>& affine, const Vec3<F>& v) {
  const auto row = [&](const T& x, const T& y, const T& z)
                       RAYTRACE_INLINE_LAMBDA { return multiply_add(F(x), v.x, multiply_add(F(y), v.y, F(z) * v.z)); };
  return {row(affine.x.x, affine.y.x, affine.z.x), row(affine.x.y, affine.y.y, affine.z.y),
          row(affine.x.z, affine.y.z, affine.z.z)};
}
template <class F, class T>
RAYTRACE_INLINE Vec3<F> apply_point(const AffineRecord<T>& affine, const Vec3<F>& p) {
  const auto row = [&](const T& x, const T& y, const T& z, const T& origin) RAYTRACE_INLINE_LAMBDA {
    return multiply_add(F(x), p.x, multiply_add(F(y), p.y, multiply_add(F(z), p.z, F(origin))));
  };
  return {row(affine.x.x, affine.y.x, affine.z.x, affine.origin.x),
          row(affine.x.y, affine.y.y, affine.z.y, affine.origin.y),
          row(affine.x.z, affine.y.z, affine.z.z, affine.origin.z)};
}

/// What is instanced.
struct InstanceTarget {
  static constexpr std::int32_t no_group = -1;

  std::int32_t group = no_group;  ///< whose table it is in; none: the world's
  bool is_shape = false;          ///< a single shape, as its table has it; else all that the group has beside such
  std::uint32_t shape_type = 0, primitive = 0;  ///< of the single shape
};

/// Instances are numbered from 1: 0 stands for hits outside of them. Single shapes of the world have shape_of_world in
/// theirs.
class InstanceTable {
 public:
  /// At equal distances, the first by number counts, then by geometry and primitive; but single shapes of the
  /// world count as its other objects do: as if their number were 0.
  static constexpr std::uint32_t shape_of_world = 0x80000000;

  /// material: in place of the objects' own; -1: none. box: around what is instanced, before the map.
  void add(const InstanceTarget& target, const Affine& world_from_object, const Bounds& box, std::int32_t object,
           std::int32_t material);
  /// One that moves: its maps at each moment while the shutter is open (description/motion.h).
  void add_moving(const InstanceTarget& target, std::span<const Affine> world_from_object, const Bounds& box,
                  std::int32_t object, std::int32_t material);

  /// Of the last one: that its objects are a copy of a mesh, and to where in its file's space it is. Only where
  /// textures ask for that space.
  void set_place_in_file(const Affine& file_from_object);

  bool empty() const { return targets_.empty(); }
  std::size_t size() const { return targets_.size(); }

  // Of instance i, whose number is:
  std::uint32_t number(std::size_t i) const {
    return static_cast<std::uint32_t>(i + 1) | (targets_[i].group == InstanceTarget::no_group ? shape_of_world : 0);
  }
  static std::size_t index_of(std::uint32_t number) { return (number & ~shape_of_world) - 1; }
  const InstanceTarget& target(std::size_t i) const { return targets_[i]; }
  const Bounds& bounds(std::size_t i) const { return bounds_[i]; }  ///< in the world, all the time
  const AffineRecord<float>& object_from_world(std::size_t i) const { return object_from_world_[i]; }
  const AffineRecord<float>& world_from_object(std::size_t i) const { return world_from_object_[i]; }
  bool moves(std::size_t i) const { return first_moments_[i] >= 0; }
  /// Those that move, in their order.
  const std::vector<std::uint32_t>& moving() const { return moving_; }
  /// In the world, at a moment.
  const Bounds& bounds_at(std::size_t i, std::size_t moment) const {
    return moving_bounds_[static_cast<std::size_t>(first_moments_[i]) + moment];
  }
  struct Maps {
    AffineRecord<float> world_from_object, object_from_world;
  };
  /// Of instance i, at a time from 0, when the shutter opens, to 1, when it closes.
  Maps maps(std::size_t i, float time) const;
  /// Of one that moves: world_from_object at each moment.
  std::span<const Affine> moments(std::size_t i) const;
  /// By how much it scales all lengths; 0: not all by the same.
  float scale(std::size_t i) const { return scales_[i]; }
  const std::vector<std::int32_t>& materials() const { return materials_; }

  // Of lanes: number is 0 where they hit none. Those get what the first instance has. time: as of maps().

  IntN group(const UintN& number) const { return gather(groups_.data(), index(number)); }
  IntN object(const UintN& number) const { return gather(objects_.data(), index(number)); }
  IntN material(const UintN& number) const { return gather(materials_.data(), index(number)); }
  AffineRecord<FloatN> object_from_world(const UintN& number, const FloatN& time) const {
    if (!moving_.empty()) [[unlikely]]
      return moving_maps(number, time).object_from_world;
    return gather_records<AffineRecord, FloatN>(object_from_world_.data(), LaneIndices(index(number)));
  }
  /// Whether any has a place in a file, and where that is; of the others, that map leaves all as it is.
  bool has_places_in_files() const { return !file_from_object_.empty(); }
  AffineRecord<FloatN> file_from_object(const UintN& number) const {
    return gather_records<AffineRecord, FloatN>(file_from_object_.data(), LaneIndices(index(number)));
  }
  AffineRecord<FloatN> world_from_object(const UintN& number, const FloatN& time) const {
    if (!moving_.empty()) [[unlikely]]
      return moving_maps(number, time).world_from_object;
    return gather_records<AffineRecord, FloatN>(world_from_object_.data(), LaneIndices(index(number)));
  }
  /// Both, where some move.
  struct LaneMaps {
    AffineRecord<FloatN> world_from_object, object_from_world;
  };
  LaneMaps moving_maps(const UintN& number, const FloatN& time) const;

 private:
  static IntN index(const UintN& number) {
    return same_bits<IntN>(number & UintN(~shape_of_world)) -
           select_lanes(float_mask<FloatN>(number == UintN(0u)), IntN(0), IntN(1));
  }

  std::vector<InstanceTarget> targets_;
  std::vector<AffineRecord<float>> object_from_world_, world_from_object_;
  std::vector<AffineRecord<float>> file_from_object_;  ///< empty: none has a place in a file
  std::vector<Bounds> bounds_;
  std::vector<float> scales_;
  std::vector<std::int32_t> groups_, objects_, materials_;
  // Of those that move, all moments of one after the other.
  std::vector<std::int32_t> first_moments_;  ///< of each instance, among them; -1: it stands still
  std::vector<std::uint32_t> moving_;
  std::vector<Affine> moments_;
  std::vector<Bounds> moving_bounds_;
};

/// Around a box under a map.
Bounds transformed_bounds(const Affine& affine, const Bounds& box);

}  // namespace raytrace
