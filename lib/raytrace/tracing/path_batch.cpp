#include "raytrace/tracing/path_batch.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

#include "raytrace/math/lanes.h"
#include "raytrace/sampling/sampler.h"
#include "raytrace/tracing/camera_hits.h"
#include "raytrace/tracing/direct_light.h"
#include "raytrace/tracing/media.h"
#include "raytrace/tracing/random_walk.h"
#include "raytrace/tracing/sampled_light.h"

namespace raytrace {

namespace {

Rgb<FloatN> black() { return Rgb<FloatN>(Rgb<float>(0, 0, 0)); }

}  // namespace

PathBatch::PathBatch(const TracedScene& scene, const Film& film)
    : scene_(scene),
      photons_(static_cast<const PhotonMap*>(film.photons())),
      is_transparent_(film.settings().transparent),
      follows_mirrors_(follow_mirrors(film.settings().aovs.wanted)),
      has_passes_(raytrace::has_passes(film.settings().aovs.wanted)),
      settings_(std::get<Path::Parameters>(scene.tables().integrator())),
      branches_(static_cast<std::size_t>(settings_.indirectsamples)),
      most_packets_(std::max<std::size_t>(1, most_paths / packet_lanes / branches_)),
      paths_(most_packets_ * branches_ * packet_lanes, PathPacket::unused(scene.tables().media(), has_passes_)),
      next_(most_packets_ * branches_ * packet_lanes, PathPacket::unused(scene.tables().media(), has_passes_)),
      groups_(scene.tables().light_groups().size()),
      has_one_light_(scene.tables().emitters().size() + (scene.tables().environment() != nullptr ? 1 : 0) == 1),
      strands_(branches_ == 1 ? 1 : 1 + branches_) {
  order_.reserve(most_packets_ * branches_ * packet_lanes);
  direct_.reserve(most_packets_ * strands_ * groups_);
  indirect_.reserve(most_packets_ * strands_ * groups_);
}

void PathBatch::clear() {
  direct_.clear();
  indirect_.clear();
  pass_sums_.clear();
  followed_.clear();
}

MaskN PathBatch::add(CameraRays& camera, const MaskN& active, const MaskN& wanted, FirstHits* first) {
  clock_.end(Stage::camera);
  const Hits hits = intersect_camera_rays(scene_, camera, active);
  clock_.end(Stage::trace);
  if (first != nullptr) {
    first->hits = hits;
    first->textures.reset();
    if (any(hits.hit)) {
      first->surface = scene_.accelerator().surface(camera.rays, hits);
      first->textures =
          add_textures(scene_.tables(), hits, first->surface, [&] { return camera_radius(scene_.tables(), camera); });
    }
  }
  const auto first_slot = static_cast<std::int32_t>(packets() * strands_ * packet_lanes);
  direct_.resize(direct_.size() + strands_ * groups_);
  indirect_.resize(indirect_.size() + strands_ * groups_);
  if (has_passes_) pass_sums_.resize(pass_sums_.size() + strands_ * pass_slots);
  if (follows_mirrors_) followed_.emplace_back();
  PathPacket path;
  path.rays = camera.rays;
  path.set_hits(hits);
  path.throughput = Rgb<FloatN>(Rgb<float>(1, 1, 1));
  path.eta2 = FloatN(1);
  path.distance = camera.skipped;
  path.pdf = infinity<FloatN>();
  path.from = path.from_normal = Vec3<FloatN>(Vec3f(0, 0, 0));
  path.pixel = camera.pixel;
  path.sample = camera.sample;
  path.slot = IntN(first_slot) + lane_numbers<IntN>();
  path.way = IntN(any_way);
  const MediumStack camera_media = scene_.camera_media(path.rays.origin, active, {path.pixel, path.sample, 0});
  const MediumStack::Packed media = camera_media.packed();
  path.first_media = media.first;
  path.last_media = media.last;
  path.deviation = FloatN(0);
  path.fog_scatterings = path.first = IntN(0);
  path.gloss_share = black();
  const MediumTable& table = scene_.tables().media();
  MaskN met = hits.hit;
  if (table.has_fog()) [[unlikely]] {
    MediumStack stack = camera_media;
    MaskN fogged(false);
    const Hits next = go_through_fog(path, stack, wanted, {0, 0, MaskN(false), &hits, &fogged}, camera_walks_);
    met = met | fogged;
    path.set_hits(next);
    append(paths_, path, next, next.hit);
  } else if (table.scatters() && any(active & table.scatters(camera_media.current(table)))) [[unlikely]] {
    // Where the camera does not see what is near, the media are not the same for all lanes.
    const IntN current = camera_media.current(table);
    const MaskN lanes = hits.hit & wanted, walks = lanes & table.scatters(current);
    const Hits walked = any(walks) ? select(walks, walk(path, current, walks, 0, 0, camera_walks_), hits) : hits;
    path.set_hits(walked);
    append(paths_, path, walked, lanes & walked.hit);
  } else {
    append(paths_, path, hits, hits.hit & wanted);
  }
  clock_.end(Stage::surface);
  return met;
}

void PathBatch::append(Chunk& chunk, const PathPacket& path, const Hits& hits, const MaskN& lanes) const {
  if (none(lanes)) return;  // where nothing was hit, there may be no object to have a material
  const IntN bucket = bucket_of(hits, scene_.tables().material(hits));
  chunk.append(path, lanes,
               select_lanes(float_mask<FloatN>(path.way == IntN(from_below)), bucket ^ IntN(0x88), bucket));
}

void PathBatch::trace(RayCounts& counts) {
  counts += std::exchange(camera_walks_, {});
  for (int depth = 0; paths_.size() > 0; ++depth) {
    paths_.sort(order_);
    next_.clear();
    for (std::size_t first = 0; first < order_.size(); first += packet_lanes) {
      clock_.begin_packet();
      auto [path, lanes] = paths_.load(order_, first);
      extend(path, lanes, depth, counts);
    }
    std::swap(paths_, next_);
  }
}

void PathBatch::add(std::vector<Sums>& sums, std::size_t groups, const IntN& slot, const MaskN& lanes,
                    const Rgb<FloatN>& radiance, const IntN& group) {
  if (none(lanes)) return;
  alignas(64) std::array<std::int32_t, packet_lanes> slots, numbers;
  slot.store_aligned(slots.data());
  group.store_aligned(numbers.data());
  alignas(64) Sums terms;
  radiance.red.store_aligned(terms[0].data());
  radiance.green.store_aligned(terms[1].data());
  radiance.blue.store_aligned(terms[2].data());
  for (const std::size_t lane : SetLanes(lanes)) {
    const auto to = static_cast<std::size_t>(slots[lane]);
    Sums& sum = sums[to / packet_lanes * groups + static_cast<std::size_t>(numbers[lane])];
    for (std::size_t channel = 0; channel < 3; ++channel) sum[channel][to % packet_lanes] += terms[channel][lane];
  }
}

void PathBatch::add_scattered(const PathPacket& path, const MaskN& lanes, const Rgb<FloatN>& radiance,
                              const IntN& group, int scatterings) {
  if (!scene_.tables().media().has_fog()) [[likely]]
    return add(scatterings <= 1 ? direct_ : indirect_, groups_, path.slot, lanes, radiance, group);
  const MaskN once = float_mask<FloatN>(path.fog_scatterings + IntN(scatterings) <= IntN(1));
  add(direct_, groups_, path.slot, lanes & once, radiance, group);
  add(indirect_, groups_, path.slot, lanes & !once, radiance, group);
}

Rgb<FloatN> PathBatch::sum(const std::vector<Sums>& sums, std::size_t groups, std::size_t packet,
                           std::size_t group) const {
  const auto load = [&](std::size_t strand) {
    const Sums& some = sums[(packet * strands_ + strand) * groups + group];
    return Rgb<FloatN>(FloatN::load_unaligned(some[0].data()), FloatN::load_unaligned(some[1].data()),
                       FloatN::load_unaligned(some[2].data()));
  };
  if (strands_ == 1) return load(0);
  Rgb<FloatN> all = load(1);
  for (std::size_t strand = 2; strand < strands_; ++strand) all += load(strand);
  return load(0) + all * FloatN(1 / static_cast<float>(branches_));
}

Rgb<FloatN> PathBatch::left_of_indirect(std::size_t packet) const {
  const FloatN most(static_cast<float>(settings_.clampindirect));
  Rgb<FloatN> all = sum(indirect_, groups_, packet, 0);
  for (std::size_t i = 1; i < groups_; ++i) all += sum(indirect_, groups_, packet, i);
  const auto left = [&](const FloatN& whole) { return select(whole > most, most / whole, FloatN(1)); };
  return {left(all.red), left(all.green), left(all.blue)};
}

Rgb<FloatN> PathBatch::radiance(std::size_t packet, std::size_t group) const {
  Rgb<FloatN> indirect = sum(indirect_, groups_, packet, group);
  if (settings_.clampindirect > 0) {
    const FloatN most(static_cast<float>(settings_.clampindirect));
    if (groups_ == 1)
      indirect = {min(indirect.red, most), min(indirect.green, most), min(indirect.blue, most)};
    else  // groups lose the same share of a sum that is too large
      indirect = indirect * left_of_indirect(packet);
  }
  return sum(direct_, groups_, packet, group) + indirect;
}

void PathBatch::add_escaped(const PathPacket& path, const MaskN& lanes, int depth) {
  const SceneTables& tables = scene_.tables();
  const Environment* const environment = tables.environment();
  IntN scatterings(depth);
  if (tables.media().has_fog()) [[unlikely]]
    scatterings = scatterings + path.fog_scatterings;
  MaskN in_sky(false);
  if (environment != nullptr) {
    in_sky = environment->visible() ? lanes : lanes & float_mask<FloatN>(scatterings > IntN(0));
    if (any(in_sky)) {
      const EnvironmentSample sky = environment->at(path.rays.direction);
      const FloatN other = sky.pdf * FloatN(environment_share_of(tables));
      const MaskN left_out = float_mask<FloatN>(path.way == IntN(by_focus));
      const Rgb<FloatN> radiance = path.throughput * (sky.radiance * power_heuristic(path.pdf, other));
      add_scattered(path, in_sky & !left_out, radiance, IntN(tables.environment_group()), depth);
      if (has_passes_) [[unlikely]]
        add_to_passes(path, path.first, in_sky & !left_out, radiance, depth, LightPass::background);
    }
  }
  const MaskN in_background = lanes & !in_sky & float_mask<FloatN>(scatterings < IntN(settings_.maxdepth));
  const Rgb<FloatN> radiance = path.throughput * Rgb<FloatN>(Rgb<float>(tables.viewplane().background));
  add_scattered(path, in_background, radiance, IntN(0), depth);
  if (has_passes_) [[unlikely]]
    add_to_passes(path, path.first, in_background, radiance, depth, LightPass::background);
}

IntN PathBatch::group_of(const DrawnLight& light) const {
  const SceneTables& tables = scene_.tables();
  const IntN sky(tables.environment_group());
  if (tables.emitters().empty()) return sky;
  return select_lanes(light.is_sky, sky, tables.light_group_of_material(light.sample.material));
}

void PathBatch::extend(PathPacket& path, const MaskN& arrived, int depth, RayCounts& counts) {
  const SceneTables& tables = scene_.tables();
  Ray<FloatN>& rays = path.rays;
  Hits hits = path.hits(arrived);
  if (tables.has_motion()) [[unlikely]]
    hits.time = RayIds{path.pixel, path.sample, 0}.times();
  SurfaceInteraction<FloatN> surface = scene_.accelerator().surface(rays, hits);
  const bool has_media = !tables.media().empty();
  MediumStack media;
  MediumBoundary boundary;
  MaskN lanes = arrived;
  if (!has_media) {
    path.distance = path.distance + rays.far;
  } else {
    media = MediumStack({path.first_media, path.last_media});
    boundary = find_boundary(path, media, hits, surface, depth, counts);
    lanes = hits.hit;
    if (none(lanes)) return;
    if (depth == 0 && tables.has_invisible_media()) [[unlikely]]
      add_invisible_media(path, surface, lanes, media, boundary);
  }
  if (tables.has_subsurface()) {
    surface.emerges = lanes & float_mask<FloatN>(path.way == IntN(from_below));
    surface.has_emerging = any(surface.emerges);
    path.way = select_lanes(float_mask<FloatN>(path.way == IntN(from_below)), IntN(any_way), path.way);
  }
  clock_.end(Stage::surface);
  const auto textures =
      add_textures(tables, hits, surface, [&] { return tables.ray_cone().half_width(path.distance); });
  const TexturePoint<FloatN>* const point = textures ? &*textures : nullptr;
  if (follows_mirrors_) [[unlikely]]
    follow(path, hits, surface, point, lanes);
  clock_.end(Stage::texture);
  const float environment_share = environment_share_of(tables);
  // Light paths bring what comes by what focuses light to the first point, photons what comes to any other.
  const CausticTable* const caustics = tables.caustics();
  MaskN focused(false), focuses(false);
  if (caustics != nullptr) {
    focused = lanes & float_mask<FloatN>(path.way == IntN(by_focus));
    focuses = float_mask<FloatN>(caustics->target_of(tables.geometry(), hits, tables.material(hits)) >= IntN(0));
  }
  if (tables.has_emission()) {
    Rgb<FloatN> emitted = tables.emitted(hits, surface, point);
    if (any(focused)) emitted = select(tables.emitters().has_patch(hits, focused, surface.p), black(), emitted);
    if (surface.has_emerging) emitted = select(surface.emerges, black(), emitted);
    if (const MaskN shines = lanes & (largest(emitted) > FloatN(0)); any(shines)) {
      const MaskN drawn = shines & (path.pdf < infinity<FloatN>());
      if (!tables.emitters().empty() && any(drawn)) {
        const FloatN other =
            tables.emitters().pdf(path.from, path.from_normal, hits, drawn, surface) * FloatN(1 - environment_share);
        emitted = select(drawn, emitted * power_heuristic(path.pdf, other), emitted);
      }
      add_scattered(path, shines, path.throughput * emitted, tables.light_group_of_material(tables.material(hits)),
                    depth);
      if (has_passes_) [[unlikely]]
        add_to_passes(path, path.first, shines, path.throughput * emitted, depth);
    }
  }
  clock_.end(Stage::lights);
  if (depth == settings_.maxdepth) return;
  if (tables.media().has_fog()) [[unlikely]] {
    lanes = lanes & float_mask<FloatN>(path.fog_scatterings < IntN(settings_.maxdepth - depth));
    if (none(lanes)) return;
  }
  if (tables.media().disperses()) [[unlikely]]
    path.throughput = path.throughput * disperse(tables.media(), boundary, lanes, path.pixel, path.sample,
                                                 wavelength_dimension, path.deviation);

  // The numbers of keys: one for each ray of a point, the next point's own first.
  const auto lights = static_cast<std::uint32_t>(tables.lights().size());
  const std::uint32_t first_key = static_cast<std::uint32_t>(depth) * (lights + 2);
  const auto ids = [&](std::uint32_t ray) { return RayIds{path.pixel, path.sample, first_key + ray}; };
  const auto draw = [&](PathDraw what) { return get_2d(path.pixel, path.sample, path_dimension(depth, what)); };
  const Coherence coherence = depth == 0 ? Coherence::coherent : Coherence::incoherent;
  const MaskN is_first = seen_by(path, depth);
  const MaskN on_way =
      focuses & (float_mask<FloatN>(path.way == IntN(by_reflection)) | float_mask<FloatN>(path.way == IntN(by_focus)));
  const MaskN on_gloss_way =
      focuses & (float_mask<FloatN>(path.way == IntN(by_gloss)) | float_mask<FloatN>(path.way == IntN(by_gloss_focus)));
  const PointMedia point_media{media, boundary.current};
  // Each pane is one more scattering.
  const int most_panes = settings_.maxdepth - depth - 1;
  PanesAhead ahead{IntN(most_panes), Refraction<FloatN>(boundary.media.outside), path.distance};
  if (tables.media().has_fog()) [[unlikely]]
    ahead.most = ahead.most - path.fog_scatterings;
  const PanesAhead* const panes = tables.has_panes_for_surfaces() && most_panes > 0 ? &ahead : nullptr;
  // Light is drawn from behind for what sends it on.
  const MaskN both_sides = tables.has_scattering_through() ? tables.scatters_through(hits, surface) : MaskN(false);
  const MaskN fibres = tables.is_fibre(hits);
  const LightsBehind behind{both_sides, fibres, boundary, path.distance};
  Rgb<FloatN> light = black(), light_of_groups = black();
  LightParts parts;
  for (std::size_t group = 0; group < groups_; ++group) {
    const SceneTables::LightGroup& lights_of_group = tables.light_groups()[group];
    if (lights_of_group.is_dark()) continue;
    const bool draws = depth > 0 || lights_of_group.last_light - lights_of_group.first_drawn > ManyLights::most_asked;
    light = direct_light(
        scene_, lights_of_group, hits, surface, point, coherence, lanes, counts,
        ShadowNumbers{path.pixel, path.sample, first_key + 1}, &clock_, has_media ? &point_media : nullptr, panes,
        draws, tables.has_scattering_through() ? &behind : nullptr, has_passes_ && depth == 0 ? &parts : nullptr);
    if (any(on_way | on_gloss_way)) light = select(on_way | on_gloss_way, black(), light);
    if (groups_ == 1) break;  // which is added with the light that is drawn
    light_of_groups += light;
    add_scattered(path, lanes, path.throughput * light, IntN(static_cast<std::int32_t>(group)), depth + 1);
    light = black();
  }
  const PathVertex vertex{hits,          surface,    point, tables.shading_frame(hits, surface, point),
                          path.distance, both_sides, fibres};
  const Vec3<FloatN> wo = vertex.frame.to_local(surface.wo);
  const bool draws_light = tables.environment() != nullptr || !tables.emitters().empty();
  DrawnLight drawn =
      draws_light ? draw_light(tables, vertex, has_one_light_ ? Sample2D{FloatN(0), FloatN(0)} : draw(PathDraw::light),
                               draw(PathDraw::light_point))
                  : DrawnLight{};
  drawn.lit = drawn.lit & !(on_way & (dot(drawn.wi, surface.ng) > FloatN(0)));
  clock_.end(Stage::lights);
  // The last direction is for what shines alone.
  const bool is_last = depth + 1 == settings_.maxdepth;
  const bool goes_on = !is_last || tables.has_emission() || tables.environment() != nullptr;
  const Sample2D direction = draw(PathDraw::direction), choices = draw(PathDraw::lobe_and_roulette);
  const Scattering scattering = tables.scatter(hits, surface, vertex.frame, boundary.media, wo, drawn.lit,
                                               drawn.local_wi, choices.x, direction.x, direction.y, point);
  clock_.end(Stage::shade);
  if (any(drawn.lit)) {
    // Rays to one light are neighbours as the camera's are, those to many are not.
    const Coherence to_lights = has_one_light_ ? coherence : Coherence::incoherent;
    const MediaOfLight there(scene_, boundary, media, drawn.through & drawn.lit, surface.front, drawn.ray,
                             path.distance, ids(lights + 1));
    const PointMedia media_of_light = there.media();
    const Rgb<FloatN> arrived = arriving_light(scene_, vertex, drawn, scattering.towards, to_lights, ids(lights + 1),
                                               counts, clock_, has_media ? &media_of_light : nullptr, panes);
    light += arrived;
    if (has_passes_ && depth == 0) [[unlikely]]
      add_drawn_light(tables, vertex, boundary.media, drawn, scattering.towards, arrived, parts);
  }
  add_scattered(path, lanes, path.throughput * light, groups_ > 1 ? group_of(drawn) : IntN(0), depth + 1);
  if (has_passes_) [[unlikely]]
    add_to_passes(path, lanes, light_of_groups + light, parts, depth);
  if (photons_ != nullptr)
    if (const MaskN shown = lanes & !(focuses | is_first | fibres); any(shown))
      add_photons(path, hits, surface, point, shown, depth);
  clock_.end(Stage::lights);
  if (!goes_on) return;

  const PathDeparture from{vertex, boundary, media,    depth,  first_key + lights + 2,
                           lanes,  focuses,  is_first, on_way, on_gloss_way};
  if (depth > 0 || settings_.indirectsamples == 1) return scatter(path, from, scattering.sample, choices.y, counts);
  clock_.end(Stage::shade);
  for (int branch = 0; branch < settings_.indirectsamples; ++branch) scatter_branch(path, from, branch, counts);
}

}  // namespace raytrace
