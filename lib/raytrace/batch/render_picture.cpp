#include "raytrace/batch/render_picture.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <memory>
#include <utility>

#include "raytrace/aovs/aov_selection.h"
#include "raytrace/batch/bands.h"
#include "raytrace/batch/brightness.h"
#include "raytrace/batch/check_job.h"
#include "raytrace/batch/checkpoint.h"
#include "raytrace/batch/denoise.h"
#include "raytrace/batch/error_limit.h"
#include "raytrace/batch/job_film_content.h"
#include "raytrace/batch/output_files.h"
#include "raytrace/batch/passes.h"
#include "raytrace/batch/picture_metadata.h"
#include "raytrace/batch/provenance.h"
#include "raytrace/batch/settings_error.h"
#include "raytrace/description/check_scene.h"
#include "raytrace/display/display_client.h"
#include "raytrace/film/aov_film.h"
#include "raytrace/film/photons.h"
#include "raytrace/film/samples_done.h"
#include "raytrace/output/atomic_file.h"
#include "raytrace/output/auto_exposure.h"
#include "raytrace/output/complete_picture.h"
#include "raytrace/output/image_band.h"
#include "raytrace/render/renderer.h"
#include "raytrace/text/message.h"

namespace raytrace {
namespace {
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

double seconds_since(Clock::time_point start) { return Seconds(Clock::now() - start).count(); }

class PictureRender {
 public:
  PictureRender(const RenderJob& job, RenderObserver& observer, RenderControl& control,
                std::optional<SceneDescription> description)
      : job_(job), observer_(observer), control_(control), description_(std::move(description)) {}

  RenderResult run() {
    const auto end_with = [&](RenderOutcome outcome) {
      result_.outcome = outcome;
      return std::move(result_);
    };
    const bool may_skip = may_be_skipped(job_);  // if the files are of this picture, which the scene says
    if (!may_skip) check();
    if (!description_) description_ = load_picture(job_, observer_, result_.statistics.phases.load);
    if (!description_) return end_with(RenderOutcome::invalid_scene);
    job_.aovs = aovs_in(job_, *description_);
    identity_.whole = crop_window(description_->viewplane, job_);
    settings_.region = render_window(identity_.whole, job_);
    if (may_skip) {
      if (outputs_are_complete(job_, *description_)) {
        report(MessageLevel::note, joined(job_.outputs, ", ") + ": there already, skipped");
        return end_with(RenderOutcome::skipped);
      }
      check();
    }
    for (const std::string& file : job_.outputs) check_size(file, settings_.region, job_.image_file_settings());
    build();

    observer_.on_stage(RenderStage::render);
    begin_film();
    const bool others_reach_it = identity_.film.rendered() != identity_.film.extent.region;
    refuse_useless_tile(job_, description_->viewplane, others_reach_it);
    const AovSettings aovs = aov_settings(settings_.aovs);
    const int rows = rows_at_once(settings_.region, sizeof(PixelSum) + AovFilm::pixel_bytes(aovs));
    // What goes on later, or may end at any sample, needs the whole film; so do the channels of a piece's AOVs.
    const bool whole_film = !job_.checkpoint.empty() || job_.time_limit || job_.error_limit ||
                            (job_.sample_offset && aovs.gather()) ||
                            scene_->traces_light_paths() ||  // which reach any row
                            !aovs.layers.empty() || is_exposed_by_itself() || is_denoised(job_);
    in_bands_ = !whole_film && rows < settings_.region.height();
    const RenderOutcome outcome = in_bands_ ? render_in_bands(rows) : render_at_once();
    report_invalid_samples();
    if (outcome != RenderOutcome::stopped) write_statistics();
    return end_with(outcome);
  }

 private:
  void check() {
    observer_.on_stage(RenderStage::check_outputs);
    check_outputs(job_);
  }

