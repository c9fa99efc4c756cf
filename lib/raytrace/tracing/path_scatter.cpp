// From one point of a path to the next.
#include "raytrace/sampling/sampler.h"
#include "raytrace/tracing/identified_rays.h"
#include "raytrace/tracing/panes.h"
#include "raytrace/tracing/path_batch.h"

namespace raytrace {

void PathBatch::scatter_branch(const PathPacket& path, const PathDeparture& from, int branch, RayCounts& counts) {
  PathPacket next = path;
  next.sample =
      sample_of_branch(path.sample, static_cast<std::uint32_t>(branch), static_cast<std::uint32_t>(branches_));
  next.slot = path.slot + IntN((branch + 1) * packet_lanes);
  const auto draw = [&](PathDraw what) { return get_2d(next.pixel, next.sample, path_dimension(from.depth, what)); };
  const Sample2D direction = draw(PathDraw::direction), choices = draw(PathDraw::lobe_and_roulette);
  const PathVertex& vertex = from.vertex;
  const Vec3<FloatN> wo = vertex.frame.to_local(vertex.surface.wo);
  const Scattering scattering =
      scene_.tables().scatter(vertex.hits, vertex.surface, vertex.frame, from.boundary.media, wo, MaskN(false), wo,
                              choices.x, direction.x, direction.y, vertex.textures);
  scatter(next, from, scattering.sample, choices.y, counts);
}

void PathBatch::set_way(PathPacket& path, const PathDeparture& from, const BsdfSample<FloatN>& sample,
                        const MaskN& lanes) const {
  const MaskN through = sample.wi.z < FloatN(0);
  // No light path comes to a face from behind it, whatever the smooth surface there.
  const MaskN above = through | (dot(path.rays.direction, from.vertex.surface.ng) > FloatN(0));
  // Photons about a point of a fibre are those of a surface that is wider than it is: there, paths go on by themselves.
  MaskN brought = from.is_first;
  if (photons_ != nullptr) brought = brought | !from.vertex.fibres;
  const MaskN reflects = brought & above & !(from.focuses | through | sample.specular);
  const MaskN by_gloss_alone = split_gloss(path, from, sample, lanes & reflects);
  IntN way = select_lanes(reflects, IntN(by_reflection), IntN(any_way));
  way = select_lanes(by_gloss_alone, IntN(by_gloss), way);
  way = select_lanes(from.on_gloss_way & above, IntN(by_gloss_focus), way);
  path.way = select_lanes(from.on_way & above, IntN(by_focus), way);
}

MaskN PathBatch::split_gloss(PathPacket& path, const PathDeparture& from, const BsdfSample<FloatN>& sample,
                             const MaskN& lanes) const {
  if (none(lanes)) return lanes;
  const PathVertex& vertex = from.vertex;
  const Vec3<FloatN> wo = vertex.frame.to_local(vertex.surface.wo);
  const Rgb<FloatN> gloss = scene_.tables().gloss(vertex.hits, vertex.surface, vertex.frame, from.boundary.media, wo,
                                                  sample.wi, Gloss::sharp, vertex.textures);
  const auto sum = [](const Rgb<FloatN>& c) { return c.red + c.green + c.blue; };
  const FloatN all = sum(sample.f);
  const FloatN chance = select(lanes & (all > FloatN(0)), min(sum(gloss) / all, FloatN(1)), FloatN(0));
  const MaskN both = lanes & (chance > FloatN(0));
  if (none(both)) return both;
  const FloatN u = get_2d(path.pixel, path.sample, gloss_dimension(from.depth)).x;
  const MaskN by_gloss_alone = both & (u < chance);
  const FloatN scale = FloatN(1) / select(by_gloss_alone, chance, max(FloatN(1) - chance, FloatN(1e-6F)));
  const auto part = [&](const FloatN& of_gloss, const FloatN& of_all) {
    const FloatN kept = select(by_gloss_alone, of_gloss, max(of_all - of_gloss, FloatN(0)));
    return select(of_all > FloatN(0), kept / of_all * scale, FloatN(0));
  };
  const Rgb<FloatN> parts{part(gloss.red, sample.f.red), part(gloss.green, sample.f.green),
                          part(gloss.blue, sample.f.blue)};
  path.throughput = select(both, path.throughput * parts, path.throughput);
  if (has_passes_ && from.depth == 0) [[unlikely]] {
    const Rgb<FloatN> rest = saturating_difference(sample.f, gloss), all_gloss = path.gloss_share * sample.f;
    const Rgb<FloatN> left = share_of(saturating_difference(all_gloss, gloss), rest);
    path.gloss_share = select(both, select(by_gloss_alone, Rgb<FloatN>(Rgb<float>(1, 1, 1)), left), path.gloss_share);
  }
  return by_gloss_alone;
}

void PathBatch::scatter(PathPacket& path, const PathDeparture& from, const BsdfSample<FloatN>& sample,
                        const FloatN& roulette, RayCounts& counts) {
  const SceneTables& tables = scene_.tables();
  const SurfaceInteraction<FloatN>& surface = from.vertex.surface;
  const int depth = from.depth;
  Ray<FloatN>& rays = path.rays;
  if (follows_mirrors_) [[unlikely]]
    stop_following(path, from.lanes & !sample.specular);
  rays.direction = from.vertex.frame.to_world(sample.wi);
  MaskN through = sample.wi.z < FloatN(0);
  // On the true surface the direction is on the same side as on the shaded one. Fibres send light to all sides.
  const FloatN true_cosine = dot(rays.direction, select(through, surface.ng, surface.true_normal()));
  MaskN alive = from.lanes & (sample.pdf > FloatN(0)) & (from.vertex.fibres | (true_cosine * sample.wi.z > FloatN(0)));
  if (const MaskN& fibres = from.vertex.fibres; any(fibres)) [[unlikely]]
    through = (fibres & (dot(rays.direction, surface.ng) < FloatN(0))) | (through & !fibres);
  FloatN weight = abs(sample.wi.z) / sample.pdf;
  if (surface.has_relief) weight = select(through, weight, weight * relief_shadow(surface, rays.direction));
  path.throughput = select(alive, path.throughput * sample.f * weight, Rgb<FloatN>(Rgb<float>(0, 0, 0)));
  path.eta2 = path.eta2 * sample.eta2;
  if (has_passes_ && depth == 0) [[unlikely]] {
    const MaskN is_first = from.lanes & float_mask<FloatN>(path.first == IntN(unscattered));
    path.gloss_share =
        select(is_first, gloss_share(tables, from.vertex, from.boundary.media, sample), path.gloss_share);
    set_first(path, is_first, select_lanes(through, IntN(transmitted), IntN(reflected)));
    path.first = select_lanes(is_first & sample.enters, IntN(below_surface), path.first);
  }
  if (tables.caustics() != nullptr) set_way(path, from, sample, alive);
  if (depth + 1 >= settings_.roulettedepth) {
    // Twice as many as carry it: what ends has cost little, and what goes on need not be much brighter.
    const FloatN survival = min(largest(path.throughput) * path.eta2 * FloatN(2), FloatN(1));
    path.throughput = path.throughput * (FloatN(1) / max(survival, FloatN(1e-12F)));
    alive = alive & (roulette < survival);
  }
  alive = alive & (largest(path.throughput) > FloatN(0));
  if (none(alive)) return clock_.end(Stage::shade);
  MaskN onward(false);  // straight through a pane: as if they came from where they were scattered last
  if (tables.has_panes()) [[unlikely]] {
    onward = sample.specular & through & tables.is_pane(tables.material(from.vertex.hits)) &
             goes_straight(-surface.wo, rays.direction);
    // Where light paths bring what surfaces get through panes, paths from fog alone.
    const Vec3<FloatN>& n = path.from_normal;
    if (!tables.has_panes_for_surfaces()) onward = onward & (dot(n, n) == FloatN(0));
  }
  path.pdf = select(onward, path.pdf,
                    select(sample.specular | (through & !from.vertex.both_sides), infinity<FloatN>(), sample.pdf));
  path.from = select(onward, path.from, surface.p);
  path.from_normal = select(onward, path.from_normal, from.vertex.side());
  rays.origin = offset_ray_origin(surface, through & alive);
  if (const MaskN enters = alive & sample.enters; any(enters)) [[unlikely]] {
    clock_.end(Stage::shade);
    if (depth + 1 < settings_.maxdepth)
      go_below(path, from.vertex.hits, surface, from.vertex.textures, enters, depth, counts);
    clock_.end(Stage::trace);
    alive = alive & !enters;
    if (none(alive)) return;
  }
  MediumStack media = from.media;
  if (!tables.media().empty()) {
    from.boundary.cross(media, through & alive, surface.front);
    const MediumStack::Packed packed = media.packed();
    path.first_media = packed.first;
    path.last_media = packed.last;
  }
  rays.near = FloatN(0);
  rays.far = infinity<FloatN>();
  if (tables.media().scatters()) [[unlikely]] {
    const IntN medium = media.current(tables.media());
    if (const MaskN walks = alive & tables.media().scatters(medium); any(walks)) {
      clock_.end(Stage::shade);
      const Hits walked = walk(path, medium, walks, static_cast<std::uint32_t>(depth) + 1, depth + 1, counts);
      path.set_hits(walked);
      append(next_, path, walked, walked.hit);
      alive = alive & !walks;
      clock_.end(Stage::trace);
      if (none(alive)) return;
    }
  }
  clock_.end(Stage::shade);
  if (tables.media().has_fog()) [[unlikely]] {
    const Hits next =
        go_through_fog(path, media, alive, {static_cast<std::uint32_t>(depth) + 1, depth + 1, through}, counts);
    path.set_hits(next);
    append(next_, path, next, next.hit);
    return clock_.end(Stage::trace);
  }
  counts.indirect += count_lanes(alive);
  const Hits hits = intersect(scene_, rays, alive, {path.pixel, path.sample, from.next_key}, Coherence::incoherent);
  clock_.end(Stage::trace);
  if (const MaskN escaped = alive & !hits.hit; any(escaped)) add_escaped(path, escaped, depth + 1);
  clock_.end(Stage::lights);
  if (none(hits.hit)) return;
  path.set_hits(hits);
  append(next_, path, hits, hits.hit);
  clock_.end(Stage::surface);
}

}  // namespace raytrace
