// What a render could cost at least: the very same camera and shadow rays in a plain loop of Embree packet queries,
// without a line of shading.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "raytrace/render/renderer.h"

namespace raytrace::benchmark {

/// What the rays are put to.
enum class BareLoop {
  parts,           ///< the renderer's own parts: first the planes, then Embree's scene of all else
  embree,          ///< one scene of Embree's, as it is mostly used: the planes in it, too
  embree_spheres,  ///< the same with Embree's RTC_GEOMETRY_TYPE_SPHERE_POINT; only for scenes of spheres and planes
};

struct CeilingResult {
  double seconds = 0;  ///< in the queries alone, summed over all threads
  RayCounts rays;
};

class Ceiling {
 public:
  virtual ~Ceiling() = default;
  /// Makes the rays of the whole picture tile by tile, and times only their tracing.
  virtual CeilingResult trace(int threads) const = 0;
};

/// isa: one of isa_names() that isa_supported().
std::unique_ptr<Ceiling> make_ceiling(const SceneDescription& description, const std::string& isa, BareLoop bare);

}  // namespace raytrace::benchmark
