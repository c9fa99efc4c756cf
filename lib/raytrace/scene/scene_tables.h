// A scene as data: what a description says, in the form that integrators read.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "raytrace/cameras/kernels.h"
#include "raytrace/description/scene_description.h"
#include "raytrace/lights/kernels.h"
#include "raytrace/materials/kernels.h"
#include "raytrace/math/lanes.h"
#include "raytrace/sampling/pixel_filter.h"
#include "raytrace/sampling/sampler.h"
#include "raytrace/scene/camera.h"
#include "raytrace/scene/caustic_table.h"
#include "raytrace/scene/density_table.h"
#include "raytrace/scene/emitter_table.h"
#include "raytrace/scene/environment.h"
#include "raytrace/scene/geometry_table.h"
#include "raytrace/scene/light_source.h"
#include "raytrace/scene/many_lights.h"
#include "raytrace/scene/material_table.h"
#include "raytrace/scene/medium_table.h"
#include "raytrace/scene/part_table.h"
#include "raytrace/scene/surface_interaction.h"

namespace raytrace {

/// Where many rays start or go to: a direction buffer may be made around it.
struct BufferOrigin {
  Vec3f position;               ///< a point, or
  bool infinitely_far = false;  ///< the unit direction towards one that is infinitely far
};

/// What a pixel covers across its ray.
struct RayCone {
  float width = 0;   ///< where the ray starts
  float spread = 0;  ///< what is added for each unit of its length

  FloatN half_width(const FloatN& distance) const {
    return multiply_add(FloatN(spread), distance, FloatN(width)) * FloatN(0.5F);
  }
};

class SceneTables;
/// accel/surface_uv.h has it.
using TexturePointOf = TexturePoint<FloatN>(const SceneTables& scene, const FloatN& radius, const Hits& hits,
                                            const SurfaceInteraction<FloatN>& surface);

/// Immutable.
class SceneTables {
 public:
  /// threads: so many at most share the work; point_of: what textured surfaces that shine are looked up with. Throws
  /// std::bad_alloc.
  SceneTables(const SceneDescription& description, int threads, const TexturePointOf& point_of);

  /// The world's point that is (0, 0, 0) in all that is traced, so that floats are precise where the camera looks: the
  /// world's own origin if the eye or what it looks at lies within 4096 of it, and within 128 times the distance of the
  /// two; else the eye or, where the camera is far from all objects, their center. Rounded to whole units, or finer
  /// where what is there is smaller.
  const Vec3d& origin() const { return origin_; }

  const ViewPlane& viewplane() const { return viewplane_; }
  /// If the description names none: Path where a material or light needs it, else Raycast.
  const IntegratorParameters& integrator() const { return integrator_; }
  /// Sets rays through points of the picture, as cameras/kernels.h has them. lens: where on the camera's lens, if
  /// camera_has_lens(). The result: the lanes that have a ray; the picture is black in the others.
  MaskN set_camera_rays(const FloatN& x, const FloatN& y, const Sample2D& lens, CameraRays& result) const;
  bool camera_has_lens() const { return camera_has_lens_; }
  /// Where the picture shows p, by way of the lens' point for that lane: FilmPoint. None: nowhere, as what is too near.
  std::optional<FilmPoint> project(const Vec3d& p, const Sample2D& lens, std::size_t lane) const;
  /// The camera, if it is of the first type, whose rays always exist, and is not far away, stands still and sees all
  /// that is near, as most do; else null.
  const auto* usual_camera() const {
    return camera_is_far() || !moving_camera_.empty() || has_near_clip() ? nullptr : std::get_if<0>(&*camera_);
  }
  /// Whether the camera sees nothing that is nearer than some distance along its viewing direction.
  bool has_near_clip() const {
    return near_clip_ > 0 || std::ranges::any_of(moving_near_clips_, [](float near) { return near > 0; });
  }
  /// Whether the camera is so far away from all objects with bounds that its rays start at them.
  bool camera_is_far() const { return camera_target_.has_value(); }
  const Vec3f& camera_eye() const { return camera_eye_; }
  /// Unit length.
  const Vec3f& viewing_direction() const { return viewing_direction_; }
  /// Whether depths are distances from the eye: there is no view plane to measure them from.
  bool depth_is_distance() const { return depth_is_distance_; }
  /// Where samples lie about their pixels.
  const FilterTable& pixel_filter() const { return pixel_filter_; }
  /// The point that all camera rays start at; none if there is none.
  const std::optional<BufferOrigin>& camera_origin() const { return camera_origin_; }

