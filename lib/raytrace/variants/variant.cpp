#include "raytrace/variants/variant.h"

#include "raytrace/tracing/photon_paths.h"
#include "raytrace/tracing/render_tile.h"

#define RAYTRACE_JOIN_NAMES(a, b) a##b
#define RAYTRACE_JOIN(a, b) RAYTRACE_JOIN_NAMES(a, b)

namespace raytrace {

namespace {

constexpr const char* widest_embree_isa = register_lanes == 16 ? "avx512" : register_lanes == 8 ? "avx2" : "sse4.2";

std::unique_ptr<const Scene> build(const SceneDescription& description, int threads) {
  auto scene = std::make_unique<TracedScene>(description, threads, RAYTRACE_ISA, widest_embree_isa);
  scene->set_radiance_range(radiance_range(scene->tables()));
  return scene;
}

RenderReport render(const Scene& scene, const Region& tile, std::uint32_t samples, Film& film,
                    const std::atomic<bool>* stop) {
  return render_tile(static_cast<const TracedScene&>(scene), tile, samples, film, stop);
}

RenderReport photons(const Scene& scene, std::uint32_t pass, int threads, const std::atomic<bool>* stop, Film& film) {
  return trace_photons(static_cast<const TracedScene&>(scene), pass, threads, stop, film);
}

}  // namespace

}  // namespace raytrace

extern "C" const raytrace::Variant& RAYTRACE_JOIN(raytrace_variant_, RAYTRACE_VARIANT)() {
  static constexpr raytrace::Variant variant{RAYTRACE_ISA, raytrace::widest_embree_isa, &raytrace::build,
                                             &raytrace::render, &raytrace::photons};
  return variant;
}
