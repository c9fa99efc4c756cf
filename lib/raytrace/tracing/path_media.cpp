// The ways of paths through media, and below surfaces.
#include <utility>

#include "raytrace/tracing/identified_rays.h"
#include "raytrace/tracing/media.h"
#include "raytrace/tracing/path_batch.h"
#include "raytrace/tracing/random_walk.h"

namespace raytrace {

MediumBoundary PathBatch::find_boundary(PathPacket& path, MediumStack& media, Hits& hits,
                                        SurfaceInteraction<FloatN>& surface, int depth, RayCounts& counts) {
  const SceneTables& tables = scene_.tables();
  const auto went = [&](const MaskN& lanes, const Rgb<FloatN>& left) {
    path.distance = select(lanes, path.distance + path.rays.far, path.distance);
    path.throughput = select(lanes, path.throughput * left, path.throughput);
  };
  std::uint32_t passes = 0;
  const auto number = [&] { return 0x8000U | static_cast<std::uint32_t>(depth) << 4U | (passes++ & 0xFU); };
  const auto intersect = [&](Ray<FloatN>& rays, MaskN lanes) {
    // Surfaces that are not there hide lights from shadow rays: from here on, paths alone bring theirs.
    path.pdf = select(lanes, infinity<FloatN>(), path.pdf);
    Hits walked;
    MaskN walks(false);
    if (tables.media().scatters()) [[unlikely]] {
      const IntN medium = media.current(tables.media());
      walks = lanes & tables.media().scatters(medium);
      if (any(walks)) {
        std::swap(rays, path.rays);
        walked = walk(path, medium, walks, number(), depth, counts);
        std::swap(rays, path.rays);
        lanes = lanes & !walks;
        if (none(lanes)) return walked;
      }
    }
    if (tables.media().has_fog()) [[unlikely]] {
      std::swap(rays, path.rays);
      const Hits next = go_through_fog(path, media, lanes, {number(), depth, MaskN(true)}, counts);
      std::swap(rays, path.rays);
      return any(walks) ? select(walks, walked, next) : next;
    }
    counts.indirect += count_lanes(lanes);
    const std::uint32_t id = 0x20000000U | static_cast<std::uint32_t>(depth) << 8U | (passes++ & 0xFFU);
    const Hits next = raytrace::intersect(scene_, rays, lanes, {path.pixel, path.sample, id}, Coherence::incoherent,
                                          seen_by(path, depth));
    if (const MaskN escaped = lanes & !next.hit; any(escaped)) {
      const Ray<FloatN> last = path.rays;
      path.rays = rays;
      add_escaped(path, escaped, depth);
      path.rays = last;
    }
    return any(walks) ? select(walks, walked, next) : next;
  };
  return next_boundary(
      scene_, media, path.rays, hits, surface, went, [&] { return tables.ray_cone().half_width(path.distance); },
      intersect, true);
}

void PathBatch::add_invisible_media(const PathPacket& path, const SurfaceInteraction<FloatN>& surface,
                                    const MaskN& lanes, MediumStack& media, MediumBoundary& boundary) const {
  const MaskN see = lanes & seen_by(path, 0);
  if (none(see)) return;
  media.add_first(see, scene_.media_of_all(offset_ray_origin(surface), see, {path.pixel, path.sample, 0}));
  boundary = MediumBoundary(scene_.tables().media(), media, lanes, boundary.inside, surface.front);
}

Hits PathBatch::walk(PathPacket& path, const IntN& medium, const MaskN& lanes, std::uint32_t number, int depth,
                     RayCounts& counts) {
  const MediumWalk end = walk_through(scene_, medium, lanes, {path.pixel, path.sample, number, seen_by(path, depth)},
                                      path.rays, path.throughput, counts);
  // Lights are not drawn to where it scattered, and light paths do not bring what is scattered.
  path.pdf = select(end.scatters, infinity<FloatN>(), path.pdf);
  path.way = select_lanes(end.scatters, IntN(depth == 0 ? by_scattering : any_way), path.way);
  if (has_passes_) [[unlikely]]
    set_first(path, end.scatters, IntN(in_volume));
  return end.hits;
}

void PathBatch::go_below(const PathPacket& path, const Hits& hits, const SurfaceInteraction<FloatN>& surface,
                         const TexturePoint<FloatN>* point, const MaskN& lanes, int depth, RayCounts& counts) {
  const Subsurface<FloatN> inside = scene_.tables().subsurface(hits, point);
  PathPacket below = path;
  below.way = IntN(from_below);
  const WalkIds ids{path.pixel, path.sample, 0x10000U | static_cast<std::uint32_t>(depth)};
  const Hits end = walk_below(scene_, {hits, surface, inside}, lanes, ids, below.rays, below.throughput, counts);
  if (none(end.hit)) return;
  below.set_hits(end);
  append(next_, below, end, end.hit);
}

}  // namespace raytrace
