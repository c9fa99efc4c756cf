// Which objects are to be met in which directions from a point: for camera rays, which all start at one, and shadow
// rays, which end at one or, with light from infinitely far, are parallel. Where few objects are, testing them all is
// faster than a tree.
//
// Haines and Greenberg, "The Light Buffer: A Shadow-Testing Accelerator", IEEE Computer Graphics and Applications
// 6(9), 1986. For the eye, POV-Ray's vista buffer is the same idea.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "raytrace/accel/cube_projection.h"
#include "raytrace/math/bounds.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/vec3.h"
#include "raytrace/memory/large_array.h"

namespace raytrace {

/// The directions from a point are those through the six faces of a cube around it. On each face, a grid covers what
/// the objects cover, and each of its cells lists all objects that directions through it may meet.
/// From infinitely far, one grid lies across all rays, on a face of the cube (cube_projection.h).
class DirectionBuffer {
 public:
  struct Object {
    static constexpr int primitive_bits = 24;
    static constexpr std::uint32_t last_primitive = (1U << primitive_bits) - 1;

    std::uint32_t shape_type : 32 - primitive_bits;
    std::uint32_t primitive : primitive_bits;
    float nearest;  ///< no part of it has a smaller depth()

    bool is(const Object& other) const { return shape_type == other.shape_type && primitive == other.primitive; }
  };

  /// The grid on a face, in the directions of FaceRectangle.
  struct Grid {
    int columns = 0, rows = 0;  ///< 0: nothing is to be met through this face
    float left = 0, bottom = 0;
    float columns_per_unit = 0, rows_per_unit = 0;
    std::uint32_t first_cell = 0;
  };

  /// Which objects are to be met through which cells.
  struct Lists {
    Grid grids[6];  ///< face by face: twice the axis of its normal, and one more on the negative side
    /// Where each cell's candidates begin, grid by grid, row by row; behind the last cell, where they end. With the
    /// bit `crowded` where a tree is faster: that cell has none.
    LargeArray<std::uint32_t> cells;
    /// Cell by cell, the nearest first. Each is a copy: a number would lead to one more place in memory, which takes
    /// longer than the test of an object.
    LargeArray<Object> candidates;
  };
  static constexpr std::uint32_t crowded = std::uint32_t{1} << 31U;

  /// None where it would not pay: an object is around the point or next to it, or objects are so close together that
  /// cells list too many, or they are too many for Object.
  static std::optional<DirectionBuffer> make(const BufferOrigin& origin, std::span<const BoundedObject> objects,
                                             int threads);

  bool infinitely_far() const { return infinitely_far_; }
  /// Where all is seen from, if that is not so.
  const Vec3f& point() const { return point_; }

  /// Of the origins of rays that go to the origin, to_origin being their directions, which lead right to the point if
  /// there is one: larger for what is behind it, the squared distance from the point, or the distance from a plane.
  template <class F>
  RAYTRACE_INLINE F depth(const Vec3<F>& origin, const Vec3<F>& to_origin) const {
    return infinitely_far_ ? F(start_.z) - dot(to_origin, origin) : dot(to_origin, to_origin);
  }

  /// From infinitely far, a ray is seen as a point of the picture across all rays, up to rounding: the direction from
  /// there to the point from which that picture is seen (cube_projection.h).
  template <class F>
  RAYTRACE_INLINE Vec3<F> direction_to_picture(const Vec3<F>& origin) const {
    return {F(start_.x) - dot(Vec3<F>(across_), origin), F(start_.y) - dot(Vec3<F>(up_), origin), F(-1)};
  }

  /// Whether its rounding is small enough that cells list all that such a ray may meet. Not if it starts at the
  /// origin, nor if a component is not finite.
  template <class F>
  RAYTRACE_INLINE auto in_reach(const Vec3<F>& origin, const Vec3<F>& to_origin) const {
    if (infinitely_far_) return dot(origin, origin) <= F(reach_ * reach_);
    const F squared_length = dot(to_origin, to_origin);
    return (squared_length <= F(reach_ * reach_)) & (squared_length > F(0));
  }

  /// Whether there is no object on the ray's way from near to far, as it is mostly where a floor goes on out of reach.
  template <class F>
  RAYTRACE_INLINE auto leads_past(const Ray<F>& ray) const {
    return !may_cross(surroundings_, ray);
  }

  /// face: twice the axis of its normal, and one more on the negative side.
  const Grid& grid(int face) const { return lists_.grids[face]; }

  /// Asks for the memory that is_crowded(cell), and then candidates(cell), will read, without waiting for it.
  void fetch_cell(std::size_t cell) const { __builtin_prefetch(lists_.cells.data() + cell); }
  void fetch_candidates(std::size_t cell) const {
    __builtin_prefetch(lists_.candidates.data() + (lists_.cells[cell] & ~crowded));
  }

  /// Whether so much is to be met through the cell that a tree is faster.
  bool is_crowded(std::size_t cell) const { return (lists_.cells[cell] & crowded) != 0; }

  /// All that is to be met through a cell that is not crowded, the nearest first.
  std::span<const Object> candidates(std::size_t cell) const {
    const Object* const candidates = lists_.candidates.data();
    return {candidates + (lists_.cells[cell] & ~crowded), candidates + (lists_.cells[cell + 1] & ~crowded)};
  }

 private:
  Lists lists_;
  Vec3f point_{};
  Bounds surroundings_{};  ///< of all objects, and more than rounding could miss
  float reach_ = 0;  ///< of the rays to a point, their length; of parallel ones, how far from (0, 0, 0) they start
  bool infinitely_far_ = false;
  Vec3f across_{}, up_{}, start_{};  ///< of the grid that lies across; start_.z: where depths begin
};

}  // namespace raytrace
