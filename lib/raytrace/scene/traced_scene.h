// The immutable scene that integrators trace: geometry in Embree, materials, lights and camera, made from a
// description.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "raytrace/accel/accelerator.h"
#include "raytrace/cameras/camera.h"
#include "raytrace/lights/light_source.h"
#include "raytrace/materials/material.h"
#include "raytrace/render/renderer.h"

namespace raytrace {

class TracedScene final : public Scene {
 public:
  /// Throws as build_scene does.
  TracedScene(const SceneDescription& description, int threads, const char* isa_name, const char* embree_isa);

  RenderReport render_region(const Region& region, std::uint32_t samples, Film& film,
                             const std::atomic<bool>* stop) const override;
  float largest_radiance() const override { return largest_radiance_; }
  float largest_albedo() const override;
  SceneStatistics statistics() const override;

  const Accelerator& accelerator() const { return accelerator_; }
  const Camera& camera() const { return *camera_; }
  const ViewPlane& viewplane() const { return viewplane_; }
  /// The sum of all ambient lights.
  const Rgb<float>& ambient_radiance() const { return ambient_radiance_; }
  const std::vector<std::unique_ptr<LightSource>>& lights() const { return lights_; }

  /// What is to be seen from where all camera rays start, and from where all shadow rays to light `number` go. Null if
  /// there is no such place, or it would not pay.
  const DirectionBuffer* camera_buffer() const { return seen_from_[0] ? &*seen_from_[0] : nullptr; }
  const DirectionBuffer* light_buffer(std::size_t number) const {
    const auto& seen = seen_from_[number + 1];
    return seen ? &*seen : nullptr;
  }

  /// Unit length.
  const Vec3f& viewing_direction() const { return viewing_direction_; }

  // Of the things that were hit; at least one lane must have a hit, and lanes without one hold anything.

  /// Each object's place, counted from 0: type by type as in the Shapes registry, each type's in their order.
  IntN object(const Hits& hits) const;
  /// Each material's place, likewise.
  IntN material(const Hits& hits) const;
  Rgb<FloatN> albedo(const Hits& hits) const;

  /// The radiance that leaves the points hit against `direction`, that of the rays which hit them, each by its own
  /// material: one call for each material type among the lanes.
  Rgb<FloatN> shade(const Hits& hits, const Vec3<FloatN>& direction, const Vec3<FloatN>& normal,
                    const Rgb<float>& ambient_radiance, std::span<const ArrivingLight> lights) const;

 private:
  /// vantages: the camera's, then each light's, where it has one.
  void look_from(std::vector<std::optional<BufferOrigin>> vantages, int threads);

  /// answer(table, places) of each material type among the lanes, each lane's of its own.
  template <class Answer>
  Rgb<FloatN> by_material(const Hits& hits, const Answer& answer) const;

  ViewPlane viewplane_;
  Accelerator accelerator_;
  std::unique_ptr<Camera> camera_;
  std::vector<std::optional<DirectionBuffer>> seen_from_;  ///< the camera, then each light
  Vec3f viewing_direction_{};
  Rgb<float> ambient_radiance_{0, 0, 0};
  std::vector<std::unique_ptr<LightSource>> lights_;
  std::array<std::unique_ptr<MaterialTable>, Materials::size> materials_;
  std::array<std::int32_t, Materials::size + 1>
      first_material_{};                                   ///< of each type, all counted together; their number
  std::array<std::int32_t, Shapes::size> first_object_{};  ///< of each shape's type in object_materials_
  std::vector<std::int32_t> object_materials_;
  float largest_radiance_;
  const char* isa_name_;
};

}  // namespace raytrace
