// The light that photons bring to paths.
#include "raytrace/sampling/sampler.h"
#include "raytrace/tracing/path_batch.h"

namespace raytrace {

void PathBatch::add_photons(const PathPacket& path, const Hits& hits, const SurfaceInteraction<FloatN>& surface,
                            const TexturePoint<FloatN>* point, const MaskN& lanes, int depth) {
  const FloatN u = get_2d(path.pixel, path.sample, photon_dimension(depth)).x;
  const PhotonMap::Light found = photons_->choose(surface.p, surface.ng, lanes, u, settings_.maxdepth - depth - 1);
  if (none(found.lanes)) return;
  IncidentLight light{select(found.lanes, found.wi, surface.ns), FloatN(0), found.flux_density};
  // Over the shaded surface the same light is more or less than over the true one; not much more, since photons that
  // graze the true one are few and would be bright dots.
  const FloatN shaded = dot(surface.ns, light.wi), true_cosine = dot(surface.ng, light.wi);
  light.cosine = select(found.lanes & (true_cosine > FloatN(0)) & (shaded > FloatN(0)),
                        shaded / max(true_cosine, shaded * FloatN(0.25F)), FloatN(0));
  if (surface.has_relief) light.cosine = light.cosine * relief_shadow(surface, light.wi);
  const SceneTables& tables = scene_.tables();
  const Rgb<float> black(0, 0, 0);
  Rgb<FloatN> radiance = tables.shade(hits, surface, black, {&light, 1}, point);
  // What gloss reflects of lamps and skies, paths find by themselves.
  if (any(found.is_met)) {
    const Frame<FloatN> frame = tables.shading_frame(hits, surface, point);
    const Rgb<FloatN> gloss = tables.gloss(hits, surface, frame, {}, frame.to_local(surface.wo),
                                           frame.to_local(light.wi), Gloss::sharp, point);
    radiance = select(found.is_met, saturating_difference(radiance, gloss * light.radiance * light.cosine), radiance);
  }
  radiance = radiance * path.throughput;
  add(indirect_, groups_, path.slot, found.lanes, radiance, groups_ > 1 ? found.group : IntN(0));
  if (has_passes_) [[unlikely]]
    add_to_passes(path, path.first, found.lanes, radiance, depth + 2);
}

}  // namespace raytrace
