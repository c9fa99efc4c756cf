// The picture in memory while it is rendered: sums of samples, from which the means of pixels are made, or these alone.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "raytrace/film/aov_settings.h"
#include "raytrace/film/light_layer.h"
#include "raytrace/film/region.h"
#include "raytrace/math/color.h"
#include "raytrace/memory/large_array.h"

namespace raytrace {

/// The whole picture's size, and the part of it that is rendered.
struct PictureExtent {
  int full_width = 0, full_height = 0;
  Region region;
  friend bool operator==(const PictureExtent&, const PictureExtent&) = default;
};

/// Linear RGB radiance, a mean of samples, and A: 1; in a transparent picture the coverage, by which RGB is multiplied.
struct Pixel {
  float red = 0, green = 0, blue = 0, alpha = 0;
};

/// The sums of a pixel's samples: radiance in fixed point, in the film's units, so that they are exact. The same
/// samples give the same sums in whatever order, and in however many parts, they are added.
struct PixelSum {
  std::int64_t red = 0, green = 0, blue = 0;
  std::uint32_t hits = 0;     ///< samples that hit an object
  std::uint32_t samples = 0;  ///< all
  PixelSum& operator+=(const PixelSum& other) {
    red += other.red;
    green += other.green;
    blue += other.blue;
    hits += other.hits;
    samples += other.samples;
    return *this;
  }
  friend bool operator==(const PixelSum&, const PixelSum&) = default;
};

/// What the numbers of a PixelSum cannot hold, in units 2^64 times theirs: zeros for nearly all pixels, since no sum of
/// samples within the bound that the unit is made from leaves 64 bits.
struct PixelSumHigh {
  std::int64_t red = 0, green = 0, blue = 0;
  friend bool operator==(const PixelSumHigh&, const PixelSumHigh&) = default;
};

/// Which samples a film takes: indices of each pixel's sequence.
struct SampleRange {
  std::uint32_t first = 0;
  std::uint32_t count = 1;
  bool centered = false;  ///< the only sample is not the sequence's first, but the pixel's center
  friend bool operator==(const SampleRange&, const SampleRange&) = default;
};

/// What a film's samples depend on besides the scene, and what its sums mean.
struct FilmSettings {
  PictureExtent extent;
  SampleRange samples;
  std::uint64_t seed = 0;
  int unit_exponent = -44;  ///< the sums count radiance in units of 2^unit_exponent
  AovSettings aovs;
  /// The background is left out of the colour, and A is coverage: the part of a pixel's samples that hit an object.
  bool transparent = false;
  /// Where light paths are traced, which may reach any pixel, the film holds the whole picture, or crop, whatever part
  /// of it is rendered: these are the pixels whose samples and light paths it takes. None: there are no light paths,
  /// and all its pixels are.
  std::optional<Region> light_paths_of = std::nullopt;
  /// What a light path brings goes to one of the pixels that the filter would spread it over, by chance, so that the
  /// noise of each pixel is its own: a denoiser takes noise that pixels share for a texture.
  bool single_splats = false;
  Region rendered() const { return light_paths_of.value_or(extent.region); }
  friend bool operator==(const FilmSettings&, const FilmSettings&) = default;
};

/// The exponent of a unit so small that a sample's rounding to it cannot be seen, and so large that the sums of
/// `samples` values up to `largest` fit: 2^-44 of the next power of two above it, for up to 524,288 samples.
int unit_exponent(float largest, std::uint64_t samples);

/// What a scene's samples may be. Magnitudes, in any channel: radiance may be negative.
struct RadianceRange {
  float usual = 0;    ///< most samples stay below it
  float largest = 0;  ///< all do, or those that must fit
  /// The most that the dimmest source gives alone. A source is the background, or what a material sends on from one
  /// light; those that give nothing do not count.
  float dimmest = std::numeric_limits<float>::infinity();

  void add_usual(const Rgb<float>& radiance) { usual = std::max({usual, radiance.red, radiance.green, radiance.blue}); }
  void add_largest(const Rgb<float>& radiance) {
    largest = std::max({largest, radiance.red, radiance.green, radiance.blue});
  }
  void add_source(const Rgb<float>& radiance) {
    for (const float channel : {radiance.red, radiance.green, radiance.blue})
      if (channel > 0) dimmest = std::min(dimmest, channel);
  }
};

/// The film's: that of `usual`, but so much smaller that the dimmest source has all the bits of a float (or of the
/// least half, if it is dimmer than that), as far as `largest` fits in both limbs of a sum. It depends on nothing else,
/// so that the parts of a picture agree on it.
int unit_exponent(const RadianceRange& range, std::uint64_t samples);

/// Whether the unit gives the dimmest source that many bits.
bool is_fine_for_dimmest(const RadianceRange& range, int unit_exponent);

/// Whether unit_exponent() may be that of a picture.
bool is_unit_exponent(int exponent);

class AovFilm;
class ContentHash;
class Photons;
class SplatLayer;

/// A Pixel's four numbers as IEEE 754 binary16.
using HalfPixel = std::array<std::uint16_t, 4>;

/// What a film holds of each pixel. Memory that is fresh from the system takes time, so a picture that is rendered in
/// one go, keeps no more than its files want.
enum class FilmContent {
  sums,        ///< PixelSum, 32 bytes: samples can be added at any time, and in any order; PixelSumHigh where needed
  means,       ///< Pixel, 16 bytes
  half_means,  ///< HalfPixel, 8 bytes; infinity beyond its range
};

/// Holds the pixels of a region, all zero at first. Threads may write different pixels at the same time.
class Film {
 public:
  /// Throws std::bad_alloc. With means, no AOVs are gathered, and no light paths; the scene has a single light group.
  explicit Film(const FilmSettings& settings, FilmContent content = FilmContent::sums);
  ~Film();
  Film(Film&&) noexcept;
  Film& operator=(Film&&) noexcept;

