// The render stage: passes over the picture, and what must happen between them. Checkpoints, the time limit, signals.
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "options.h"
#include "progress.h"
#include "raytrace/batch/provenance.h"
#include "raytrace/description/scene_description.h"
#include "raytrace/display/display_client.h"
#include "raytrace/output/file_identity.h"
#include "raytrace/render/renderer.h"
#include "signals.h"
#include "statistics.h"

namespace raytrace {

enum class RenderOutcome {
  written,
  failed,   ///< not all files could be written
  stopped,  ///< by a signal. The checkpoint, if there is to be one, and the files as far as the picture is done were
            ///< written
};

class PictureRender {
 public:
  using Clock = std::chrono::steady_clock;

  /// start: of the time that --time-limit limits. All must outlive it.
  PictureRender(const Scene& scene, const SceneDescription& description, const Options& options, const Region& whole,
                const Region& region, const Signals& signals, Clock::time_point start, Progress& progress,
                Statistics& statistics);

  /// Renders the picture and writes its files. Throws InputError if there is a checkpoint that does not fit.
  RenderOutcome run();

 private:
  FilmContent film_content() const;
  RenderOutcome render_at_once();
  RenderOutcome render_in_bands(int band_rows);
  RenderOutcome write_partial(const Film& film);
  void log_stopped(const std::string& what_is_kept) const;
  bool render_pass(Film& film, std::uint32_t target, double work_before, double work);
  void service_requests(const Film& film);
  std::uint32_t next_target(std::uint32_t done, double seconds_a_sample) const;
  bool is_due() const;
  void count(const RenderReport& report);
  void log_rendered() const;
  void log_invalid_samples() const;
  ImageMetadata metadata() const;
  bool write_picture(const Film& film, const std::vector<std::string>& files, std::uint32_t samples, bool partial);
  bool save_checkpoint(const Film& film);
  void remove_checkpoint() const;
  double fraction_of_time() const;

  const Scene& scene_;
  const SceneDescription& description_;
  const Options& options_;
  const Signals& signals_;
  Statistics& statistics_;
  RenderSettings settings_;
  FilmContent film_content_ = FilmContent::sums;
  PieceIdentity identity_;
  Clock::time_point start_;
  Clock::time_point next_checkpoint_;
  std::optional<FileIdentity> checkpoint_;  ///< that was read or written last
  InvalidSamples set_aside_;
  std::unique_ptr<DisplayClient> display_;  ///< none if it was not asked for
  bool in_bands_ = false;
  Progress& progress_;
};

}  // namespace raytrace
