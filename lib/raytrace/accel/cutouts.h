// Surfaces that some rays pass, as the opacity of their materials says.
//
// Whether a ray meets the surface that it hits is decided by a number of the ray and of the surface, not by its order
// among others: so the answer does not depend on how Embree comes to it, and needs no state. Over the samples of a
// pixel the numbers of one surface are stratified, so that half of the rays pass where the opacity is one half; those
// of two surfaces have nothing to do with each other.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"
#include "raytrace/sampling/hash.h"
#include "raytrace/sampling/ray_ids.h"
#include "raytrace/scene/camera.h"
#include "raytrace/scene/hits.h"

namespace raytrace {

class Accelerator;
class SceneTables;

/// What rays meet. Fogs have boundaries, but no surfaces. Panes: SceneTables::is_pane().
enum class Meets { surfaces, boundaries_of_fogs, surfaces_but_panes, panes };

/// What a query knows of its rays besides, in scenes in which rays pass surfaces or things move. Queries without it
/// meet all there is, surfaces and boundaries.
struct RayIdentity {
  const SceneTables& scene;
  const Accelerator& accelerator;
  const Ray<FloatN>& rays;  ///< in world space; ray `id` is lane `id`
  UintN pixels;             ///< RayIds::pixel_keys()
  UintN samples;            ///< RayIds::sample
  FloatN times;
  const CameraRays* camera;  ///< what camera rays cover, textures are filtered by; null: other rays
  Meets meets = Meets::surfaces;
  std::uint32_t* passed_panes = nullptr;  ///< bit i is set where ray i passes a pane, by surfaces_but_panes
  std::uint32_t seeing = 0;  ///< bit i is set where ray i is what the camera sees by: objects invisible to it are not
                             ///< there for the ray; 0 in scenes without any
  std::span<const Hits> crossed{};  ///< what the rays do not meet, each lane's own; of a mesh all faces

  RayIdentity(const SceneTables& of_scene, const Accelerator& its_accelerator, const Ray<FloatN>& its_rays,
              const RayIds& ids, const CameraRays* its_camera = nullptr);
  /// The camera sees by these.
  void set_seeing(const MaskN& lanes);
};

/// A primitive that rays hit, and which crossing of its surface that is, counted along the rays.
struct CutoutSurface {
  std::uint32_t instance, geometry, primitive, crossing;
};

/// The number of the surface's material, if rays may pass it.
std::optional<std::int32_t> cutout_material(const RayIdentity& query, const CutoutSurface& surface);

/// Which of the rays pass the surface, of that material, that they hit at distance t[i], where the bits of `hit` say
/// so; bit i is that of ray first + i. u, v: barycentric coordinates, on triangles.
std::uint32_t passing_rays(const RayIdentity& query, unsigned first, std::uint32_t hit, const CutoutSurface& surface,
                           std::int32_t material, std::span<const float> t, std::span<const float> u,
                           std::span<const float> v);

/// Which of the rays, as bits, do not meet the primitive at all, since its object is not visible to the camera.
std::uint32_t unseen_by(const RayIdentity& query, unsigned first, const CutoutSurface& surface);

/// The same of what the rays have crossed.
std::uint32_t crossed_by(const RayIdentity& query, unsigned first, const CutoutSurface& surface);

/// The lanes whose bits are set.
template <class F>
Mask<F> mask_of(std::uint32_t bits) {
  alignas(64) std::int32_t lanes[lane_count<F>];
  for (int i = 0; i < lane_count<F>; ++i) lanes[i] = (bits >> i & 1) != 0 ? -1 : 0;
  return float_mask<F>(Ints<F>::load_aligned(lanes) != Ints<F>(0));
}

/// The distances t at which rays hit a primitive, or those of their next hits, where they pass what they hit there.
/// The rays are `count` from `first` on. find(rays, lanes, u, v): their hits behind rays.near.
template <class F, class Find>
F without_passed(const RayIdentity& query, unsigned first, int count, CutoutSurface surface, Ray<F> rays, F t, F& u,
                 F& v, const Find& find) {
  if (query.seeing != 0) [[unlikely]]
    if (const std::uint32_t unseen = unseen_by(query, first, surface); unseen != 0)
      t = select(mask_of<F>(unseen), infinity<F>(), t);
  if (!query.crossed.empty()) [[unlikely]]
    if (const std::uint32_t crossed = crossed_by(query, first, surface); crossed != 0)
      t = select(mask_of<F>(crossed), infinity<F>(), t);
  const std::optional<std::int32_t> material = cutout_material(query, surface);
  if (!material) return t;
  // No shape is crossed more often; what rounding finds beyond that is passed.
  constexpr std::uint32_t most_crossings = 8;
  const std::uint32_t present = count >= 32 ? ~0U : (1U << static_cast<unsigned>(count)) - 1;
  std::uint32_t open = bits_of<F>(t < infinity<F>()) & present;
  for (; open != 0; ++surface.crossing) {
    alignas(64) float at[3][lane_count<F>];
    t.store_aligned(at[0]);
    u.store_aligned(at[1]);
    v.store_aligned(at[2]);
    open = surface.crossing < most_crossings ? passing_rays(query, first, open, surface, *material, at[0], at[1], at[2])
                                             : open;
    if (open == 0) break;
    const Mask<F> passed = mask_of<F>(open);
    if (surface.crossing >= most_crossings) return select(passed, infinity<F>(), t);
    rays.near = select(passed, same_bits<F>(same_bits<Uints<F>>(t) + Uints<F>(1u)), rays.near);
    F next_u = u, next_v = v;
    const F next = find(rays, passed, next_u, next_v);
    t = select(passed, next, t);
    u = select(passed, next_u, u);
    v = select(passed, next_v, v);
    open &= bits_of<F>(t < infinity<F>());
  }
  return t;
}

}  // namespace raytrace
