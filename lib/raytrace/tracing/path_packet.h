// A packet of paths from the camera, between two points.
#pragma once

#include <cstddef>
#include <cstdint>

#include "raytrace/math/color.h"
#include "raytrace/scene/medium_table.h"
#include "raytrace/tracing/path_chunk.h"

namespace raytrace {

/// What a path from the camera has met, as far as light paths are concerned (tracing/light_paths.h).
enum PathWay : std::int32_t {
  any_way,         ///< or nothing yet
  by_scattering,   ///< no surface yet, but what is in a medium
  by_reflection,   ///< last a point that light paths bring light to, or photons, which reflected it
  by_focus,        ///< that, and from there on one or more points of what does: light from here is a light path's
  by_gloss,        ///< last such a point, which reflected it nearly as a mirror does: light is its own
  by_gloss_focus,  ///< that, and then as by_focus: light of what a path can hit is its own
  from_below,      ///< anything, and it now comes out from below the surface that it has hit
};

/// What scattered a path the first time, for passes.
enum FirstScattering : std::int32_t {
  unscattered,
  reflected,
  transmitted,
  in_volume,
  below_surface,  ///< it went in at a surface, and came out
};

/// A path from the camera for each lane, whose last ray has hit something.
struct PathPacket : ArrivedRays {
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
  IntN first;                    ///< FirstScattering; where the film has passes
  Rgb<FloatN> gloss_share;       ///< of what was reflected first; likewise

  /// How many of the last members the paths of scenes with those media do without.
  static std::size_t unused(const MediumTable& media, bool has_passes) {
    if (has_passes) return 0;
    constexpr std::size_t of_passes = 4;
    if (media.disperses()) return of_passes;
    return of_passes + (media.has_fog() ? 1 : media.empty() ? 4 : 2);
  }
};

}  // namespace raytrace
