// What the AOVs of a picture gather while it is rendered, beside the film's sums.
//
// Three rules, none of which depends on the order or the grouping of a pixel's samples:
// - nearest: the values of the sample that met the nearest surface; among equally near ones, that of the lowest index;
// - mean: sums over all samples in fixed point, which are exact;
// - coverage: how many samples met each thing that has an id. All ids are kept, however many there are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "raytrace/film/aov_settings.h"
#include "raytrace/film/film.h"

namespace raytrace {

class ContentHash;

/// How many samples of a pixel met the things of an id.
struct IdCount {
  std::uint32_t id = 0, count = 0;
  friend bool operator==(const IdCount&, const IdCount&) = default;
};

/// Threads may write different pixels at the same time. x, y: in the whole picture, inside the region.
class AovFilm {
 public:
  /// Throws std::bad_alloc.
  AovFilm(const Region& region, const AovSettings& settings);

  const AovSettings& settings() const { return settings_; }
  const Region& region() const { return region_; }

  /// Bytes that a pixel takes, but for the second and further ids of a coverage.
  static std::size_t pixel_bytes(const AovSettings& settings);

  /// A sample that met a surface. values: settings().nearest_values words.
  void add_nearest(int x, int y, float depth, std::uint32_t sample, const std::uint32_t* values);
  /// Whether the sum has room for it.
  bool add_mean(int x, int y, std::size_t mean, std::int64_t units) {
    std::int64_t& sum = sums_[region_.index(x, y) * means() + mean];
    return !__builtin_add_overflow(sum, units, &sum);
  }
  void add_coverage(int x, int y, std::size_t coverage, const IdCount& more);

  struct Nearest {
    std::uint32_t sample = 0;
    float depth = 0;
    const std::uint32_t* values = nullptr;  ///< null if no sample met a surface
  };
  Nearest nearest(int x, int y) const;
  std::int64_t sum(int x, int y, std::size_t mean) const { return sums_[region_.index(x, y) * means() + mean]; }
  /// All that was gathered; it does not depend on the order in which it was.
  void add_to(ContentHash& hash) const;

  /// By falling count; equal counts by rising id.
  std::vector<IdCount> ranked(int x, int y, std::size_t coverage) const;

 private:
  /// Most pixels see a single thing, which takes no memory of its own.
  struct Coverage {
    IdCount first;
    std::unique_ptr<std::vector<IdCount>> others;
  };
  /// In front of the values of a pixel's nearest sample.
  static constexpr std::size_t index_word = 0;  ///< of the sample, plus 1: 0 where there is none
  static constexpr std::size_t depth_word = 1;
  static constexpr std::size_t key_words = 2;

  static std::size_t nearest_words(const AovSettings& settings) {
    return settings.nearest_values == 0 ? 0 : key_words + settings.nearest_values;
  }
  std::size_t means() const { return settings_.mean_units.size(); }

  Region region_;
  AovSettings settings_;
  std::vector<std::uint32_t> nearest_;  ///< nearest_words for each pixel
  std::vector<std::int64_t> sums_;
  std::vector<Coverage> coverages_;
};

}  // namespace raytrace
