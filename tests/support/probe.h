// Traces given rays through the library's accelerator, one by one or in packets, so that tests can hold the answers
// against a reference. Wide types stay behind this header: the probe of each instruction set is chosen by name.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "raytrace/description/scene_description.h"
#include "raytrace/math/vec3.h"

namespace raytrace::test {

struct ProbeRay {
  Vec3f origin;
  Vec3f direction;  ///< of any finite length but 0; distances count in multiples of it
  float near = 0;
  float far = 3e38f;
};

struct ProbeHit {
  bool hit = false;
  float distance = 0;       ///< along the ray, in multiples of direction
  std::uint32_t kind = 0;   ///< position of the shape's type in the Shapes registry
  std::uint32_t index = 0;  ///< among the scene's objects of that type, in their order in the description
  Vec3f position;           ///< the surface point that shading uses
  Vec3f normal;             ///< unit length, turned to face the ray's origin
  Vec3f offset_ray_origin;  ///< where a secondary ray that leaves along `normal`'s side would start
};

/// A scene in the accelerator of one instruction set.
class Probe {
 public:
  /// isa: one of isa_names() that isa_supported().
  Probe(const SceneDescription& description, const std::string& isa);
  ~Probe();

  /// Nearest hits, one ray a query of Embree's.
  std::vector<ProbeHit> intersect_single(std::span<const ProbeRay> rays) const;
  /// The same as paths ask for them: with all objects where they are few, else as before.
  std::vector<ProbeHit> intersect_scattered(std::span<const ProbeRay> rays) const;
  /// The same by packets of the variant's native width (consecutive rays share one; the last one is filled up with
  /// inactive lanes).
  std::vector<ProbeHit> intersect_packet(std::span<const ProbeRay> rays) const;
  /// Nearest hits straight from Embree's packet query of size 4, 8 or 16, after the shapes that are not in its scene
  /// (only hit, distance, kind and index are filled in).
  std::vector<ProbeHit> intersect_embree(std::span<const ProbeRay> rays, int packet_size) const;
  /// Nearest hits of rays from `point`, with directions of unit length, by packets that know what is seen from there;
  /// none if the accelerator sees nothing to gain.
  std::optional<std::vector<ProbeHit>> intersect_seen_from(const Vec3f& point, std::span<const ProbeRay> rays) const;
  /// Whether anything lies between near and far; the same ways.
  std::vector<bool> occluded_single(std::span<const ProbeRay> rays) const;
  std::vector<bool> occluded_scattered(std::span<const ProbeRay> rays) const;
  std::vector<bool> occluded_packet(std::span<const ProbeRay> rays) const;
  std::vector<bool> occluded_embree(std::span<const ProbeRay> rays, int packet_size) const;
  /// Of rays that go to `place`: a point, to which their direction leads, or infinitely far, with `place` for
  /// direction.
  std::optional<std::vector<bool>> occluded_seen_from(const Vec3f& place, bool infinitely_far,
                                                      std::span<const ProbeRay> rays) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace raytrace::test