  void build() {
    observer_.on_stage(RenderStage::build);
    RenderStatistics& statistics = result_.statistics;
    {
      const PhaseTimer timer(statistics.phases.build);
      scene_ = build_scene(*description_, {job_.threads, job_.isa, true});
    }
    statistics.scene = scene_->statistics();
    report(MessageLevel::step, "built for " + statistics.scene.isa + " with Embree " + statistics.scene.embree_version +
                                   time_taken(statistics.phases.build.seconds));
    statistics.software = software_name();
    statistics.scene_file = job_.scene_name();
    statistics.width = description_->viewplane.hres;
    statistics.height = description_->viewplane.vres;
    statistics.region = settings_.region;
    statistics.samples = description_->viewplane.samples;
    statistics.seed = job_.seed;
    statistics.threads = thread_count(job_.threads);
  }

  /// What the film is to be, and what its files say of it.
  void begin_film() {
    settings_.threads = job_.threads;
    settings_.whole = identity_.whole;
    settings_.seed = job_.seed;
    settings_.samples = sample_range(description_->viewplane, job_);
    settings_.aovs = film_aovs(job_);
    settings_.transparent = job_.transparent;
    settings_.single_splats = job_.denoise;
    film_content_ = job_film_content(job_, *scene_, *description_, settings_);
    identity_.film = film_settings(*scene_, *description_, settings_);
    if (const auto warning = rounding_warning(*scene_, identity_.film)) report(MessageLevel::warning, *warning);
    if (const auto warning = no_light_warning(*description_)) report(MessageLevel::warning, *warning);
    identity_.provenance = provenance_of(*scene_, *description_, job_.threads);
    identity_.tile = job_.tile;
    if (job_.is_one_of_frames) identity_.frame = result_.statistics.frame = job_.frame;
    identity_.variables = variables_text(job_.variables);
    if (!job_.checkpoint.empty()) checkpoint_ = CheckpointFile(job_.checkpoint, job_.checkpoint_interval);
    if (job_.display_server) {
      const PictureExtent extent{description_->viewplane.hres, description_->viewplane.vres, settings_.region};
      display_ = std::make_unique<DisplayClient>(*job_.display_server, job_.outputs.front(), extent,
                                                 [this](const auto& text) { report(MessageLevel::warning, text); });
    }
  }

  RenderOutcome render_at_once() {
    PhaseTimer timer(result_.statistics.phases.render);
    Film film(identity_.film, film_content_);
    std::uint32_t done = 0, begun = 0;  // samples that all pixels have, and some, of a pass that was stopped
    if (job_.resume && std::filesystem::exists(job_.checkpoint)) {
      error_.set_sums(checkpoint_.read(identity_, film));
      done = film.fewest_samples();
      begun = samples_done(film).most;
      report(MessageLevel::step, "resumed from " + job_.checkpoint);
    }
    const std::uint32_t all = film.settings().samples.count;
    double seconds_a_sample = 0;
    while (done < all && (done < begun || !error_limit_.is_reached(error_, done))) {
      const std::uint32_t target = std::max(next_target(done, seconds_a_sample), begun);
      if (target == done) break;  // the time is up
      const Clock::time_point pass_start = Clock::now();
      if (!render_pass(film, target, 1.0 * done / all, 1.0 * (target - done) / all)) break;
      error_.end_pass(target - done);
      seconds_a_sample = seconds_since(pass_start) / (target - done);
      done = target;
    }
    timer.stop();
    if (film.photons() != nullptr) result_.statistics.photon_radius = film.photons()->first_radius;
    if (control_.is_stopped() && done < all) return write_partial(film);
    if (display_) display_->show(film, film.region());
    finish_render();
    result_.statistics.samples = static_cast<int>(done);
    if (error_limit_.is_reached(error_, done))
      report(MessageLevel::note, "the error limit was reached after " + counted(done, "sample") + " per pixel");
    else if (const auto warning = error_limit_.warning(error_); warning && done == all)
      report(MessageLevel::warning, *warning);
    else if (done < all)
      report(MessageLevel::warning, "the time limit was reached after " + counted(done, "sample") + " per pixel" +
                                        (identity_.frame ? " of frame " + std::to_string(*identity_.frame) : ""));
    std::optional<DenoisedPicture> denoised;
    const Denoising denoising =
        is_denoised(job_) ? denoise(film, job_, observer_, control_, result_.statistics, denoised) : Denoising::done;
    if (denoising == Denoising::stopped) return write_partial(film);
    const bool written = write_picture(film, job_.outputs, done, false, denoised ? &*denoised : nullptr);
    if (!written || denoising == Denoising::failed) return RenderOutcome::failed;
    checkpoint_.remove(observer_);
    report_brightness(film);
    return RenderOutcome::written;
  }

