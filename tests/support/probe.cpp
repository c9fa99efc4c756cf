#include "support/probe.h"

#include <stdexcept>

#include "raytrace/variants/variant_list.h"
#include "support/probe_backend.h"

#define RAYTRACE_DECLARE(name, isa) \
  extern "C" raytrace::test::ProbeBackend* raytrace_probe_##name(const raytrace::SceneDescription& description);
RAYTRACE_VARIANTS(RAYTRACE_DECLARE)
#undef RAYTRACE_DECLARE

namespace raytrace::test {

struct Probe::Implementation {
  std::unique_ptr<ProbeBackend> backend;
};

Probe::Probe(const SceneDescription& description, const std::string& isa)
    : implementation_(std::make_unique<Implementation>()) {
#define RAYTRACE_CHOOSE(name, text) \
  if (isa == text) implementation_->backend.reset(raytrace_probe_##name(description));
  RAYTRACE_VARIANTS(RAYTRACE_CHOOSE)
#undef RAYTRACE_CHOOSE
  if (!implementation_->backend) throw std::invalid_argument("no probe for " + isa);
}

Probe::~Probe() = default;

std::vector<ProbeHit> Probe::intersect_single(std::span<const ProbeRay> rays) const {
  return implementation_->backend->intersect(rays, ProbeWay::single);
}

std::vector<ProbeHit> Probe::intersect_scattered(std::span<const ProbeRay> rays) const {
  return implementation_->backend->intersect(rays, ProbeWay::scattered);
}

std::vector<ProbeHit> Probe::intersect_packet(std::span<const ProbeRay> rays) const {
  return implementation_->backend->intersect(rays, ProbeWay::packets);
}

std::vector<ProbeHit> Probe::intersect_embree(std::span<const ProbeRay> rays, int packet_size) const {
  return implementation_->backend->intersect_embree(rays, packet_size);
}

std::vector<bool> Probe::occluded_single(std::span<const ProbeRay> rays) const {
  return implementation_->backend->occluded(rays, ProbeWay::single);
}

std::vector<bool> Probe::occluded_scattered(std::span<const ProbeRay> rays) const {
  return implementation_->backend->occluded(rays, ProbeWay::scattered);
}

std::vector<bool> Probe::occluded_packet(std::span<const ProbeRay> rays) const {
  return implementation_->backend->occluded(rays, ProbeWay::packets);
}

std::vector<bool> Probe::occluded_embree(std::span<const ProbeRay> rays, int packet_size) const {
  return implementation_->backend->occluded_embree(rays, packet_size);
}

std::optional<std::vector<ProbeHit>> Probe::intersect_seen_from(const Vec3f& point,
                                                                std::span<const ProbeRay> rays) const {
  return implementation_->backend->intersect_seen_from(point, rays);
}

std::optional<std::vector<bool>> Probe::occluded_seen_from(const Vec3f& place, bool infinitely_far,
                                                           std::span<const ProbeRay> rays) const {
  return implementation_->backend->occluded_seen_from(place, infinitely_far, rays);
}

}  // namespace raytrace::test
