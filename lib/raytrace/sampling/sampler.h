// Random numbers of a sample for what comes after its place in the pixel: two at a time, stratified over the samples of
// a pixel, and without a state.
//
// For each dimension that a pixel's samples have numbers for, a Sobol sequence of its own: scrambled as Owen does it,
// by a hash, its order shuffled likewise, so that dimensions have nothing to do with each other (Burley, "Practical
// Hash-based Owen Scrambling", JCGT 2020). Any 2^k consecutive samples from a multiple of 2^k on have one point in each
// of the 2^k boxes of any shape 2^a x 2^b, as in sobol_sequence.h.
#pragma once

#include <cstdint>

#include "raytrace/math/simd.h"
#include "raytrace/sampling/hash.h"

namespace raytrace {

/// What a sample's numbers are for. A new one comes last: the others' numbers stay what they are.
enum class Dimension : std::uint32_t { lens, first_of_path };

/// What a path draws on part number `part` of its way number `walk`, below 2^17, through fogs: none of those above.
enum class FogDraw : std::uint32_t { flights, direction, choices, light, light_place, emitter, emitter_point };
constexpr Dimension fog_dimension(std::uint32_t walk, std::uint32_t part, FogDraw draw) {
  return static_cast<Dimension>(((part & 0xFFU) << 20U | walk << 3U | static_cast<std::uint32_t>(draw)) | 0x50000000U);
}

/// When the rays of a sample are sent: none of those above.
inline constexpr Dimension time_dimension{0x20000000U};

/// The wavelength of a path from the camera, and of one from a light, where it comes to what disperses light.
inline constexpr Dimension wavelength_dimension{0x20000001U}, light_path_wavelength_dimension{0x20000002U};

/// What a path draws at each of its points.
enum class PathDraw : std::uint32_t { direction, lobe_and_roulette, light, light_point, count };

/// depth: of the point, counted from 0.
constexpr Dimension path_dimension(int depth, PathDraw draw) {
  return static_cast<Dimension>(static_cast<std::uint32_t>(Dimension::first_of_path) +
                                static_cast<std::uint32_t>(depth) * static_cast<std::uint32_t>(PathDraw::count) +
                                static_cast<std::uint32_t>(draw));
}

/// Of the n-th shadow ray of a sample, by its place on its light: none of those above.
constexpr Dimension shadow_dimension(std::uint32_t n) { return static_cast<Dimension>(n | 0x80000000U); }

/// What a light path draws: where it starts, and at each of its points.
enum class LightPathDraw : std::uint32_t { source, place, direction, lens, first_of_points };
enum class LightPathPointDraw : std::uint32_t { direction, lobe_and_roulette, count };

/// Which photon is looked up at a point of a path: none of those above.
constexpr Dimension photon_dimension(int depth) {
  return static_cast<Dimension>(static_cast<std::uint32_t>(depth) | 0x30000000U);
}

/// Whether a path leaves a point by gloss: none of those above.
constexpr Dimension gloss_dimension(int depth) {
  return static_cast<Dimension>(static_cast<std::uint32_t>(depth) | 0x38000000U);
}

/// None of those above.
constexpr Dimension light_path_dimension(LightPathDraw draw) {
  return static_cast<Dimension>(static_cast<std::uint32_t>(draw) | 0x40000000U);
}
constexpr Dimension light_path_dimension(int depth, LightPathPointDraw draw) {
  return static_cast<Dimension>(
      (static_cast<std::uint32_t>(LightPathDraw::first_of_points) +
       static_cast<std::uint32_t>(depth) * static_cast<std::uint32_t>(LightPathPointDraw::count) +
       static_cast<std::uint32_t>(draw)) |
      0x40000000U);
}

/// What is drawn where a shadow catcher is met (tracing/shadow_catcher.h): none of those above. One of those last for
/// each light.
enum class CatcherDraw : std::uint32_t { choice, emitter, emitter_point, environment, direction, first_light };
constexpr Dimension catcher_dimension(CatcherDraw draw, std::uint32_t light = 0) {
  return static_cast<Dimension>((static_cast<std::uint32_t>(draw) + light) | 0x60000000U);
}

/// A point of the unit square for each lane: from 0 up to 1.
struct Sample2D {
  FloatN x, y;
};

/// The 24 leading bits as a fraction: every float of the result is exact and below 1.
inline FloatN to_unit(const UintN& bits) { return to_float(same_bits<IntN>(bits >> 8)) * FloatN(0x1p-24f); }

/// U: std::uint32_t or a batch of them.
template <class U>
RAYTRACE_INLINE U reversed_bits(U v) {
  v = ((v >> 1) & U(0x55555555u)) | ((v & U(0x55555555u)) << 1);
  v = ((v >> 2) & U(0x33333333u)) | ((v & U(0x33333333u)) << 2);
  v = ((v >> 4) & U(0x0f0f0f0fu)) | ((v & U(0x0f0f0f0fu)) << 4);
  v = ((v >> 8) & U(0x00ff00ffu)) | ((v & U(0x00ff00ffu)) << 8);
  return (v >> 16) | (v << 16);
}

/// Owen's nested uniform scrambling of numbers whose bits stand in reverse: each is flipped by a hash of those below
/// it (the constants of N. Vegdahl, "Building a Better LK Hash", 2021).
template <class U>
RAYTRACE_INLINE U owen_scrambled(U v, const U& seed) {
  v = v ^ (v * U(0x3d20adeau));
  v = v + seed;
  v = v * ((seed >> 16) | U(1u));
  v = v ^ (v * U(0x05526c56u));
  return v ^ (v * U(0x53a22864u));
}

/// The two coordinates as binary fractions: x / 2^32, y / 2^32.
template <class U>
struct ScrambledPoint {
  U x, y;
};

/// Of sample `index` of the pixel of that hash, pixel_hash().
template <class U>
RAYTRACE_INLINE ScrambledPoint<U> scrambled_point(const U& pixel, const U& index, Dimension dimension) {
  const U order = mix_bits(pixel ^ U(mix_bits(static_cast<std::uint32_t>(dimension) + 1)));
  const U seed_x = mix_bits(order + U(0x9e3779b9u)), seed_y = mix_bits(seed_x + U(0x9e3779b9u));
  const U place = reversed_bits(owen_scrambled(reversed_bits(index), order));
  // The first coordinate of a Sobol point is its index in reverse. The second, in reverse, has for bit r the sum of the
  // bits j of the index for which r is a subset of j (Pascal's triangle modulo 2: sobol_sequence.h).
  U y = place;
  y = y ^ ((y >> 1) & U(0x55555555u));
  y = y ^ ((y >> 2) & U(0x33333333u));
  y = y ^ ((y >> 4) & U(0x0f0f0f0fu));
  y = y ^ ((y >> 8) & U(0x00ff00ffu));
  y = y ^ (y >> 16);
  return {reversed_bits(owen_scrambled(place, seed_x)), reversed_bits(owen_scrambled(y, seed_y))};
}

/// One coordinate alone, of a sequence for each seed: any 2^k consecutive samples from a multiple of 2^k on have one
/// number in each of 2^k equal parts.
inline UintN scrambled_number(const UintN& seed, const UintN& index) {
  const UintN place = reversed_bits(owen_scrambled(reversed_bits(index), seed));
  return reversed_bits(owen_scrambled(place, mix_bits(seed + UintN(0x9e3779b9u))));
}

/// scrambled_point() as numbers: each lane's of its own pixel and index.
inline Sample2D get_2d(const UintN& pixel, const UintN& index, Dimension dimension) {
  const ScrambledPoint<UintN> point = scrambled_point(pixel, index, dimension);
  return {to_unit(point.x), to_unit(point.y)};
}

}  // namespace raytrace
