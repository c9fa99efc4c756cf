// Lane after lane of a packet, for what packets cannot do at once.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <iterator>

#include "raytrace/math/color.h"
#include "raytrace/math/simd.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

/// The numbers of the lanes that are set, in order: for (const std::size_t lane : SetLanes(mask)).
class SetLanes {
 public:
  explicit SetLanes(std::uint32_t bits) : bits_(bits) {}
  explicit SetLanes(const MaskN& mask) : bits_(bits_of<FloatN>(mask)) {}

  struct Iterator {
    std::uint32_t left;

    std::size_t operator*() const { return static_cast<std::size_t>(std::countr_zero(left)); }
    Iterator& operator++() {
      left &= left - 1;
      return *this;
    }
    bool operator==(std::default_sentinel_t) const { return left == 0; }
  };
  Iterator begin() const { return {bits_}; }
  std::default_sentinel_t end() const { return {}; }

 private:
  std::uint32_t bits_;
};

/// The first lane that is set in the mask, which has one.
inline std::size_t first_lane(const MaskN& mask) { return *SetLanes(mask).begin(); }

/// Of that lane.
inline Vec3f in_lane(const Vec3<FloatN>& v, std::size_t lane) { return {v.x.get(lane), v.y.get(lane), v.z.get(lane)}; }
inline Rgb<float> in_lane(const Rgb<FloatN>& color, std::size_t lane) {
  return {color.red.get(lane), color.green.get(lane), color.blue.get(lane)};
}

/// Calls f(value, here) for each of the values that lanes of the mask have, `here` the lanes that have it: mostly once.
template <class Values, class Function>
RAYTRACE_INLINE void for_each_value(const Values& values, const MaskN& lanes, const Function& f) {
  for (MaskN left = lanes; any(left);) {
    const auto value = values.get(first_lane(left));
    const MaskN here = left & float_mask<FloatN>(values == Values(value));
    f(value, here);
    left = left & !here;
  }
}

}  // namespace raytrace