  /// Large pictures go to their files band by band, so that no more than one of them need be in memory.
  RenderOutcome render_in_bands(int band_rows) {
    const Region region = settings_.region;
    Phases& phases = result_.statistics.phases;
    OutputFiles outputs(job_, job_.outputs, file_settings(0), identity_.film.extent, metadata(),
                        job_.sample_offset ? all_sum_channels() : std::vector<Channel>(), nullptr, observer_);
    for (Region band = region; band.y0 < region.y1; band.y0 = band.y1) {
      band.y1 = std::min(band.y0 + band_rows, region.y1);
      settings_.region = band;
      PhaseTimer timer(phases.render);
      Film film(film_settings(*scene_, *description_, settings_), film_content_);
      const double height = region.height();
      if (!render_pass(film, film.settings().samples.count, (band.y0 - region.y0) / height, band.height() / height)) {
        result_.kept = "nothing kept: of a picture of this size, only --checkpoint keeps what is done";
        return RenderOutcome::stopped;
      }
      timer.stop();
      if (display_) display_->show(film, band);
      if (band.y1 == region.y1) finish_render();
      const PhaseTimer writing(phases.write);
      if (!outputs.write(film)) return RenderOutcome::failed;
    }
    const PhaseTimer writing(phases.write);
    result_.statistics.outputs = outputs.commit();
    return result_.statistics.outputs.size() == job_.outputs.size() ? RenderOutcome::written : RenderOutcome::failed;
  }

  /// Until each pixel has `target` samples; false if it was stopped. work_before, work: fractions of all that there is
  /// to do, what was done before and what this does.
  bool render_pass(Film& film, std::uint32_t target, double work_before, double work) {
    for (;;) {
      // First the flag, then what it stands for: a request in between pauses once more than it need.
      control_.pause() = false;
      if (control_.is_stopped()) return false;
      service_requests(film);
      const auto update = [&](const RenderProgress& pass) {
        const double of_time = job_.time_limit ? seconds_since(start_) / *job_.time_limit : 0;
        const double of_samples = work_before + pass.fraction * work;
        const double done = std::max({of_samples, of_time, error_limit_.share(error_, pass.error)});
        const std::uint32_t all = identity_.film.samples.count, samples = static_cast<std::uint32_t>(of_samples * all);
        observer_.on_progress(
            {std::min(done, std::nextafter(1.0, 0.0)), samples, all, error_.estimate(pass.error), identity_.frame});
        if (is_due()) control_.pause() = true;
      };
      const RenderReport done = render(*scene_, film, target, job_.threads, update, &control_.pause());
      result_.statistics.rays += done.rays;
      result_.statistics.stages += done.stages;
      error_.add(done.error);
      result_.statistics.processor_seconds += done.processor_seconds;
      result_.statistics.scene.bvh_bytes = scene_->statistics().bvh_bytes;  // rays may have been the first to want it
      invalid_samples_ += done.invalid_samples;
      if (!control_.pause()) return true;
    }
  }

