#include "raytrace/accel/traced_scene.h"

#include <algorithm>
#include <variant>

#include "raytrace/accel/surface_uv.h"

namespace raytrace {

TracedScene::TracedScene(const SceneDescription& description, int threads, const char* isa_name, const char* embree_isa)
    : tables_(description, threads, texture_point),
      accelerator_(tables_.geometry(), threads, embree_isa, tables_.fogs()),
      isa_name_(isa_name) {
  make_buffers(threads);
  // Embree's BVH of few objects takes no time. That of many waits for a ray that wants it: there may be none.
  constexpr std::uint64_t few_primitives = 1U << 14U;
  const bool rays_scatter = std::holds_alternative<Path::Parameters>(tables_.integrator()) ||
                            std::holds_alternative<AmbientOcclusion::Parameters>(tables_.integrator());
  if (rays_scatter || tables_.geometry().primitive_count() <= few_primitives) accelerator_.embree_scene();
  if (std::holds_alternative<Path::Parameters>(tables_.integrator()) && !tables_.media().empty()) find_media();
}

void TracedScene::find_media() {
  const MaskN one = first_lanes<FloatN>(1);
  if (!tables_.camera_is_far())
    camera_media_ = media_around(tables_, accelerator_, Vec3<FloatN>(tables_.camera_eye()), MaskN(true), nullptr, true);
  if (tables_.caustics() == nullptr) return;
  const auto is_in_media = [&](const Vec3<FloatN>& points, const MaskN& lanes) {
    return any(lanes & media_around(tables_, accelerator_, points, lanes).is_in_any());
  };
  for (const auto& origin : tables_.light_origins())
    if (origin && !origin->infinitely_far) lights_in_media_ |= is_in_media(Vec3<FloatN>(origin->position), one);
  // Where something moves, a light may come to be in one. Else by a point of each patch.
  lights_in_media_ |= has_moving_instances();
  const auto patches = static_cast<std::int32_t>(tables_.emitters().size());
  for (std::int32_t first = 0; first < patches && !lights_in_media_; first += packet_lanes) {
    const IntN patch = IntN(first) + lane_numbers<IntN>();
    const MaskN lanes = float_mask<FloatN>(patch < IntN(patches));
    const EmitterTable::Sample sample =
        tables_.emitters().sample(select_lanes(lanes, patch, IntN(first)), Vec3<FloatN>(tables_.camera_eye()),
                                  FloatN(0), FloatN(0.5F), FloatN(0.5F));
    lights_in_media_ = is_in_media(sample.point.p, lanes);
  }
}

void TracedScene::make_buffers(int threads) {
  // For an object it takes about as long as is saved for the rays of half a pixel, with some samples. It takes memory,
  // too: some 100 bytes. Both by what all pieces of a picture have in common.
  constexpr std::uint64_t objects_a_pixel = 2, most_objects = 1U << 21U;
  const ViewPlane& viewplane = tables_.viewplane();
  const auto pixels = static_cast<std::uint64_t>(viewplane.hres) * static_cast<std::uint64_t>(viewplane.vres);
  const std::uint64_t affordable = std::min(objects_a_pixel * pixels, most_objects);
  std::vector<std::optional<BufferOrigin>> origins{tables_.camera_origin()};
  origins.insert(origins.end(), tables_.light_origins().begin(), tables_.light_origins().end());
  std::uint64_t objects = 0;
  for (auto& origin : origins) {
    if (tables_.has_cutouts()) origin.reset();  // they know nothing of rays that pass
    if (!origin) continue;
    objects += tables_.geometry().primitive_count();
    if (objects > affordable) origin.reset();
  }
  light_buffers_ = accelerator_.direction_buffers(origins, threads);
  camera_buffer_ = std::move(light_buffers_.front());
  light_buffers_.erase(light_buffers_.begin());
}

SceneStatistics TracedScene::statistics() const {
  SceneStatistics statistics;
  statistics.primitives = tables_.geometry().primitive_count();
  statistics.bvh_bytes = accelerator_.bvh_bytes();
  statistics.isa = isa_name_;
  statistics.lanes = packet_lanes;
  statistics.embree_version = accelerator_.embree_version();
  return statistics;
}

}  // namespace raytrace
