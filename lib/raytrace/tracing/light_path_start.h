// Where light paths start: a light, a place on it and a direction to what focuses light.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "raytrace/math/ray.h"
#include "raytrace/scene/scene_tables.h"

namespace raytrace {

/// Light paths, one a lane.
struct LightPathPacket {
  UintN pixel, sample;
  std::array<std::uint64_t, packet_lanes> picture_pixel;  ///< that each belongs to

  std::array<CausticTable::Target, packet_lanes> target;
  alignas(64) std::array<std::int32_t, packet_lanes> sources, targets;  ///< their numbers in the CausticTable
  alignas(64) std::array<std::int32_t, packet_lanes> groups;            ///< of the lights

  Ray<FloatN> rays;
  /// The light that the path carries: the flux along it over the density of all that was drawn for it, where `share`
  /// of what left the light is not lost yet.
  Rgb<FloatN> flux, share;
  MediumStack media;  ///< that the path is in
  FloatN deviation;   ///< of its wavelength; 0: it has none
  int depth = 0;      ///< points that it has come to
  MaskN from_point;   ///< whose light is known by the irradiance where the path comes to first

  Vec3<FloatN> center() const {
    return {of_targets([](const auto& t) { return t.center.x; }), of_targets([](const auto& t) { return t.center.y; }),
            of_targets([](const auto& t) { return t.center.z; })};
  }
  FloatN radius() const {
    return of_targets([](const auto& t) { return t.radius; });
  }

 private:
  template <class Number>
  FloatN of_targets(const Number& number) const {
    alignas(64) std::array<float, packet_lanes> numbers;
    for (std::size_t lane = 0; lane < packet_lanes; ++lane) numbers[lane] = number(target[lane]);
    return FloatN::load_aligned(numbers.data());
  }
};

/// Of a vector that may be 0.
inline Vec3<FloatN> unit_vector(const Vec3<FloatN>& v) { return v * (FloatN(1) / max(length(v), FloatN(1e-30F))); }

/// Draws a light, a target, a place on the light and a direction to the target, for the packet's pixels and samples.
/// The scene must have caustics. The result: the lanes that have light.
MaskN start_light_paths(const SceneTables& scene, LightPathPacket& path);

}  // namespace raytrace