  /// Does what is asked for, or due, while the render pauses.
  void service_requests(const Film& film) {
    if (control_.take_picture_request()) {
      if (in_bands_) {
        report(MessageLevel::warning,
               "a picture of this size goes to its files band by band: there is none to look at before the end");
      } else if (write_picture(film, job_.outputs, film.settings().samples.count, true)) {
        report(MessageLevel::note, "picture so far, " + samples_done_text(film) + ", in " + joined(job_.outputs, ", "));
      }
    }
    if (checkpoint_.is_due()) checkpoint_.write(film, identity_, metadata(), error_.sums(), observer_);
    if (display_ && display_->is_due()) display_->show(film, film.region());
  }

  /// Whether something is to be done that wants the render to pause.
  bool is_due() const { return checkpoint_.is_due() || (display_ && display_->is_due()); }

  /// The samples per pixel after the next pass. With a time limit, none is begun that would not end in time.
  std::uint32_t next_target(std::uint32_t done, double seconds_a_sample) const {
    const std::uint32_t all = identity_.film.samples.count;
    if (!job_.time_limit && !job_.error_limit && job_.checkpoint.empty() && !display_) return all;
    const std::uint32_t samples = samples_of_pass(done, all);
    if (!job_.time_limit || done == 0) return done + samples;
    return done + samples_in_time(samples, *job_.time_limit - seconds_since(start_), seconds_a_sample);
  }

  void finish_render() {
    RenderStatistics& statistics = result_.statistics;
    statistics.estimated_error = error_.estimate();
    const std::uint32_t samples = identity_.film.samples.count;
    observer_.on_progress({1, samples, samples, statistics.estimated_error, identity_.frame});
    report(MessageLevel::step, "rendered " + counted(statistics.total_rays(), "ray") + " on " +
                                   counted(static_cast<std::uint64_t>(statistics.threads), "thread") +
                                   time_taken(statistics.phases.render.seconds));
  }

  /// After a stop: writes the checkpoint and the picture so far, and says which of them there are.
  RenderOutcome write_partial(const Film& film) {
    std::vector<std::string> files = job_.outputs, kept, reasons;
    bool saved = true;
    if (!job_.checkpoint.empty()) {
      saved = checkpoint_.write(film, identity_, metadata(), error_.sums(), observer_);
      if (saved) kept.push_back("checkpoint " + job_.checkpoint + " written, --resume goes on from it");
    } else {
      // Nothing goes on from here: an earlier picture that is complete is worth more. And where no mark says that this
      // one is not, the next run would skip it.
      std::erase_if(files, [&](const std::string& file) {
        const bool earlier = is_complete_picture(file), unmarked = job_.skip_existing && !image_format(file).data;
        if (earlier) reasons.push_back(file + " is complete, from an earlier run, and stays");
        if (unmarked && !earlier) reasons.push_back(file + " could not say that it is partial, and would be skipped");
        return earlier || unmarked;
      });
    }
    const std::vector<std::string>& written = result_.statistics.outputs = {};
    const bool all_written = files.empty() || write_picture(film, files, identity_.film.samples.count, true);
    if (!written.empty()) kept.push_back("picture so far in " + joined(written, ", "));
    result_.kept = (kept.empty() ? "nothing kept" : samples_done_text(film) + ": ") + joined(kept, "; ") +
                   (reasons.empty() ? "" : "; ") + joined(reasons, "; ");
    return all_written && saved ? RenderOutcome::stopped : RenderOutcome::failed;
  }

  /// samples: that each pixel has, or is to have if the picture is partial. denoised: null if it is not.
  bool write_picture(const Film& film, const std::vector<std::string>& files, std::uint32_t samples, bool partial,
                     const DenoisedPicture* denoised = nullptr) {
    const PhaseTimer timer(result_.statistics.phases.write);
    ImageMetadata its_metadata = metadata(denoised != nullptr);
    its_metadata.samples = static_cast<int>(samples);
    if (partial) {
      its_metadata.attributes = partial_attributes(identity_, film);
    } else {
      its_metadata.render_seconds = result_.statistics.phases.render.seconds;
    }
    const bool is_part = film.settings().rendered() != film.region();  // without what others' light paths bring
    const bool keeps_sums = film.content() == FilmContent::sums && (partial || job_.sample_offset || is_part);
    const ImageFileSettings settings = file_settings(is_exposed_by_itself() ? automatic_exposure(film) : 0);
    if (is_exposed_by_itself())
      report(MessageLevel::step, formatted("exposed by its own brightness, as by --exposure %g", settings.exposure));
    OutputFiles outputs(job_, files, settings, film.settings().extent, its_metadata,
                        keeps_sums ? sum_channels(film) : std::vector<Channel>(), denoised, observer_);
    if (!outputs.write(film)) return false;
    result_.statistics.outputs = outputs.commit();
    return result_.statistics.outputs.size() == files.size();
  }