  /// What of the lights is in the same light group (description/light_groups.h, which has their order).
  struct LightGroup {
    std::string name;
    std::size_t first_light = 0, last_light = 0;  ///< [first, last) of lights()
    std::size_t first_drawn = 0;                  ///< of them; where `drawn` is none, the same as last_light
    std::optional<ManyLights> drawn{};            ///< those from first_drawn on, for paths
    Rgb<float> ambient_radiance{0, 0, 0};         ///< the sum of all ambient lights

    bool is_dark() const {
      return first_light == last_light && ambient_radiance.red == 0 && ambient_radiance.green == 0 &&
             ambient_radiance.blue == 0;
    }
  };
  /// At least one: the first is the default.
  const std::vector<LightGroup>& light_groups() const { return light_groups_; }
  /// The group that a light of lights() is in, the environment, or, each lane's, a material that shines.
  std::int32_t light_group(std::size_t light) const { return groups_of_lights_[light]; }
  std::int32_t environment_group() const { return environment_group_; }
  IntN light_group_of_material(const IntN& material) const { return gather(groups_of_materials_.data(), material); }

  /// All lights but ambient ones, group by group.
  const std::vector<std::unique_ptr<LightSource>>& lights() const { return lights_; }
  /// Whether any of them takes_samples().
  bool has_sampled_lights() const { return has_sampled_lights_; }
  /// For each of them, where its shadow rays go to; none if it has none, or they go to many places.
  const std::vector<std::optional<BufferOrigin>>& light_origins() const { return light_origins_; }

  /// The light of infinitely far from all around; null if there is none.
  const Environment* environment() const { return environment_ ? &*environment_ : nullptr; }

  /// Where light paths start, and what they aim at; null if there are none.
  const CausticTable* caustics() const { return caustics_ ? &*caustics_ : nullptr; }
  /// Whether light paths leave photons; then they start somewhere.
  bool has_photons() const { return has_photons_; }

  const GeometryTable& geometry() const { return *geometry_; }

  /// Of direct light, and of the background alone, be it that or the environment.
  RadianceRange radiance_range() const;
  RadianceRange background_range() const;
  /// Scene::largest_albedo()
  float largest_albedo() const;

  // Of what was hit; at least one lane must have a hit, and lanes without one get anything.

  /// Each object's number, counted from 0: type by type as in the Shapes registry, each type's in their order.
  IntN object(const Hits& hits) const { return geometry_->object(hits); }
  /// The same, but of a mesh with parts that of the part, as PartTable has it.
  IntN part_or_object(const Hits& hits) const { return parts_.part_or_object(hits, object(hits)); }
  /// Each material's number, likewise.
  IntN material(const Hits& hits) const { return geometry_->material(hits); }
  /// point: as texture_point() gave it.
  Rgb<FloatN> albedo(const Hits& hits, const TexturePoint<FloatN>* point) const;

  /// The radiance that leaves the surface along wo, each lane's by its own material: one call for each material type
  /// among the lanes. media: around it, for what comes from behind.
  Rgb<FloatN> shade(const Hits& hits, const SurfaceInteraction<FloatN>& surface, const Rgb<float>& ambient_radiance,
                    std::span<const IncidentLight> lights, const TexturePoint<FloatN>* point,
                    const Refraction<FloatN>& media = {}) const;

