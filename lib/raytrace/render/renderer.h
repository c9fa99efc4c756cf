// From a description to pixels: what programs call. No SIMD type appears here; the wide part stands behind Scene,
// compiled once for each instruction set (variants/variant.h).
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "raytrace/description/scene_description.h"
#include "raytrace/film/film.h"

namespace raytrace {

/// A scene that could not be built or rendered (Embree's or the machine's fault, not the scene file's).
class RenderError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct BuildSettings {
  int threads = 0;       ///< 0: all processors
  std::string isa;       ///< one of isa_names(); empty: the best that this processor has
  bool checked = false;  ///< the description is as load_scene() gave it, so that check_scene() need not run again
};

struct RenderSettings {
  int threads = 0;  ///< 0: all processors; at most these work, and at most as many as a living scene was built with
  std::uint64_t seed = 0;  ///< another seed gives another, equally good, pattern of samples
  Region region{};         ///< the pixels wanted, those outside are not in the film; not set: the whole picture
  std::optional<SampleRange> samples = std::nullopt;  ///< none: as many as the scene says, from the first on
  AovSet aovs{};
  bool transparent = false;  ///< FilmSettings::transparent
};

/// The rays of a render, by kind.
struct RayCounts {
  std::uint64_t camera = 0;
  std::uint64_t shadow = 0;
  RayCounts& operator+=(const RayCounts& other) {
    camera += other.camera;
    shadow += other.shadow;
    return *this;
  }
};

/// A sample of a pixel, by its index in the pixel's sequence.
struct SampleId {
  int x = 0, y = 0;
  std::uint32_t sample = 0;
};

/// The samples whose radiance was not finite: counted as black, and told.
struct InvalidSamples {
  static constexpr std::size_t most_listed = 10;
  std::uint64_t count = 0;
  std::vector<SampleId> told;  ///< the first most_listed of them, by row, column and index
  void add(const SampleId& sample);
  InvalidSamples& operator+=(const InvalidSamples& other);
};

/// What a render did.
struct RenderReport {
  RayCounts rays;
  InvalidSamples invalid_samples;
  RenderReport& operator+=(const RenderReport& other) {
    rays += other.rays;
    invalid_samples += other.invalid_samples;
    return *this;
  }
};

struct SceneStatistics {
  std::uint64_t primitives = 0;
  std::uint64_t bvh_bytes = 0;  ///< what Embree holds by now for this scene: it may wait for a ray that wants its BVH
  std::string isa;              ///< of the variant in use
  int lanes = 0;                ///< rays a packet
  std::string embree_version;
};

/// An immutable scene, ready to be traced.
class Scene {
 public:
  virtual ~Scene() = default;

  /// Continues the pixels of `region`, which must lie inside the film's, until each has `samples` of the film's sample
  /// range. The sums do not depend on how a picture is cut into regions, or the samples into calls. Safe to call from
  /// many threads for disjoint regions of tiles aligned to the packets' blocks. Once `stop` is set (null: never), it
  /// returns within a few samples of a packet; the film keeps what was done. Pixels of a film of means get theirs at
  /// once, of all samples.
  virtual RenderReport render_region(const Region& region, std::uint32_t samples, Film& film,
                                     const std::atomic<bool>* stop) const = 0;

  /// No sample's radiance is larger, in any channel.
  virtual float largest_radiance() const = 0;

  /// No material's albedo is larger, in any channel.
  virtual float largest_albedo() const = 0;

  virtual SceneStatistics statistics() const = 0;
};

/// The instruction sets that this program was built for, least first: "x86-64-v2", "x86-64-v3", "x86-64-v4".
std::vector<std::string> isa_names();

/// Whether this processor can run the named one.
bool isa_supported(const std::string& name);

/// The best one of isa_names() on this processor.
std::string best_isa();

/// The threads that a setting stands for: itself, or all processors for 0.
int thread_count(int wanted);

/// Makes the scene ready. Throws SceneError where the description breaks the format's rules, RenderError, or
/// std::bad_alloc where memory runs out; so does a render, for a BVH that waited for it.
std::unique_ptr<const Scene> build_scene(const SceneDescription& description, const BuildSettings& settings);

/// What a render tells while it runs. Calls come from any thread, one at a time and not often.
using ProgressFunction = std::function<void(double fraction)>;

/// Of a film for a render of the scene with the settings. Throws SceneError if the description's view plane breaks the
/// rules, and RenderError for a region without pixels or for no samples.
FilmSettings film_settings(const Scene& scene, const SceneDescription& description, const RenderSettings& settings);

/// Continues the film until each pixel has `samples` (at most the film's own). Returns early once `stop` is set; the
/// film keeps what was done, and another call goes on from there: of sums, that is. A film of means is rendered by one
/// call, with all its samples. threads: as RenderSettings::threads.
RenderReport render(const Scene& scene, Film& film, std::uint32_t samples, int threads,
                    const ProgressFunction& progress = {}, const std::atomic<bool>* stop = nullptr);

/// The picture as a whole: makes the film and renders all its samples.
Film render(const Scene& scene, const SceneDescription& description, const RenderSettings& settings, RayCounts& rays,
            const ProgressFunction& progress = {}, const std::atomic<bool>* stop = nullptr);

/// The matrices that image metadata carries for the description's camera.
CameraMatrices camera_matrices(const SceneDescription& description);

}  // namespace raytrace
