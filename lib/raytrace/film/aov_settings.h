// Which AOVs a picture has, and what a film must keep of each pixel for them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace raytrace {

/// Some of the AOVs of aov_table (aovs/aov_table.h), by their indices in it, and what some light groups bring.
class AovSet {
 public:
  void add(std::size_t aov) { bits_ |= std::uint32_t{1} << aov; }
  bool has(std::size_t aov) const { return (bits_ >> aov & 1U) != 0; }
  void add(const AovSet& others) {
    bits_ |= others.bits_;
    light_groups_.insert(others.light_groups_.begin(), others.light_groups_.end());
  }
  void add_light_group(const std::string& name) { light_groups_.insert(name); }
  const std::set<std::string>& light_groups() const { return light_groups_; }
  /// All light groups of the scene, if it has any but the default one: replaced by their names when it is read.
  bool wants_all_light_groups = false;

  bool empty() const { return bits_ == 0 && light_groups_.empty(); }
  friend bool operator==(const AovSet&, const AovSet&) = default;

 private:
  std::uint32_t bits_ = 0;
  std::set<std::string> light_groups_;
};

/// The wanted AOVs' values follow each other in the table's order, rule by rule.
struct AovSettings {
  AovSet wanted;
  std::size_t nearest_values = 0;  ///< of the sample that met the nearest surface: 32 bit words
  std::vector<int> mean_units;     ///< for each mean: its sum counts units of 2^this
  std::size_t coverages = 0;
  /// The AOVs that are parts of the picture's light, of which a film keeps exact sums: first the passes, in the table's
  /// order, then the light groups.
  std::vector<std::string> layers;
  /// For each coverage: the ids of the things with indices 0, 1... Things of equal ids count as one. Needed only where
  /// samples are taken.
  using CoverageIds = std::vector<std::vector<std::uint32_t>>;
  std::shared_ptr<const CoverageIds> coverage_ids;

  /// Whether values of the one can be added to the other's.
  friend bool operator==(const AovSettings& a, const AovSettings& b) {
    return a.wanted == b.wanted && a.nearest_values == b.nearest_values && a.mean_units == b.mean_units &&
           a.coverages == b.coverages;
  }

  /// Whether a film must keep anything beside its own sums.
  bool gather() const { return nearest_values > 0 || !mean_units.empty() || coverages > 0; }
};

}  // namespace raytrace