  /// Whether something inside of which there is a medium is not visible to the camera.
  bool has_invisible_media() const { return has_invisible_media_; }
  /// Whether some rays pass a surface of the scene, since its material has an opacity or is a pane, or since its object
  /// is not visible to the camera.
  bool has_cutouts() const { return has_cutouts_; }
  /// Whether the camera or instances move while the shutter is open.
  bool has_motion() const { return !moving_camera_.empty() || !geometry_->instances().moving().empty(); }
  /// Whether queries must know which rays theirs are (accel/cutouts.h).
  bool identifies_rays() const { return has_cutouts_ || has_motion(); }
  /// Whether that may be of a material.
  bool is_cutout(std::int32_t material) const { return details_[static_cast<std::size_t>(material)].is_cutout(); }
  /// Whether shadow rays pass panes: what is thin and clear, and bends no light. Those of surfaces do not where light
  /// paths bring what comes through panes; light paths bring nothing to fog.
  bool has_panes() const { return has_panes_; }
  bool has_panes_for_surfaces() const { return has_panes_ && !caustics_; }
  bool is_pane(std::int32_t material) const { return has_panes_ && panes_[static_cast<std::size_t>(material)] != 0; }
  MaskN is_pane(const IntN& material) const;
  /// Whether some surfaces send on light that is drawn behind them, and which. None but fibres in scenes where shadow
  /// rays behind them would have to know more: of panes which light paths pass, or of light that is scattered inside.
  bool has_scattering_through() const { return !scattering_through_.empty(); }
  MaskN scatters_through(const Hits& hits, const SurfaceInteraction<FloatN>& surface) const;
  /// Which lanes hit a fibre, inside of which light goes on as the material alone says (materials/kernels.h).
  MaskN is_fibre(const Hits& hits) const;
  /// 1 for materials that are fogs, else 0; empty if no object has one.
  std::vector<std::uint8_t> fogs() const;
  /// Whether it has no surface: rays pass it, but paths know its boundary.
  bool is_fog(std::int32_t material) const {
    const auto& medium = details_[static_cast<std::size_t>(material)].medium;
    return medium && medium->is_fog();
  }
  /// A material's opacity, at least 1 where all rays meet the surface. point(): where the surface is hit.
  template <class Point>
  FloatN opacity(std::int32_t material, const Point& point) const {
    const TexturedNumber& opacity = details_[static_cast<std::size_t>(material)].opacity;
    if (!opacity.texture) return FloatN(opacity.value);
    return FloatN(opacity.value) * textures_->number_at(*opacity.texture, point());
  }
  /// By which texture coordinates it is looked up, where it is by nothing else.
  std::optional<UvSet> opacity_uvset(std::int32_t material) const {
    const auto& texture = details_[static_cast<std::size_t>(material)].opacity.texture;
    return texture && textures_->is_image(*texture) ? std::optional(textures_->uvset(*texture)) : std::nullopt;
  }

  /// The shining surfaces that paths draw light from. Those that rays may pass are not among them.
  const EmitterTable& emitters() const { return *emitters_; }
  /// The radiance that leaves samples of them; surfaces: theirs, with the sides that it leaves from. point(hits): what
  /// texture_point() gives for what rays to them hit.
  template <class Point>
  Rgb<FloatN> emitted(const EmitterTable::Sample& samples, const MaskN& lanes,
                      const SurfaceInteraction<FloatN>& surface, const Point& point) const;
  /// Whether surfaces shine by themselves, and the radiance that leaves them.
  bool has_emission() const { return has_emission_; }
  Rgb<FloatN> emitted(const Hits& hits, const SurfaceInteraction<FloatN>& surface,
                      const TexturePoint<FloatN>* point) const;

  /// As MaterialTable has it, each lane's of its own material; frame: its shading_frame(). Lanes that hit nothing get
  /// anything.
  Scattering scatter(const Hits& hits, const SurfaceInteraction<FloatN>& surface, const Frame<FloatN>& frame,
                     const Refraction<FloatN>& media, const Vec3<FloatN>& wo, const MaskN& lit, const Vec3<FloatN>& wi,
                     const FloatN& u, const FloatN& u1, const FloatN& u2, const TexturePoint<FloatN>* point) const;
  /// What of f for light from wi above the surfaces is gloss. Of paths that leave by `sharp` gloss, none but those from
  /// the camera bring what they find.
  Rgb<FloatN> gloss(const Hits& hits, const SurfaceInteraction<FloatN>& surface, const Frame<FloatN>& frame,
                    const Refraction<FloatN>& media, const Vec3<FloatN>& wo, const Vec3<FloatN>& wi, Gloss which,
                    const TexturePoint<FloatN>* point) const;
  /// The share that is left of light that went so far behind the surfaces.
  Rgb<FloatN> transmittance(const Hits& hits, const FloatN& distance, const TexturePoint<FloatN>* point) const;
  /// As MaterialTable has it.
  Rgb<FloatN> straight(const Hits& hits, const Refraction<FloatN>& media, const Vec3<FloatN>& wo,
                       const TexturePoint<FloatN>* point) const;
  /// What is below surfaces whose samples `enters`, and whether any object has such a material.
  Subsurface<FloatN> subsurface(const Hits& hits, const TexturePoint<FloatN>* point) const;
  bool has_subsurface() const { return has_subsurface_; }
  /// What is inside of clear materials that objects have; empty if there is none.
  const MediumTable& media() const { return media_; }
  /// What is inside of what was hit; 0: nothing, or the same as outside.
  IntN inside(const Hits& hits) const {
    const IntN medium = media_.of_material(material(hits));
    if (!densities_.has_instances()) [[likely]]
      return medium;
    const MaskN moved = hits.hit & float_mask<FloatN>(hits.instance != UintN(0u)) & media_.has_density(medium);
    return medium + densities_.place(moved, material(hits), hits.instance);
  }
  /// Of fogs that are not the same everywhere, by MediumTable::density().
  const DensityTable& densities() const { return densities_; }

