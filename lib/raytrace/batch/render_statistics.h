// What a render took and how much it did: for people as text, for programs as JSON, whose keys stand in
// share/statistics.schema.json and docs/command-line.md; it says when its schema_version must grow.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "raytrace/film/film.h"
#include "raytrace/render/renderer.h"

namespace raytrace {

struct Phase {
  double seconds = 0;
  std::uint64_t peak_memory_bytes = 0;  ///< the most that the process had held by its end
};

struct Phases {
  Phase load;       ///< scene file -> description
  Phase build;      ///< description -> scene with its BVH
  Phase render;     ///< scene -> film
  Phase denoise{};  ///< film -> colours without noise, where they are wanted
  Phase write;      ///< film -> image files
  double seconds() const { return load.seconds + build.seconds + render.seconds + denoise.seconds + write.seconds; }
  /// With their names, in their order. The picture was not denoised: without that.
  std::vector<std::pair<const char*, Phase>> named() const {
    std::vector<std::pair<const char*, Phase>> phases = {{"load", load}, {"build", build}, {"render", render}};
    if (denoise.seconds > 0) phases.emplace_back("denoise", denoise);
    phases.emplace_back("write", write);
    return phases;
  }
};

struct RenderStatistics {
  std::string software;
  std::string scene_file;
  std::optional<int> frame = std::nullopt;  ///< of the frames that were asked for
  std::vector<std::string> outputs;
  int width = 0, height = 0;  ///< of the whole picture
  Region region;              ///< rendered
  int samples = 0;            ///< per pixel
  std::uint64_t seed = 0;
  std::string view_transform = "srgb";  ///< of files for display; "ocio" with OpenColorIO
  double exposure = 0;                  ///< the same: in stops, with what the picture itself asked for
  double white_balance = 0;             ///< the same: in kelvin; 0: none
  int threads = 0;
  Phases phases;
  RayCounts rays;
  StageTimes stages;             ///< of path tracing, else empty
  double processor_seconds = 0;  ///< of rendering, of all threads together
  /// The root of the relative mean squared error of the picture's pixels, as ErrorEstimate has it: 0.02 is 2 %. None of
  /// ray casting, which knows no noise, nor of one sample a pixel.
  std::optional<double> estimated_error = std::nullopt;
  std::optional<float> photon_radius = std::nullopt;  ///< Photons::first_radius; none without photons
  SceneStatistics scene;
  std::uint64_t peak_memory_bytes = 0;

  std::uint64_t total_rays() const { return rays.camera + rays.shadow + rays.indirect; }
  double rays_per_second() const;
  /// Of processor_seconds; with their names, in their order. None where no stages were timed.
  std::vector<std::pair<const char*, double>> stage_seconds() const;
};

/// "2 samples without a finite radiance...": which they were, and how to see them again.
std::string invalid_samples_text(const InvalidSamples& invalid);

/// The most memory that this process has held so far.
std::uint64_t peak_memory_bytes();

/// Aligned lines, each with its end.
std::string statistics_text(const RenderStatistics& statistics);

std::string statistics_json(const RenderStatistics& statistics);

/// That, in a file. Throws OutputError.
void write_statistics_file(const RenderStatistics& statistics, const std::string& file);

/// Adds the time from its making to its end, or to stop(), to a phase, and notes the memory then.
class PhaseTimer {
 public:
  explicit PhaseTimer(Phase& phase) : phase_(phase) {}
  ~PhaseTimer() { stop(); }
  PhaseTimer(const PhaseTimer&) = delete;
  PhaseTimer& operator=(const PhaseTimer&) = delete;

  /// Ends it before its scope does.
  void stop() {
    if (!running_) return;
    phase_.seconds += std::chrono::duration<double>(Clock::now() - start_).count();
    phase_.peak_memory_bytes = peak_memory_bytes();
    running_ = false;
  }

 private:
  using Clock = std::chrono::steady_clock;
  Phase& phase_;
  Clock::time_point start_ = Clock::now();
  bool running_ = true;
};

}  // namespace raytrace
