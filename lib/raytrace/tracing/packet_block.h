// Which samples of which pixels the rays of a packet are.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "raytrace/film/film.h"
#include "raytrace/math/simd.h"

namespace raytrace {

/// A block of width x height pixels, with so many samples of each: a lane each, packet_lanes in all.
struct PacketShape {
  int width, height, samples;
};

/// With `samples` of each pixel (a power of two, at most packet_lanes), as square as can be.
constexpr PacketShape shape_of_samples(int samples) {
  const int pixels = packet_lanes / samples, width = pixels >= 32 ? 8 : pixels >= 8 ? 4 : pixels >= 2 ? 2 : 1;
  return {width, pixels / width, samples};
}

/// The block whose left upper pixel is (left, top).
template <PacketShape shape>
struct PacketBlock {
  static constexpr int pixels = shape.width * shape.height;

  int left = 0, top = 0;

  /// Of each lane's pixel, as UintN: or, where there is but one, std::uint32_t.
  auto columns() const {
    if constexpr (pixels == 1)
      return static_cast<std::uint32_t>(left);
    else
      return UintN(static_cast<std::uint32_t>(left)) + UintN::load_aligned(numbers.column.data());
  }
  auto rows() const {
    if constexpr (pixels == 1)
      return static_cast<std::uint32_t>(top);
    else
      return UintN(static_cast<std::uint32_t>(top)) + UintN::load_aligned(numbers.row.data());
  }

  /// Of a lane's pixel, in the picture; and the lane's sample in its group.
  int column(int lane) const { return left + lane % shape.width; }
  int row(int lane) const { return top + lane / shape.width % shape.height; }
  static constexpr int slot(int lane) { return lane / pixels; }

  static UintN slots() { return UintN::load_aligned(numbers.slot.data()); }

  /// Calls f(x, y, pixel), a pixel being that of lanes pixel, pixel + pixels and so on, for the pixels that lie in the
  /// region.
  template <class Function>
  void for_each_pixel(const Region& region, const Function& f) const {
    const bool all =
        region.x0 <= left && left + shape.width <= region.x1 && region.y0 <= top && top + shape.height <= region.y1;
    for (int pixel = 0; pixel < pixels; ++pixel) {
      const int x = column(pixel), y = row(pixel);
      if (all || (region.x0 <= x && x < region.x1 && region.y0 <= y && y < region.y1))
        f(x, y, static_cast<std::size_t>(pixel));
    }
  }

  /// Calls f(x, y, pixel, count) for each row of those pixels: `count` beside each other, from (x, y) on.
  template <class Function>
  void for_each_row(const Region& region, const Function& f) const {
    if constexpr (pixels == 1) return f(left, top, 0, 1);  // every such block lies in its region
    const int first = std::max(left, region.x0), count = std::min(left + shape.width, region.x1) - first;
    if (count <= 0) return;
    for (int y = std::max(top, region.y0); y < std::min(top + shape.height, region.y1); ++y)
      f(first, y, (y - top) * shape.width + first - left, count);
  }

  /// Calls f(x, y, lane) for the lanes whose pixels lie in the region.
  template <class Function>
  void for_each_lane(const Region& region, const Function& f) const {
    for (int lane = 0; lane < packet_lanes; ++lane) {
      const int x = column(lane), y = row(lane);
      if (x >= region.x0 && x < region.x1 && y >= region.y0 && y < region.y1) f(x, y, static_cast<std::size_t>(lane));
    }
  }

 private:
  struct LaneNumbers {
    alignas(64) std::array<std::uint32_t, packet_lanes> column{}, row{}, slot{};
  };
  static constexpr LaneNumbers numbers = [] {
    LaneNumbers lanes;
    for (int lane = 0; lane < packet_lanes; ++lane) {
      const auto i = static_cast<std::size_t>(lane);
      lanes.column[i] = static_cast<std::uint32_t>(lane % shape.width);
      lanes.row[i] = static_cast<std::uint32_t>(lane / shape.width % shape.height);
      lanes.slot[i] = static_cast<std::uint32_t>(slot(lane));
    }
    return lanes;
  }();
};

}  // namespace raytrace