  /// Whether materials have normal maps or bumps.
  bool has_relief() const { return has_relief_; }
  /// Turns the shading normals as they say; those of a coat and of the base below it apart.
  void add_relief(const Hits& hits, const TexturePoint<FloatN>& point, SurfaceInteraction<FloatN>& surface) const;

  /// The frame about surface.ns that materials sample and evaluate in: x is the material's tangent on surfaces whose
  /// reflection differs along the surface, if u says anything there. It is where u grows, or turned from there.
  Frame<FloatN> shading_frame(const Hits& hits, const SurfaceInteraction<FloatN>& surface,
                              const TexturePoint<FloatN>* point) const;

  /// Whether any of the lanes has a material with textures, or one that wants to know where u grows.
  bool has_textures(const Hits& hits) const;
  /// Whether any texture looks up by the second set of coordinates.
  bool has_second_uvset() const { return has_second_uvset_; }
  /// Whether materials ask for tangents at the vertices of meshes.
  bool has_vertex_tangents() const { return has_vertex_tangents_; }
  /// Whether meshes have alphas at their vertices.
  bool has_vertex_alphas() const { return has_vertex_alphas_; }
  /// Whether any texture is fixed to objects.
  bool has_object_space() const { return has_object_space_; }
  const RayCone& ray_cone() const { return ray_cone_; }  ///< of the camera's rays

 private:
  MaskN shines(const IntN& material, const MaskN& front) const {
    const IntN sides = gather(shining_sides_.data(), material);
    return float_mask<FloatN>(sides == IntN(2)) | (front & float_mask<FloatN>(sides == IntN(1)));
  }

  struct TexturedNumber {
    float value;
    std::optional<TextureUse> texture = std::nullopt;  ///< it multiplies the value
  };
  struct SurfaceDetail {
    TexturedNumber opacity, normalmap, bump, coatnormalmap{1}, tangentrotation{0};
    std::optional<TextureUse> tangentmap{};
    UvSet tangent_set = UvSet::first;  ///< whose u the tangent is along: the map's, or that of the normals
    MaterialEmission emission{};
    std::optional<Medium> medium{};
    bool is_anisotropic = false, focuses = false, is_pane = false, has_coat = false, has_subsurface = false;
    bool is_layered = false;  ///< a coat's normals may differ from those of the base below it
    bool is_even = false;     ///< it reflects light to all sides, and nothing like a mirror
    bool refracts = false, scatters_through = false, is_fibre = false;

    bool is_cutout() const { return opacity.value < 1 || opacity.texture; }
    bool has_relief() const { return normalmap.texture || bump.texture; }
    /// Whether layers have normals of their own.
    bool has_layers() const { return is_layered && (has_relief() || (has_coat && coatnormalmap.texture)); }
    bool has_turned_tangent() const {
      return is_anisotropic && (tangentrotation.value != 0 || tangentmap || tangent_set == UvSet::second);
    }
  };

  /// The parameters with all points less the origin.
  template <class Type>
  typename Type::Parameters moved(typename Type::Parameters parameters) const {
    for (const Field& point : point_fields<Type>()) point.get<Vec3d>(&parameters) += -origin_;
    return parameters;
  }
  void set_camera(const SceneDescription& description);
  bool camera_is_far_from(const BoundingSphere& sphere, const SceneDescription& description) const;
  void add_lights(const SceneDescription& description, int threads);
  void sort_lights();
  template <class LightKernel, class Parameters>
  void add_light_bounds(const LightKernel& light, const Parameters& parameters, const Vec3d& eye);
  template <class Material>
  TexturedMaterial<Material> textured_material(const MaterialItem<Material>& item, std::int32_t index) const;
  template <class Material>
  static SurfaceDetail surface_detail(const MaterialItem<Material>& item);
  template <class CameraKernel>
  void set_ray_cone(const CameraKernel& camera);
  /// ids: the pixels and samples, which say when the rays of a camera that moves are sent.
  /// They start at the eye, and their `near` is where the camera begins to see.
  template <class F, class CameraKernel>
  Ray<F> rays_of(const CameraKernel& camera, const FloatN& x, const FloatN& y, const Sample2D& lens,
                 const CameraRays& ids) const;
  void add_materials(const SceneDescription& description);
  /// For lanes that hit the same material: f(its detail, those lanes).
  template <class Function>
  void for_each_detail(const Hits& hits, const Function& f) const;
  /// Of the materials that have a turned one.
  void turn_tangents(const Hits& hits, const TexturePoint<FloatN>& point, Frame<FloatN>& frame) const;
  MeshMaterials mesh_materials(const SceneDescription& description) const;
  void add_caustics();
  void add_panes();
  void add_scattering_through(bool fibres_alone);