  /// Whether an output needs all of the picture before its first row can be written.
  bool is_exposed_by_itself() const {
    return description_->viewplane.autoexposure && any_for_display(job_.outputs, job_.image_file_settings());
  }

  /// exposure: that the picture itself asks for.
  ImageFileSettings file_settings(double exposure) {
    ImageFileSettings settings = job_.image_file_settings();
    set_view(settings, view_settings(description_->viewplane), exposure);
    if (!any_for_display(job_.outputs, settings)) return settings;
    result_.statistics.view_transform = settings.ocio.empty() ? name_of(settings.view_transform) : "ocio";
    result_.statistics.exposure = settings.exposure;
    result_.statistics.white_balance = settings.white_balance;
    return settings;
  }

  ImageMetadata metadata(bool denoised = false) const {
    return picture_metadata(job_, *description_, identity_, result_.statistics, denoised);
  }

  void report_invalid_samples() const {
    if (invalid_samples_.count > 0) report(MessageLevel::warning, invalid_samples_text(invalid_samples_));
  }

  /// Of a part, another one may have what is missed.
  void report_brightness(const Film& film) const {
    if (film.region() != whole_picture(description_->viewplane) || job_.sample_offset) return;
    const RenderStatistics& statistics = result_.statistics;
    std::optional<ShownAs> shown;
    if (!is_exposed_by_itself() && any_for_display(job_.outputs, job_.image_file_settings()))
      shown = {statistics.exposure, statistics.view_transform == name_of(ViewTransform::srgb)};
    const auto warning = brightness_warning(film, *scene_, *description_, shown);
    if (warning) report(MessageLevel::warning, *warning);
  }

  /// Completes the statistics, and writes them to their file.
  void write_statistics() {
    result_.statistics.peak_memory_bytes = peak_memory_bytes();
    if (!job_.statistics.empty()) write_statistics_file(result_.statistics, job_.statistics);
  }

  void report(MessageLevel level, const std::string& text) const { observer_.on_message(level, text); }

  RenderJob job_;  ///< with the names of all light groups that it wants
  RenderObserver& observer_;
  RenderControl& control_;
  const Clock::time_point start_ = Clock::now();
  std::optional<SceneDescription> description_;  ///< none: to be loaded
  std::unique_ptr<const Scene> scene_;
  RenderSettings settings_;
  FilmContent film_content_ = FilmContent::sums;
  PieceIdentity identity_;
  bool in_bands_ = false;
  CheckpointFile checkpoint_;
  InvalidSamples invalid_samples_;
  ErrorOfPasses error_;
  const ErrorLimit error_limit_{job_.error_limit};
  std::unique_ptr<DisplayClient> display_;  ///< none if it was not asked for
  RenderResult result_;
};

}  // namespace

RenderResult render_picture(const RenderJob& job, RenderObserver& observer, RenderControl& control) {
  require_good_job(job);
  return PictureRender(job, observer, control, std::nullopt).run();
}

RenderResult render_picture(const RenderJob& job, SceneDescription description, RenderObserver& observer,
                            RenderControl& control) {
  require_good_job(job);
  require_good_scene(description);
  apply_job(job, description);
  return PictureRender(job, observer, control, std::move(description)).run();
}

}  // namespace raytrace
