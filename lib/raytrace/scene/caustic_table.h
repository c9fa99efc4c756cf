// Where light paths start, and what they are aimed at: mirrors, metals and clear glass, whose light other surfaces get.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "raytrace/scene/emitter_table.h"
#include "raytrace/scene/environment.h"
#include "raytrace/scene/geometry_table.h"
#include "raytrace/scene/light_source.h"

namespace raytrace {

/// A choice out of many, by their weights.
class WeightedChoice {
 public:
  WeightedChoice() = default;
  /// None of the weights is negative; one at least is not 0.
  explicit WeightedChoice(std::span<const double> weights);

  struct Choice {
    std::int32_t number;
    float probability;
  };
  /// u: in [0, 1).
  Choice choose(float u) const;

 private:
  std::vector<double> shares_;  ///< of all up to each, the last is 1
};

/// Immutable.
class CausticTable {
 public:
  /// What shines.
  struct Lights {
    const std::vector<std::unique_ptr<LightSource>>& sources;
    const EmitterTable& emitters;
    const Environment* environment;  ///< null if there is none
  };

  /// focusing: 1 for materials that focus light (materials/kernels.h), else 0.
  CausticTable(const GeometryTable& geometry, std::span<const std::uint8_t> focusing, const Lights& lights);

  /// Whether there is nothing that focuses light, or no light.
  bool empty() const { return targets_.empty() || source_count_ == 0; }

  /// A sphere around some of the objects that focus light. Each of them is in one target's; planes are in none.
  struct Target {
    Vec3f center;
    float radius;
  };
  const Target& target(std::int32_t number) const { return targets_[static_cast<std::size_t>(number)]; }

  /// The target of what each lane hit; -1 if that does not focus light. material: its number.
  IntN target_of(const GeometryTable& geometry, const Hits& hits, const IntN& material) const;

  /// A light path's start is drawn as a source of light and, independently, a target that it is aimed at. Sources are
  /// the scene's lights by their numbers, then the emitters' patches, then the environment.
  WeightedChoice::Choice choose_source(float u) const { return sources_.choose(u); }
  WeightedChoice::Choice choose_target(float u) const { return target_choice_.choose(u); }

  /// Around all targets, and whatever may be in the way to them but planes.
  const BoundingSphere& scene_sphere() const { return scene_sphere_; }

 private:
  void add_targets(const GeometryTable& geometry, std::span<const std::uint8_t> focusing);
  void weigh(const Lights& lights);

  std::vector<Target> targets_;
  std::vector<std::int32_t> target_of_object_, target_of_instance_;  ///< -1: none
  std::vector<std::int32_t> focusing_;                               ///< of all materials, 1 or 0
  std::size_t source_count_ = 0;
  WeightedChoice sources_, target_choice_;
  BoundingSphere scene_sphere_;
};

}  // namespace raytrace
