// Sums of directions at the vertices of a mesh, added to by several threads.
#pragma once

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "raytrace/math/vec3.h"
#include "raytrace/memory/large_array.h"

namespace raytrace {

/// Sums of unit vectors times angles, as integers: in whatever order threads add to them, they are the same.
class DirectionSums {
 public:
  explicit DirectionSums(std::size_t count) : sums_(LargeArray<std::int64_t>::zeros(3 * count)) {}

  void add(std::size_t i, const Vec3d& direction) {
    for (int axis = 0; axis < 3; ++axis) {
      const auto term = static_cast<std::int64_t>(std::llrint(component(direction, axis) * unit));
      std::atomic_ref(sums_[3 * i + static_cast<std::size_t>(axis)]).fetch_add(term, std::memory_order_relaxed);
    }
  }

  /// Writes its direction, of unit length; 0 0 0 where the sum is none.
  void write(std::size_t i, float* out) const {
    const Vec3d sum{static_cast<double>(sums_[3 * i]), static_cast<double>(sums_[3 * i + 1]),
                    static_cast<double>(sums_[3 * i + 2])};
    const double size = length(sum);
    for (int axis = 0; axis < 3; ++axis) out[axis] = size > 0 ? static_cast<float>(component(sum, axis) / size) : 0.0F;
  }

 private:
  static constexpr double unit = 0x1p28;  // a vertex may have 2^33 faces

  LargeArray<std::int64_t> sums_;
};

/// Between two vectors.
inline double angle_between(const Vec3d& a, const Vec3d& b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

}  // namespace raytrace
