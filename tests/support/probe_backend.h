// What stands behind a Probe: one implementation, compiled for each instruction set.
#pragma once

#include "support/probe.h"

namespace raytrace::test {

enum class ProbeWay { single, scattered, packets };

class ProbeBackend {
 public:
  virtual ~ProbeBackend() = default;
  virtual std::vector<ProbeHit> intersect(std::span<const ProbeRay> rays, ProbeWay way) const = 0;
  virtual std::vector<ProbeHit> intersect_embree(std::span<const ProbeRay> rays, int packet_size) const = 0;
  virtual std::vector<bool> occluded(std::span<const ProbeRay> rays, ProbeWay way) const = 0;
  virtual std::vector<bool> occluded_embree(std::span<const ProbeRay> rays, int packet_size) const = 0;
  virtual std::optional<std::vector<ProbeHit>> intersect_seen_from(const Vec3f& point,
                                                                   std::span<const ProbeRay> rays) const = 0;
  virtual std::optional<std::vector<bool>> occluded_seen_from(const Vec3f& place, bool infinitely_far,
                                                              std::span<const ProbeRay> rays) const = 0;
};

}  // namespace raytrace::test
