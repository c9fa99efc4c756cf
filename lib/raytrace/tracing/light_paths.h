// Paths that start at the lights: light that mirrors, metals and clear glass send onto surfaces which scatter it, where
// the camera sees these (Arvo, "Backward Ray Tracing", 1986; Veach 1997, section 10.3.4).
//
// Which light comes on them is a matter of its way alone, so that no light counts twice: from a light, by one or more
// points of objects that focus light (CausticTable), to a point of another material, which reflects it to the camera.
// Paths from the camera leave out what comes to them on such a way (tracing/path_batch.cpp).
//
// Each belongs to a pixel and a sample, whose numbers it draws; what it brings goes to whatever pixel shows its last
// point, into the film's splats.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "raytrace/film/splat_layer.h"
#include "raytrace/tracing/light_path_tracer.h"
#include "raytrace/tracing/render_report.h"

namespace raytrace {

class LightPaths final : private LightPathTracer {
 public:
  /// The scene must have caustics, the film splats. clock: of the thread. Throws std::bad_alloc.
  LightPaths(const TracedScene& scene, Film& film, StageClock& clock);

  /// A pixel of the film for each lane.
  struct Pixels {
    std::array<int, packet_lanes> x, y;
  };
  /// Begins those of these samples of these pixels, in the lanes of `wanted`.
  void begin(const Pixels& pixels, const UintN& samples, const MaskN& wanted, RenderReport& report);
  /// Brings all of them to their ends.
  void finish(RenderReport& report);

 private:
  /// Sends what reaches those points to the camera, where it shows them.
  void arrive(const LightPathPoint& at, const MaskN& scattered) override;
  void splat(const LightPathPoint& at, std::size_t lane, const FilmPoint& point, const Rgb<FloatN>& radiance);

  Film& film_;
  bool catches_shadows_;  ///< shadow catchers are not in the picture
  double inverse_unit_;
  std::vector<RadianceLayer*> layers_;  ///< of each light group; null where the film has none
  RenderReport* report_ = nullptr;      ///< while begin() and finish() run
};

}  // namespace raytrace
