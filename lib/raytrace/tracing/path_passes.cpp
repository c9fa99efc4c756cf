// Paths' light by passes: by what scattered it first on the way from the camera.
#include "raytrace/tracing/path_batch.h"

namespace raytrace {

namespace {

constexpr std::size_t from_below_slot = light_pass_count;

IntN number_of(LightPass pass) { return IntN(static_cast<std::int32_t>(pass)); }

}  // namespace

void PathBatch::set_first(PathPacket& path, const MaskN& lanes, const IntN& scattering) const {
  const MaskN is_first = lanes & float_mask<FloatN>(path.first == IntN(unscattered));
  path.first = select_lanes(is_first, scattering, path.first);
}

void PathBatch::add_from_fog(const PathPacket& path, const MaskN& lanes, const Rgb<FloatN>& radiance, const IntN& group,
                             int depth) {
  add_scattered(path, lanes, radiance, group, depth + 1);
  if (!has_passes_) [[likely]]
    return;
  const MaskN here = float_mask<FloatN>(path.first == IntN(unscattered));
  add_to_passes(path, select_lanes(here, IntN(in_volume), path.first), lanes, radiance, depth + 1);
}

void PathBatch::add_to_passes(const PathPacket& path, const IntN& first, const MaskN& lanes,
                              const Rgb<FloatN>& radiance, int scatterings, LightPass otherwise) {
  if (none(lanes)) return;
  const auto is = [&](FirstScattering what) { return float_mask<FloatN>(first == IntN(what)); };
  IntN all(scatterings);
  if (scene_.tables().media().has_fog()) [[unlikely]]
    all = all + path.fog_scatterings;
  // The two of light that goes in below a surface and out again are one.
  const MaskN below = is(below_surface);
  const MaskN direct = float_mask<FloatN>(all <= select_lanes(below, IntN(2), IntN(1)));
  const auto one_of = [&](LightPass if_direct, LightPass if_indirect) {
    return select_lanes(direct, number_of(if_direct), number_of(if_indirect));
  };
  const auto add_here = [&](const MaskN& here, const Rgb<FloatN>& light, const IntN& pass) {
    add(pass_sums_, pass_slots, path.slot, lanes & here, light, pass);
  };
  add_here(is(unscattered), radiance, number_of(otherwise));
  add_here(is(transmitted), radiance, one_of(LightPass::transmission_direct, LightPass::transmission_indirect));
  add_here(is(in_volume), radiance, one_of(LightPass::volume_direct, LightPass::volume_indirect));
  add_here(
      below, radiance,
      select_lanes(direct, IntN(static_cast<std::int32_t>(from_below_slot)), number_of(LightPass::diffuse_indirect)));
  const MaskN at_surface = is(reflected);
  if (none(lanes & at_surface)) return;
  const Rgb<FloatN> gloss = radiance * path.gloss_share;
  add_here(at_surface, gloss, one_of(LightPass::specular_direct, LightPass::specular_indirect));
  add_here(at_surface, radiance - gloss, one_of(LightPass::diffuse_direct, LightPass::diffuse_indirect));
}

void PathBatch::add_to_passes(const PathPacket& path, const MaskN& lanes, const Rgb<FloatN>& light, LightParts& parts,
                              int depth) {
  const MaskN is_first = lanes & float_mask<FloatN>(path.first == IntN(unscattered));
  add_to_passes(path, path.first, lanes & !is_first, path.throughput * light, depth + 1);
  const auto add_here = [&](const Rgb<FloatN>& part, LightPass pass) {
    add(pass_sums_, pass_slots, path.slot, is_first, path.throughput * part, number_of(pass));
  };
  if (none(is_first)) return;
  add_here(parts.take_diffuse(light), LightPass::diffuse_direct);
  add_here(parts.gloss, LightPass::specular_direct);
  add_here(parts.transmitted, LightPass::transmission_direct);
}

PassLight PathBatch::passes(std::size_t packet) const {
  const auto sum_of = [&](std::size_t slot) { return sum(pass_sums_, pass_slots, packet, slot); };
  PassLight light;
  for (std::size_t i = 0; i < light.size(); ++i) light[i] = sum_of(i);
  Rgb<FloatN> from_below = sum_of(from_below_slot);
  if (settings_.clampindirect > 0) {
    const Rgb<FloatN> left = left_of_indirect(packet);
    from_below = from_below * left;
    for (const LightPass pass : {LightPass::diffuse_indirect, LightPass::specular_indirect,
                                 LightPass::transmission_indirect, LightPass::volume_indirect})
      light[static_cast<std::size_t>(pass)] = light[static_cast<std::size_t>(pass)] * left;
  }
  light[static_cast<std::size_t>(LightPass::diffuse_direct)] += from_below;
  return light;
}

}  // namespace raytrace
