// Paths on their way: taken out in any order, and put back, a packet at a time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "raytrace/math/gather.h"
#include "raytrace/math/lanes.h"
#include "raytrace/math/ray.h"
#include "raytrace/scene/hits.h"

namespace raytrace {

/// Rays for each lane that have hit something, and what: as paths keep them between two points.
struct ArrivedRays {
  Ray<FloatN> rays;  ///< which end where they hit
  UintN instance, geometry;
  IntN primitive;
  FloatN u, v;

  void set_hits(const Hits& hits) {
    instance = hits.instance;
    geometry = hits.geometry;
    primitive = hits.primitive;
    u = hits.u;
    v = hits.v;
  }
  Hits hits(const MaskN& lanes) const {
    Hits hits;
    hits.hit = lanes;
    hits.instance = instance;
    hits.geometry = geometry;
    hits.primitive = primitive;
    hits.u = u;
    hits.v = v;
    hits.find_first();
    return hits;
  }
};

/// In which paths of one material on one geometry, which says the shape, are together.
inline IntN bucket_of(const Hits& hits, const IntN& material) {
  return ((same_bits<IntN>(hits.geometry) & IntN(15)) << 4) | (material & IntN(15));
}

/// Packet: a path for each lane; of members of a lane's width only, the last of which may be unused.
template <class Packet>
class PathChunk {
 public:
  /// Takes so many paths, of whose packets the last `unused` members are not kept. Throws std::bad_alloc.
  PathChunk(std::size_t capacity, std::size_t unused)
      : capacity_(capacity),
        fields_(fields - unused),
        stride_((fields_ + 3) / 4 * 4),
        numbers_(stride_ * (capacity + 1)),
        unused_(static_cast<std::int32_t>(stride_ * capacity)) {
    buckets_.reserve(capacity);
  }

  std::size_t size() const { return buckets_.size(); }
  /// Whether it may not take a packet more.
  bool is_full() const { return size() + packet_lanes > capacity_; }
  void clear() {
    buckets_.clear();
    ends_ = {};
  }

  /// Adds those lanes. bucket: from 0 to 255 each; paths of one are worth being together.
  void append(const Packet& packet, const MaskN& mask, const IntN& bucket) {
    if (none(mask)) return;
    alignas(64) std::array<std::int32_t, packet_lanes> buckets, offsets;
    bucket.store_aligned(buckets.data());
    offsets.fill(unused_);
    for (const std::size_t lane : SetLanes(mask)) {
      offsets[lane] = static_cast<std::int32_t>(stride_ * size());
      buckets_.push_back(static_cast<std::uint8_t>(buckets[lane]));
      ++ends_[static_cast<std::size_t>(buckets[lane])];
    }
    scatter_fields(reinterpret_cast<const FloatN*>(&packet), fields_, numbers_.data(), offsets.data());
  }

  struct Loaded {
    Packet path;
    MaskN lanes;
  };
  /// The paths order[first], order[first + 1]... that there are, at most a packet of them; and how many. Lanes beyond
  /// the last one follow the first.
  Loaded load(const std::vector<std::int32_t>& order, std::size_t first) const {
    const std::size_t lanes = std::min<std::size_t>(order.size() - first, packet_lanes);
    alignas(64) std::array<std::int32_t, packet_lanes> offsets;
    for (std::size_t lane = 0; lane < packet_lanes; ++lane)
      offsets[lane] = order[first + (lane < lanes ? lane : 0)] * static_cast<std::int32_t>(stride_);
    Loaded result;  // neither copied nor set to 0: it is large
    gather_fields(numbers_.data(), offsets.data(), fields_, reinterpret_cast<FloatN*>(&result.path));
    result.lanes = first_lanes<FloatN>(static_cast<int>(lanes));
    return result;
  }

  /// Sets the order in which paths are by bucket, each bucket's as they came. clear() ends it.
  void sort(std::vector<std::int32_t>& order) {
    std::int32_t end = 0;
    for (std::int32_t& bucket : ends_) end = std::exchange(bucket, end) + end;
    order.resize(size());
    for (std::size_t i = 0; i < size(); ++i)
      order[static_cast<std::size_t>(ends_[buckets_[i]]++)] = static_cast<std::int32_t>(i);
  }

 private:
  static constexpr std::size_t fields = sizeof(Packet) / sizeof(FloatN);
  static_assert(sizeof(Packet) == fields * packet_lanes * sizeof(float));

  std::size_t capacity_, fields_, stride_;
  std::vector<float> numbers_;            ///< path by path
  std::int32_t unused_;                   ///< where numbers of lanes go that are not added
  std::vector<std::uint8_t> buckets_;     ///< of each path
  std::array<std::int32_t, 256> ends_{};  ///< of each bucket: how many are in it; while they are sorted, where it ends
};

}  // namespace raytrace
