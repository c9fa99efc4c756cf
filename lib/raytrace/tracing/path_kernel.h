// Path tracing.
#pragma once

#include "raytrace/integrators/path.h"
#include "raytrace/math/kernel.h"
#include "raytrace/scene/scene_tables.h"
#include "raytrace/tracing/path_batch.h"

namespace raytrace {

template <>
class Kernel<Path> {
 public:
  using Batch = PathBatch;
  static constexpr bool takes_samples = true;

  static RadianceRange radiance_range(const SceneTables& scene) {
    RadianceRange range = scene.radiance_range();
    // A room may send on what it got many times; beyond that, sums have more digits at hand.
    range.usual *= 4;
    return range;
  }
};

}  // namespace raytrace
