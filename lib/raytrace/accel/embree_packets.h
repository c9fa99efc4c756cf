// A packet of ours in as many of Embree's as it has registers: wider packets than those Embree takes apart.
#pragma once

#include <cstdint>

#include "raytrace/accel/embree.h"
#include "raytrace/math/lanes.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"

namespace raytrace::embree {

using RegisterPacket = Packet<register_lanes>;
inline constexpr int packets = packet_lanes / register_lanes;

// field(i): an array of Embree's packet number i, of as many numbers as it has lanes.

template <class Batch, class Field>
RAYTRACE_INLINE void store(const Batch& values, const Field& field) {
  values.lower().store_aligned(field(0));
  values.upper().store_aligned(field(1));
}

template <class Batch, class Field>
RAYTRACE_INLINE Batch load(const Field& field) {
  return {Batch::Part::load_aligned(field(0)), Batch::Part::load_aligned(field(1))};
}

/// What Embree wants to know of the lanes: -1 in those that are to be traced.
struct ValidLanes {
  alignas(64) int lanes[packets][register_lanes];

  explicit ValidLanes(const MaskN& active) {
    store(same_bits<IntN>(select(active, same_bits<FloatN>(IntN(-1)), FloatN(0))), [&](int i) { return lanes[i]; });
  }
};

/// ray(i): Embree's packet number i. A ray's id is its lane.
template <class EmbreeRay>
void store_rays(const Ray<FloatN>& rays, const FloatN& times, const EmbreeRay& ray) {
  store(rays.origin.x, [&](int i) { return ray(i).org_x; });
  store(rays.origin.y, [&](int i) { return ray(i).org_y; });
  store(rays.origin.z, [&](int i) { return ray(i).org_z; });
  store(rays.near, [&](int i) { return ray(i).tnear; });
  store(rays.direction.x, [&](int i) { return ray(i).dir_x; });
  store(rays.direction.y, [&](int i) { return ray(i).dir_y; });
  store(rays.direction.z, [&](int i) { return ray(i).dir_z; });
  store(times, [&](int i) { return ray(i).time; });
  store(rays.far, [&](int i) { return ray(i).tfar; });
  store(UintN(0xffffffffu), [&](int i) { return ray(i).mask; });
  store(lane_numbers<UintN>(), [&](int i) { return ray(i).id; });
  store(UintN(0), [&](int i) { return ray(i).flags; });
}

/// The way back.
template <class EmbreeRay>
Ray<FloatN> load_rays(const EmbreeRay& ray) {
  return {{load<FloatN>([&](int i) { return ray(i).org_x; }), load<FloatN>([&](int i) { return ray(i).org_y; }),
           load<FloatN>([&](int i) { return ray(i).org_z; })},
          {load<FloatN>([&](int i) { return ray(i).dir_x; }), load<FloatN>([&](int i) { return ray(i).dir_y; }),
           load<FloatN>([&](int i) { return ray(i).dir_z; })},
          load<FloatN>([&](int i) { return ray(i).tnear; }),
          load<FloatN>([&](int i) { return ray(i).tfar; })};
}

/// Calls f(packet, lane) for each of the packet's lanes that are set, Embree's packet and the lane in it.
template <class Function>
void for_each_lane(const MaskN& mask, const Function& f) {
  for (const std::size_t lane : SetLanes(mask))
    f(static_cast<int>(lane) / register_lanes, static_cast<int>(lane) % register_lanes);
}

/// Calls f(packet) for each of Embree's packets that has a lane in the mask.
template <class Function>
void for_each_packet(const MaskN& mask, const Function& f) {
  constexpr std::uint32_t all = (std::uint64_t{1} << register_lanes) - 1;
  const std::uint32_t lanes = bits_of<FloatN>(mask);
  for (int i = 0; i < packets; ++i)
    if ((lanes >> (i * register_lanes) & all) != 0) f(i);
}

}  // namespace raytrace::embree
