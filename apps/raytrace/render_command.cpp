#include "render_command.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <unordered_set>
#include <utility>

#include "messages.h"
#include "process.h"
#include "progress.h"
#include "raytrace/batch/output_files.h"
#include "raytrace/batch/render_picture.h"
#include "raytrace/description/parse_value.h"
#include "raytrace/output/atomic_file.h"
#include "raytrace/render/renderer.h"
#include "raytrace/text/message.h"
#include "run_all.h"
#include "signals.h"

namespace raytrace {

namespace {

/// Shows what a render says, and keeps limits and signals as each of its stages wants them.
class CommandObserver final : public RenderObserver {
 public:
  CommandObserver(const RenderJob& job, Progress* progress) : threads_(job.threads), progress_(progress) {
    // Whoever asked for a checkpoint begins again, and loses nothing while there are no rays.
    if (!job.checkpoint.empty()) no_rays_yet_.emplace(exit_code::resumable);
  }

  void on_stage(RenderStage stage) override {
    constexpr std::uint64_t embree_device = std::uint64_t{128} << 20U;
    obey_group_memory_limit(threads_, stage == RenderStage::build ? embree_device : 0);
    no_temporary_file_stays_.reset();
    if (stage == RenderStage::check_outputs) no_temporary_file_stays_.emplace();
    if (stage == RenderStage::render) signals_.emplace();
  }

  void on_message(MessageLevel level, const std::string& text) override {
    if (level == MessageLevel::error) log_error(text);
    if (level == MessageLevel::warning) log_warning(text);
    if (level == MessageLevel::note) log_note(text);
    if (level == MessageLevel::step) log_step(text);
  }

  void on_diagnostics(const Diagnostics& diagnostics) override { log_diagnostics(diagnostics); }

  void on_progress(const PictureProgress& progress) override {
    if (progress.fraction < 1) {
      progress_->update(progress);
    } else {
      progress_->finish(progress);
    }
  }

 private:
  int threads_;
  Progress* progress_;
  std::optional<StopEndsProgram> no_rays_yet_;
  std::optional<Signals> signals_;
  std::optional<StopSignalsWait> no_temporary_file_stays_;
};

/// What is wrong with a run of several renders, found before the first of them. What would fail in the same way again
/// and again is reported once: folders that cannot be written to, scenes that cannot be read.
class RunChecks {
 public:
  /// Throws OutputError or SettingsError for what would fail all renders. Checks nothing of a run of one render.
  explicit RunChecks(const RenderBatch& batch) {
    if (batch.size() == 1) return;
    const StopSignalsWait no_temporary_file_stays;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const RenderJob job = batch[i];
      check_scene(job);
      if (may_be_skipped(job)) continue;  // it may be in a folder that is read-only
      check_output_settings(job);
      check_folders(job);
    }
  }

  /// Whether a render cannot be for what was reported.
  bool forbid(const RenderJob& job) const {
    if (bad_.empty()) return false;
    if (bad_.contains(job.scene)) return true;
    if (may_be_skipped(job)) return false;
    const std::vector<std::string> files = job.files();
    return std::any_of(files.begin(), files.end(), [&](const auto& file) { return bad_.contains(folder(file)); });
  }

 private:
  void check_scene(const RenderJob& job) {
    if (job.scene == "-" || !checked_.insert(job.scene).second || access(job.scene.c_str(), R_OK) == 0) return;
    Diagnostics diagnostics(on_one_line(job.scene));
    if (!load_scene(job.scene, diagnostics)) bad_.insert(job.scene);  // reading it says why
    log_diagnostics(diagnostics);
  }

  void check_folders(const RenderJob& job) {
    for (const std::string& file : job.files()) {
      if (!checked_.insert(folder(file)).second || takes(folder(file) + ".raytrace-checked", false)) continue;
      bad_.insert(folder(file));
      takes(file, true);  // an error with the user's name
    }
  }

  static bool takes(const std::string& file, bool logs) {
    try {
      const AtomicFile made_and_removed(file);
      return true;
    } catch (const OutputError& error) {
      if (logs) log_error(error.what());
      return false;
    }
  }

  /// With a "/" at its end, so that none has the name of a scene.
  static std::string folder(const std::string& file) {
    return (std::filesystem::path(file).parent_path() / "").string();
  }

