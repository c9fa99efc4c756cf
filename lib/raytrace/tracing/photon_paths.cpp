#include "raytrace/tracing/photon_paths.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "raytrace/accel/surface_uv.h"
#include "raytrace/film/photons.h"
#include "raytrace/math/lanes.h"
#include "raytrace/parallel/for_each_index.h"
#include "raytrace/sampling/pixel_sampler.h"
#include "raytrace/tracing/light_path_tracer.h"
#include "raytrace/tracing/photon_map.h"
#include "raytrace/tracing/sampled_light.h"

namespace raytrace {

namespace {

/// The radius that is found by itself has about so many photons of a pass.
constexpr std::size_t photons_in_radius = 24;

/// Light paths that a thread takes at a time, and after which it looks whether to stop.
constexpr std::uint32_t paths_at_once = 1024;

class PhotonTracer final : private LightPathTracer {
 public:
  /// paths: of the pass; the camera's have one point at least before they look up photons.
  PhotonTracer(const TracedScene& scene, std::uint32_t paths)
      : LightPathTracer(scene, std::get<Path::Parameters>(scene.tables().integrator()).maxdepth - 1, clock_),
        share_(1 / static_cast<float>(paths)) {}

  /// Light paths [first, first + count) of the pass, whose numbers they draw as samples of one pixel.
  void trace(std::uint32_t pixel, std::uint32_t before, std::uint32_t first, std::uint32_t count,
             RenderReport& report) {
    const UintN first_sample = UintN(before + first) + lane_numbers<UintN>();
    for (std::uint32_t i = 0; i < count; i += packet_lanes) {
      clock_.begin_packet();
      begin(UintN(pixel), first_sample + UintN(i), IntN(0), IntN(0), MaskN(true), report.rays);
      clock_.end(Stage::light_paths);
    }
    follow(report.rays);
    std::ranges::sort(photons_, {}, [&](const PathPhoton& one) { return one.sample - (before + first); });
    report.stages += clock_.times();
  }

  /// In the order of the paths, each of which has left one at most.
  void add_to(std::vector<Photon>& photons) const {
    for (const PathPhoton& one : photons_) photons.push_back(one.photon);
  }

 private:
  void arrive(const LightPathPoint& at, const MaskN& lanes) override {
    const LightPathPacket& path = at.path;
    const SurfaceInteraction<FloatN>& surface = at.surface;
    const auto lights = static_cast<std::int32_t>(tables_.lights().size());
    const Rgb<FloatN> flux = path.flux * (FloatN(share_) / opacity(at, lanes));
    const MaskN lit = lanes & (dot(surface.ng, surface.wo) > FloatN(0)) & (largest(flux) < infinity<FloatN>());
    for (const std::size_t lane : SetLanes(lit)) {
      photons_.push_back({path.sample.get(lane),
                          {in_lane(surface.p, lane), in_lane(surface.ng, lane), in_lane(surface.wo, lane),
                           in_lane(flux, lane), path.group.get(lane), path.source.get(lane) >= lights, at.depth}});
    }
  }

  /// The share of the light that meets the surface. What arrives there is over that, since the camera's paths meet it
  /// as seldom.
  FloatN opacity(const LightPathPoint& at, const MaskN& lanes) const {
    FloatN result(1);
    if (!tables_.has_cutouts()) return result;
    const auto point = [&] { return texture_point(tables_, FloatN(0), at.hits, at.surface); };
    for_each_value(tables_.material(at.hits), lanes, [&](std::int32_t material, const MaskN& here) {
      if (tables_.is_cutout(material)) result = select(here, min(tables_.opacity(material, point), FloatN(1)), result);
    });
    return result;
  }

  struct PathPhoton {
    std::uint32_t sample;  ///< of the path
    Photon photon;
  };
  float share_;
  StageClock clock_;
  std::vector<PathPhoton> photons_;
};

struct Traced {
  std::vector<Photon> photons;
  RenderReport report;
  bool stopped = false;
};

/// Of all light paths of a pass, in their order.
Traced trace_pass(const TracedScene& scene, const FilmSettings& film, std::uint32_t pass, int threads,
                  const std::atomic<bool>* stop) {
  const PhotonPasses passes(film.extent.full_width, film.extent.full_height);
  const int pieces = static_cast<int>(passes.paths / paths_at_once);
  std::vector<std::vector<Photon>> photons(static_cast<std::size_t>(pieces));
  std::vector<RenderReport> reports(photons.size());
  // Their numbers are those of samples of a pixel that no picture has; of another one where 32 bits would run out.
  const std::uint64_t before = std::uint64_t{pass} * passes.paths;
  const std::uint32_t pixel = pixel_hash(~0U, static_cast<std::uint32_t>(before >> 32U), film.seed);
  const auto is_stopped = [&] { return stop != nullptr && stop->load(std::memory_order_relaxed); };
  for_each_index(pieces, threads, [&](int piece) {
    if (is_stopped()) return;
    const auto i = static_cast<std::size_t>(piece);
    PhotonTracer tracer(scene, passes.paths);
    tracer.trace(pixel, static_cast<std::uint32_t>(before), static_cast<std::uint32_t>(piece) * paths_at_once,
                 paths_at_once, reports[i]);
    tracer.add_to(photons[i]);
  });
  Traced traced;
  traced.stopped = is_stopped();
  std::size_t count = 0;
  for (const auto& some : photons) count += some.size();
  traced.photons.reserve(count);
  for (const auto& some : photons) traced.photons.insert(traced.photons.end(), some.begin(), some.end());
  for (const RenderReport& report : reports) traced.report += report;
  return traced;
}

}  // namespace

RenderReport trace_photons(const TracedScene& scene, std::uint32_t pass, int threads, const std::atomic<bool>* stop,
                           Film& film) {
  const Photons* const last = film.photons();
  if (last != nullptr && last->pass == pass) return {};
  const FilmSettings& settings = film.settings();
  float first_radius = static_cast<float>(std::get<Path::Parameters>(scene.tables().integrator()).photonradius);
  RenderReport report;
  std::optional<Traced> traced;
  if (first_radius == 0 && last != nullptr) first_radius = last->first_radius;
  film.set_photons(nullptr);  // so that there is one map at a time
  if (first_radius == 0) {
    traced = trace_pass(scene, settings, 0, threads, stop);
    report += traced->report;
    if (traced->stopped) return report;
    const auto size = static_cast<float>(scene.tables().caustics()->scene_sphere().radius);
    const float found = radius_for(traced->photons, photons_in_radius, threads);
    first_radius = found > 0 ? std::clamp(found, size * 1e-5F, size * 0.1F) : size * 0.01F;
    if (pass != 0) traced.reset();
  }
  if (!traced) {
    traced = trace_pass(scene, settings, pass, threads, stop);
    report += traced->report;
    if (traced->stopped) return report;
  }
  auto map = std::make_unique<PhotonMap>(traced->photons,
                                         first_radius * static_cast<float>(PhotonPasses::radius_share(pass)), threads);
  map->pass = pass;
  map->first_radius = first_radius;
  film.set_photons(std::move(map));
  return report;
}

}  // namespace raytrace