  const FilmSettings& settings() const { return settings_; }
  const Region& region() const { return settings_.extent.region; }
  FilmContent content() const { return content_; }
  /// The radiance that is 1 in sums: 2^unit_exponent.
  double unit() const { return unit_; }

  /// The mean of the pixel's samples; black and empty if it has none. x, y: in the whole picture, inside region().
  Pixel pixel(int x, int y) const;

  /// All of them: row by row from the region's top, each from its left.
  std::vector<Pixel> pixels() const;

  // Of films of sums.

  /// Adds to the pixel's sums, exactly: what 64 bits cannot hold goes to high(), which takes memory, 24 bytes for every
  /// pixel, from then on. Throws std::bad_alloc.
  void add(int x, int y, const PixelSum& more) {
    PixelSum& sum = sums_[index(x, y)];
    const PixelSum before = sum;
    bool wraps = __builtin_add_overflow(before.red, more.red, &sum.red);
    wraps |= __builtin_add_overflow(before.green, more.green, &sum.green);
    wraps |= __builtin_add_overflow(before.blue, more.blue, &sum.blue);
    sum.hits += more.hits;
    sum.samples += more.samples;
    if (wraps) [[unlikely]]
      carry(x, y, before, more);
  }
  void add(int x, int y, const PixelSum& more, const PixelSumHigh& more_high);

  PixelSum& sum(int x, int y) { return sums_[index(x, y)]; }
  const PixelSum& sum(int x, int y) const { return sums_[index(x, y)]; }
  std::span<const PixelSum> sums() const {
    return {sums_.data(), content_ == FilmContent::sums ? region().pixels() : 0};
  }

  PixelSumHigh high(int x, int y) const {
    return highs_.data() == nullptr ? PixelSumHigh() : highs_.data()[index(x, y)];
  }
  /// Whether that of any pixel is not zero.
  bool has_high() const;

  /// All sums, whatever the order in which they came to be.
  void add_to(ContentHash& hash) const;

  /// What the AOVs gather; null if they need nothing beside the sums.
  AovFilm* aovs() { return aovs_.get(); }
  const AovFilm* aovs() const { return aovs_.get(); }

  /// What light paths brought; null if there are none.
  SplatLayer* splats() { return splats_.get(); }
  const SplatLayer* splats() const { return splats_.get(); }

  /// Of the pass that is rendered, or was last; null if there are none. They are no part of the picture.
  const Photons* photons() const { return photons_.get(); }
  void set_photons(std::unique_ptr<const Photons> photons);

  /// The parts of the light that settings().aovs.layers names, in their order. All light groups add up to the film's
  /// own sums and splats exactly, all passes but for the rounding of each to the film's unit.
  std::span<LightLayer> lights() { return lights_; }
  std::span<const LightLayer> lights() const { return lights_; }
  /// As pixel(), of one of them.
  Pixel light_pixel(const LightLayer& light, int x, int y) const;

  /// The fewest samples that a pixel has, of those that are rendered.
  std::uint32_t fewest_samples() const;

  // Of films of means, which film_means.h sets.

  // The pixels that follow are beside it, row by row.

  Pixel& float_mean(int x, int y) { return means_[index(x, y)]; }
  HalfPixel& half_mean(int x, int y) { return half_means_[index(x, y)]; }
  const HalfPixel& half_mean(int x, int y) const { return half_means_[index(x, y)]; }

 private:
  std::size_t index(int x, int y) const { return region().index(x, y); }
  void carry(int x, int y, const PixelSum& before, const PixelSum& more);

  FilmSettings settings_;
  FilmContent content_;
  double unit_;  ///< of radiance
  // One of them holds the pixels.
  LargeArray<PixelSum> sums_;
  LargeArray<Pixel> means_;
  LargeArray<HalfPixel> half_means_;
  LateArray<PixelSumHigh> highs_;  ///< of the sums
  std::unique_ptr<AovFilm> aovs_;
  std::unique_ptr<SplatLayer> splats_;
  std::unique_ptr<const Photons> photons_;
  std::vector<LightLayer> lights_;
};

}  // namespace raytrace
