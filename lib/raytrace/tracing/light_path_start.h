// Where light paths start: a light, a place on it and a direction to what focuses light.
#pragma once

#include <cstddef>
#include <cstdint>

#include "raytrace/math/color.h"
#include "raytrace/scene/medium_table.h"
#include "raytrace/scene/scene_tables.h"
#include "raytrace/tracing/path_chunk.h"

namespace raytrace {

enum class LightPathStart : std::int32_t {
  on_surface,
  at_point,  ///< its light is known by the irradiance where the path comes to first
  far_away,  ///< outside of all objects but planes
};

/// A light path for each lane, at its start or where its last ray has hit something.
struct LightPathPacket : ArrivedRays {
  /// The light that the path carries: the flux along it over the density of all that was drawn for it, where `share`
  /// of what left the light is not lost yet.
  Rgb<FloatN> flux, share;
  UintN pixel, sample;           ///< whose numbers it draws
  IntN column, row;              ///< of the pixel that it belongs to
  IntN start;                    ///< LightPathStart
  IntN source, target;           ///< their numbers in the CausticTable
  IntN group;                    ///< of the light
  IntN first_media, last_media;  ///< MediumStack::Packed, in scenes with media
  FloatN deviation;              ///< of the path's wavelength, or 0 if it has none; where media disperse light

  MediumStack media() const { return MediumStack({first_media, last_media}); }
  void set_media(const MediumStack& media) {
    const MediumStack::Packed packed = media.packed();
    first_media = packed.first;
    last_media = packed.last;
  }

  /// How many of the last members the paths of scenes with those media do without.
  static std::size_t unused(const MediumTable& media) { return media.disperses() ? 0 : media.empty() ? 3 : 1; }
};

/// Of a vector that may be 0.
inline Vec3<FloatN> unit_vector(const Vec3<FloatN>& v) { return v * (FloatN(1) / max(length(v), FloatN(1e-30F))); }

/// Draws a light, a target, a place on the light and a direction to the target, for the packet's pixels and samples.
/// The scene must have caustics. The result: the lanes that have light. Rays have hit nothing yet, and are in no media.
MaskN start_light_paths(const SceneTables& scene, LightPathPacket& path);

}  // namespace raytrace
