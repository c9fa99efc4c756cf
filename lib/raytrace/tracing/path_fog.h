// What the ways of paths through fogs share: parts of them, and what is drawn there.
#pragma once

#include <cstddef>
#include <cstdint>

#include "raytrace/bsdfs/henyey_greenstein.h"
#include "raytrace/sampling/hash.h"
#include "raytrace/sampling/ray_ids.h"
#include "raytrace/sampling/sampler.h"
#include "raytrace/tracing/fog.h"
#include "raytrace/tracing/fog_distances.h"
#include "raytrace/tracing/path_batch.h"

namespace raytrace {

/// Up to so many lights of a group are asked each for what they bring to a part, or a point, of a way in fog.
inline constexpr std::size_t most_asked_in_fog = 24;

inline FloatN brightness(const Rgb<FloatN>& color) { return abs(color.red) + abs(color.green) + abs(color.blue); }

/// A part of paths' ways in a fog.
struct PathBatch::FogPart {
  MaskN lanes;
  const Ray<FloatN>& rays;  ///< of unit length
  FloatN begin, end;
  const IntN& fog;
  const MediumStack& media;
  FloatN extinction, anisotropy;
  Rgb<FloatN> scattering;
  FlightDistances flights;
  int rounds = 1;  ///< how often light is looked for

  FogPart(const MediumTable& table, const MaskN& those, const Ray<FloatN>& their_rays, const FloatN& from,
          const FloatN& to, const IntN& its_fog, const MediumStack& its_media)
      : lanes(those),
        rays(their_rays),
        begin(from),
        end(min(to, FloatN(1e17F))),
        fog(its_fog),
        media(its_media),
        extinction(max(table.extinction(fog).green, FloatN(1e-30F))),  // the same of all colours
        anisotropy(table.anisotropy(fog)),
        scattering(table.scattering(fog)),
        flights(extinction, begin, end) {}

  /// What is left of light that went from there to where the part begins.
  FloatN left(const FloatN& distance) const { return exp(-extinction * (distance - begin)); }
  FloatN phase(const Vec3<FloatN>& wi) const { return henyey_greenstein(dot(rays.direction, wi), anisotropy); }
};

/// What comes to it from one light, before what is in between.
struct PathBatch::FogLight {
  MaskN lit{false}, has_shadow{false};
  Ray<FloatN> ray;
  FloatN distance{0};                         ///< of its origin, along the part's rays
  std::uint32_t ray_number = 0;               ///< among the part's
  Rgb<FloatN> radiance{Rgb<float>(0, 0, 0)};  ///< over the density of the draw, times the phase function's value
  IntN group{0};
};

/// Random numbers of a part, and which its rays are: where paths go on a straight way, which begins with `step`
/// scatterings. Up to the first of them, those of the first parts are well spread.
struct PathBatch::FogNumbers {
  const UintN& pixel;
  const UintN& sample;
  std::uint32_t walk, step, part = 0;
  std::uint32_t round = 0;  ///< how often light has been looked for

  Sample2D operator()(FogDraw what) const {
    constexpr std::uint32_t spread_parts = 32;  // that have dimensions of their own
    const std::uint32_t round_of_part = round << 5U | part % spread_parts, repeat = part / spread_parts;
    if (step == 0 && repeat == 0) return get_2d(pixel, sample, fog_dimension(walk, round_of_part, what));
    const UintN key = mix_bits(RayIds{pixel, sample, 0x70000000U | walk}.keys() + UintN(repeat * 0x85ebca6bU));
    const std::uint32_t number = ((step << 8U | round_of_part) * 8 + static_cast<std::uint32_t>(what)) * 2;
    return {to_unit(mix_bits(key + UintN(number * 0x9e3779b9U))),
            to_unit(mix_bits(key + UintN((number + 1) * 0x9e3779b9U)))};
  }
  RayIds ids(std::uint32_t ray) const {
    return {pixel, sample, 0x60000000U | walk << 10U | (step & 0xFFU) << 2U | ray};
  }
  /// Of what is different in each round of each part.
  RayIds ids_of_round(std::uint32_t ray) const {
    return {pixel, sample, hash<std::uint32_t>(walk, step, part << 3U | round, 0x64656e73U + ray)};
  }
};

}  // namespace raytrace