  /// answer(table, materials) of each material type among the lanes, each lane's of its own.
  template <class Answer>
  auto by_material(const Hits& hits, const Answer& answer) const;

  Vec3d origin_;
  ViewPlane viewplane_;
  FilterTable pixel_filter_;
  IntegratorParameters integrator_;
  PartTable parts_;
  std::optional<KernelVariant<Cameras>::type> camera_;
  std::vector<KernelVariant<Cameras>::type> moving_camera_;  ///< at each moment while the shutter is open
  std::optional<BoundingSphere> camera_target_;              ///< around all objects with bounds, if it is far
  Vec3f camera_eye_{}, viewing_direction_{};
  std::vector<Vec3f> moving_directions_;  ///< of moving_camera_
  float near_clip_ = 0;                   ///< along the viewing direction
  std::vector<float> moving_near_clips_;  ///< of moving_camera_
  bool depth_is_distance_ = false, camera_has_lens_ = false;
  std::optional<BufferOrigin> camera_origin_;
  std::vector<LightGroup> light_groups_;
  std::vector<std::int32_t> groups_of_lights_, groups_of_materials_;  ///< the latter of all materials
  std::int32_t environment_group_ = 0;
  LightBounds light_bounds_;
  bool has_sampled_lights_ = false;
  std::optional<Environment> environment_;
  std::vector<std::unique_ptr<LightSource>> lights_;
  std::vector<std::optional<BufferOrigin>> light_origins_;
  std::unique_ptr<const TextureTable> textures_;
  std::array<std::unique_ptr<MaterialTable>, Materials::size> materials_;
  std::array<std::int32_t, Materials::size + 1> first_material_{};  ///< of each type, counted together; their number
  std::unique_ptr<const GeometryTable> geometry_;
  std::optional<const EmitterTable> emitters_;
  std::optional<const CausticTable> caustics_;
  std::vector<float> emitted_;  ///< of each material, red, green and blue; of those with textures, the most
  bool has_invisible_media_ = false;
  std::vector<SurfaceDetail> details_;  ///< of all materials
  MediumTable media_;
  DensityTable densities_;
  bool has_cutouts_ = false, has_relief_ = false, has_emission_ = false, has_second_uvset_ = false,
       has_turned_tangents_ = false, has_subsurface_ = false, has_photons_ = false, has_panes_ = false,
       has_vertex_tangents_ = false, has_object_space_ = false, has_vertex_alphas_ = false;
  std::vector<std::int32_t> shining_sides_;       ///< of all materials: 0, 1 for the front, 2 for both
  std::vector<std::int32_t> panes_;               ///< 1 for those that are panes, else 0; empty where none are passed
  std::vector<std::int32_t> scattering_through_;  ///< likewise: those that send on light from behind
  std::vector<std::int32_t> fibres_;              ///< likewise: those that are fibres
  std::vector<std::int32_t> textured_;            ///< 1 for materials with textures, else 0; empty if there are none
  std::vector<std::int32_t> anisotropic_;         ///< likewise: those whose reflection differs along the surface
  RayCone ray_cone_;
  std::vector<std::uint8_t> used_materials_;  ///< 1 for those that objects have, else 0
};

template <class Point>
Rgb<FloatN> SceneTables::emitted(const EmitterTable::Sample& samples, const MaskN& lanes,
                                 const SurfaceInteraction<FloatN>& surface, const Point& point) const {
  if (!textured_.empty() && any(lanes & float_mask<FloatN>(gather(textured_.data(), samples.material) != IntN(0)))) {
    const Hits hits = emitters_->hits(samples, lanes);
    const TexturePoint<FloatN> there = point(hits);
    return emitted(hits, surface, &there);
  }
  const IntN first = samples.material * IntN(3);
  const float* const channels = emitted_.data();
  return select(lanes & shines(samples.material, surface.front),
                {gather(channels, first), gather(channels + 1, first), gather(channels + 2, first)},
                Rgb<FloatN>(Rgb<float>(0, 0, 0)));
}

template <class Function>
void SceneTables::for_each_detail(const Hits& hits, const Function& f) const {
  for_each_value(material(hits), hits.hit,
                 [&](std::int32_t number, const MaskN& here) { f(details_[static_cast<std::size_t>(number)], here); });
}

}  // namespace raytrace
