// A scene that is ready to be traced, as code without SIMD types sees it. variants/variant.h makes one.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

#include "raytrace/film/film.h"

namespace raytrace {

/// A scene that could not be built or rendered (Embree's or the machine's fault, not the scene file's).
class RenderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct SceneStatistics {
  std::uint64_t primitives = 0;
  std::uint64_t bvh_bytes = 0;  ///< what Embree holds by now for this scene: it may wait for a ray that wants its BVH
  std::string isa;              ///< of the variant in use
  int lanes = 0;                ///< rays a packet
  std::string embree_version;
};

/// Immutable.
class Scene {
 public:
  virtual ~Scene() = default;

  /// As the integrator knows it. It scales the film's unit.
  virtual RadianceRange radiance_range() const = 0;

  /// Whether paths start at its lights, too, whose films have splats (film/splat_layer.h).
  virtual bool traces_light_paths() const = 0;

  /// Whether these paths leave photons, which samples look up (film/photons.h).
  virtual bool has_photons() const = 0;

  /// The albedo of no material in use has a larger magnitude, in any channel.
  virtual float largest_albedo() const = 0;

  /// The name of its variant's instruction set.
  virtual const char* isa() const = 0;

  virtual SceneStatistics statistics() const = 0;
};

}  // namespace raytrace
