// A scene's tables with what finds hits in them: Embree's scene, and direction buffers. What integrators trace.
#pragma once

#include <optional>
#include <vector>

#include "raytrace/accel/accelerator.h"
#include "raytrace/accel/media_around.h"
#include "raytrace/scene/scene.h"
#include "raytrace/scene/scene_tables.h"

namespace raytrace {

class TracedScene final : public Scene {
 public:
  /// isa_name: of the variant; embree_isa: Embree's name of the best instruction set that it may use. Throws
  /// RenderError and std::bad_alloc.
  TracedScene(const SceneDescription& description, int threads, const char* isa_name, const char* embree_isa);

  /// By the integrator, which sets it before anything is rendered.
  RadianceRange radiance_range() const override { return radiance_range_; }
  void set_radiance_range(const RadianceRange& range) { radiance_range_ = range; }
  bool traces_light_paths() const override { return tables_.caustics() != nullptr; }
  bool has_photons() const override { return tables_.has_photons(); }
  float largest_albedo() const override { return tables_.largest_albedo(); }
  const char* isa() const override { return isa_name_; }
  SceneStatistics statistics() const override;

  const SceneTables& tables() const { return tables_; }
  const Accelerator& accelerator() const { return accelerator_; }

  /// The media that camera rays start in: those that the camera is in when the shutter opens, or, where it does not see
  /// what is near, those around each start; lights, by what is around each path's start. ids: of its rays.
  MediumStack camera_media(const Vec3<FloatN>& starts, const MaskN& lanes, const RayIds& ids) const {
    return tables_.has_near_clip() && !tables_.media().empty() ? media_for_camera(starts, lanes, ids) : camera_media_;
  }
  /// The media around points: as the camera sees them, without what is not visible to it; and all.
  MediumStack media_for_camera(const Vec3<FloatN>& points, const MaskN& lanes, const RayIds& ids) const {
    return media_around(tables_, accelerator_, points, lanes, has_moving_instances() ? &ids : nullptr, true);
  }
  MediumStack media_of_all(const Vec3<FloatN>& points, const MaskN& lanes, const RayIds& ids) const {
    return media_around(tables_, accelerator_, points, lanes, has_moving_instances() ? &ids : nullptr);
  }
  MediumStack light_media(const Vec3<FloatN>& starts, const MaskN& lanes, const RayIds& ids) const {
    return lights_in_media_ ? media_of_all(starts, lanes, ids) : MediumStack();
  }

  /// The objects as met from where all camera rays start, and from where all shadow rays to light `number` go. Null if
  /// there is no such point, or it would not pay.
  const DirectionBuffer* camera_buffer() const { return camera_buffer_ ? &*camera_buffer_ : nullptr; }
  const DirectionBuffer* light_buffer(std::size_t number) const {
    const auto& buffer = light_buffers_[number];
    return buffer ? &*buffer : nullptr;
  }

 private:
  bool has_moving_instances() const { return !tables_.geometry().instances().moving().empty(); }
  void make_buffers(int threads);
  void find_media();

  SceneTables tables_;
  Accelerator accelerator_;
  std::optional<DirectionBuffer> camera_buffer_;
  std::vector<std::optional<DirectionBuffer>> light_buffers_;
  MediumStack camera_media_;
  bool lights_in_media_ = false;  ///< whether any light of light paths is in one
  RadianceRange radiance_range_;
  const char* isa_name_;
};

}  // namespace raytrace