  std::unordered_set<std::string> checked_, bad_;  ///< scenes and folders
};

/// Prints the pixel's samples, each in a line as soon as it is there, and their mean.
void print_pixel(const RenderJob& job, const PixelIndex& pixel, const SceneDescription& description) {
  const Region whole = crop_window(description.viewplane, job);
  const Region region{pixel.x, pixel.y, pixel.x + 1, pixel.y + 1};
  if (!contains(whole, region)) {
    throw UsageError("--pixel: there is no pixel " + std::to_string(pixel.x) + "," + std::to_string(pixel.y) +
                     " in the picture of " + std::to_string(whole.width()) + " x " + std::to_string(whole.height()) +
                     " pixels" + (job.crop ? ", " + text_of(whole) : ""));
  }
  const std::unique_ptr<const Scene> scene = build_scene(description, {job.threads, job.isa, true});
  const SampleRange samples = sample_range(description.viewplane, job);
  RenderSettings settings{1, job.seed, region, samples};
  settings.transparent = job.transparent;
  const auto values = [&](const SampleRange& range) {
    settings.samples = range;
    Film film(film_settings(*scene, description, settings));
    const RenderReport report = render(*scene, film, range.count, 1);
    if (range.count == 1 && report.invalid_samples.count > 0) return std::string(" not finite");
    const Pixel mean = film.pixel(pixel.x, pixel.y);
    std::string text;
    for (const float value : {mean.red, mean.green, mean.blue, mean.alpha}) text += " " + number_text(double{value});
    return text;
  };
  for (std::uint32_t i = samples.first; i < samples.first + samples.count; ++i)
    print("sample " + std::to_string(i) + ":" + values({i, 1, samples.centered}) + "\n");
  print("mean:" + values(samples) + "\n");
}

/// --validate, --print-scene and --pixel
int print_instead(const Options& options, const RenderJob& job) {
  CommandObserver observer(job, nullptr);
  Phase unused;
  const std::optional<SceneDescription> description = load_picture(job, observer, unused);
  if (!description) return exit_code::failed;
  if (options.pixel) {
    print_pixel(job, *options.pixel, *description);
    return exit_code::done;
  }
  render_window(crop_window(description->viewplane, job), job);  // throws what a render would
  if (options.print_scene) {
    print(print_scene(*description));
  } else if (!options.quiet) {
    print(on_one_line(job.scene_name()) + ": ok (" + contents_text(*description) + ")\n");
  }
  return exit_code::done;
}

int run(const Options& options, const RenderJob& job, Progress& progress) {
  CommandObserver observer(job, &progress);
  const RenderResult result = render_picture(job, observer, signal_control());
  if (!result.kept.empty()) log_note("stopped by " + stop_signal_name() + ": " + result.kept);
  switch (result.outcome) {
    case RenderOutcome::skipped:
      progress.skip();
      return exit_code::done;
    case RenderOutcome::invalid_scene:
      return exit_code::failed;
    case RenderOutcome::stopped:
      return job.checkpoint.empty() ? exit_code::stopped + stop_signal() : exit_code::resumable;
    case RenderOutcome::written:
    case RenderOutcome::failed:
      break;
  }
  if (options.shows_statistics || is_logged(Verbosity::details)) log_lines(statistics_text(result.statistics));
  return result.outcome == RenderOutcome::written ? exit_code::done : exit_code::failed;
}

}  // namespace

int render_command(Options options) {
  const int wanted_threads = std::exchange(options.threads, threads_with_room(options.threads));
  static const std::string log_option = "--log-file";
  if (!options.log_file.empty()) options.other_files.push_back({log_option, options.log_file, true});
  const RenderBatch batch(options.scenes, options.frames, static_cast<const RenderJob&>(options));
  // Now the log file may be opened: it is not the scene.
  if (!options.log_file.empty()) log_to(options.log_file);
  log_missing_threads(wanted_threads, options.threads);
  Progress progress(options.progress);
  const RunChecks checks(batch);
  return run_all(batch, [&](const RenderJob& job, std::size_t index) {
    progress.begin(index, batch.size());
    if (checks.forbid(job)) return exit_code::failed;
    try {
      return options.renders() ? run(options, job, progress) : print_instead(options, job);
    } catch (const ClashError& error) {
      // Of a file that the scene names, which is not to have as much as this message.
      if (error.is_about(log_option)) end_log();
      throw;
    }
  });
}

}  // namespace raytrace
