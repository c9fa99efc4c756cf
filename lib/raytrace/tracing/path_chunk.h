// Paths on their way: taken out in any order, and put back, a packet at a time.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "raytrace/math/color.h"
#include "raytrace/math/gather.h"
#include "raytrace/math/ray.h"
#include "raytrace/scene/hits.h"
#include "raytrace/scene/medium_table.h"

namespace raytrace {

/// What a path from the camera has met, as far as light paths are concerned (tracing/light_paths.h).
enum PathWay : std::int32_t {
  any_way,        ///< or nothing yet
  by_scattering,  ///< no surface yet, but what is in a medium
  by_reflection,  ///< last a point that light paths bring light to, or photons, which reflected it
  by_focus,       ///< that, and from there on one or more points of what does: light from here is a light path's
  from_below,     ///< anything, and it now comes out from below the surface that it has hit
};

/// A path for each lane, whose last ray has hit something.
struct PathPacket {
  Ray<FloatN> rays;  ///< the last ones, which end where they hit
  UintN instance, geometry;
  IntN primitive;
  FloatN u, v;

  Rgb<FloatN> throughput;
  FloatN eta2;      ///< of the media that the path is in and was in at its start, squared
  FloatN distance;  ///< of all rays before the last one together
  // Of the last direction: its density, infinite where light cannot be drawn for it, and where it starts.
  FloatN pdf;
  Vec3<FloatN> from, from_normal;
  UintN pixel, sample;           ///< as CameraRays have them
  IntN slot;                     ///< where the path's radiance goes
  IntN way;                      ///< PathWay
  IntN first_media, last_media;  ///< MediumStack::Packed, in scenes with media
  IntN fog_scatterings;          ///< how often fog has scattered it; in scenes with fog
  FloatN deviation;              ///< of the path's wavelength, or 0 if it has none; where media disperse light

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

class PathChunk {
 public:
  /// Takes so many paths. Throws std::bad_alloc.
  PathChunk(std::size_t capacity, const MediumTable& media)
      : fields_(media.disperses() ? fields
                : media.has_fog() ? fields - 1
                : media.empty()   ? fields - 4
                                  : fields - 2),
        stride_((fields_ + 3) / 4 * 4),
        numbers_(stride_ * (capacity + 1)),
        unused_(static_cast<std::int32_t>(stride_ * capacity)) {
    buckets_.reserve(capacity);
  }

  std::size_t size() const { return buckets_.size(); }
  void clear() {
    buckets_.clear();
    ends_ = {};
  }

  /// Adds those lanes. bucket: from 0 to 255 each; paths of one are worth being together.
  void append(const PathPacket& packet, std::uint32_t lanes, const IntN& bucket) {
    alignas(64) std::array<std::int32_t, packet_lanes> buckets, offsets;
    bucket.store_aligned(buckets.data());
    offsets.fill(unused_);
    for (; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
      offsets[lane] = static_cast<std::int32_t>(stride_ * size());
      buckets_.push_back(static_cast<std::uint8_t>(buckets[lane]));
      ++ends_[static_cast<std::size_t>(buckets[lane])];
    }
    scatter_fields(reinterpret_cast<const FloatN*>(&packet), fields_, numbers_.data(), offsets.data());
  }

  /// Those of the given numbers.
  PathPacket load(const IntN& index) const {
    alignas(64) std::array<std::int32_t, packet_lanes> offsets;
    (index * IntN(static_cast<std::int32_t>(stride_))).store_aligned(offsets.data());
    PathPacket packet;
    gather_fields(numbers_.data(), offsets.data(), fields_, reinterpret_cast<FloatN*>(&packet));
    return packet;
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
  static constexpr std::size_t fields = sizeof(PathPacket) / sizeof(FloatN);
  static_assert(sizeof(PathPacket) == fields * packet_lanes * sizeof(float));

  std::size_t fields_, stride_;
  std::vector<float> numbers_;            ///< path by path
  std::int32_t unused_;                   ///< where numbers of lanes go that are not added
  std::vector<std::uint8_t> buckets_;     ///< of each path
  std::array<std::int32_t, 256> ends_{};  ///< of each bucket: how many are in it; while they are sorted, where it ends
};

}  // namespace raytrace
