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
  /// The same of a PacketBlock's pixels in the region.
  template <class Block>
  void begin(const Block& block, const Region& region, const UintN& samples, const MaskN& wanted,
             RenderReport& report) {
    Pixels pixels;
    alignas(64) std::array<std::uint32_t, packet_lanes> in_region{};
    block.for_each_lane(region, [&](int x, int y, std::size_t lane) {
      pixels.x[lane] = x;
      pixels.y[lane] = y;
      in_region[lane] = 1;
    });
    const MaskN here = float_mask<FloatN>(UintN::load_aligned(in_region.data()) != UintN(0u));
    begin(pixels, samples, wanted & here, report);
  }
  /// Brings all of them to their ends.
  void finish(RenderReport& report);

 private:
  /// Sends what reaches those points to the camera, where it shows them.
  void arrive(const LightPathPoint& at, const MaskN& scattered) override;
  void splat(const LightPathPoint& at, std::size_t lane, const FilmPoint& point, const Rgb<FloatN>& radiance,
             const Rgb<FloatN>& gloss);

  Film& film_;
  bool catches_shadows_;  ///< shadow catchers are not in the picture
  double inverse_unit_;
  std::vector<RadianceLayer*> layers_;                      ///< of each light group; null where the film has none
  RadianceLayer *diffuse_ = nullptr, *specular_ = nullptr;  ///< of passes, likewise
  RenderReport* report_ = nullptr;                          ///< while begin() and finish() run
};

}  // namespace raytrace
