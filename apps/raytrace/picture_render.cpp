#include "picture_render.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "about.h"
#include "messages.h"
#include "outputs.h"
#include "picture_settings.h"
#include "raytrace/aovs/aov_selection.h"
#include "raytrace/batch/checkpoint.h"
#include "raytrace/film/aov_film.h"
#include "raytrace/film/samples_done.h"
#include "raytrace/output/complete_picture.h"
#include "raytrace/output/film_channels.h"

namespace raytrace {

namespace {

using Seconds = std::chrono::duration<double>;

/// Films up to this size are held as a whole: of 67 million pixels, twice those of 8K, if nothing but colour is asked
/// for.
constexpr std::size_t largest_film = std::size_t{2} << 30U;
constexpr std::size_t largest_band = std::size_t{1} << 30U;

/// All of the region's, or of a band: the most whose film is not too large, and a multiple of every packet's height.
int rows_at_once(const Region& region, std::size_t pixel_bytes) {
  constexpr int unit = 32;
  const std::size_t row_bytes = pixel_bytes * static_cast<std::size_t>(region.width());
  if (row_bytes * static_cast<std::size_t>(region.height()) <= largest_film) return region.height();
  return unit * static_cast<int>(std::max<std::size_t>(1, largest_band / (unit * row_bytes)));
}

std::chrono::steady_clock::duration in_seconds(double seconds) {
  return std::chrono::duration_cast<std::chrono::steady_clock::duration>(Seconds(seconds));
}

}  // namespace

PictureRender::PictureRender(const Scene& scene, const SceneDescription& description, const Options& options,
                             const Region& whole, const Region& region, const Signals& signals, Clock::time_point start,
                             Progress& progress, Statistics& statistics)
    : scene_(scene),
      description_(description),
      options_(options),
      signals_(signals),
      statistics_(statistics),
      settings_{options.threads, options.seed,       region, sample_range(description.viewplane, options),
                options.aovs,    options.transparent},
      start_(start),
      next_checkpoint_(Clock::now() + in_seconds(options.checkpoint_interval)),
      progress_(progress) {
  identity_.provenance = provenance_of(software_name(), scene, description, options.threads);
  identity_.whole = whole;
  if (options.is_one_of_frames) identity_.frame = options.frame;
  identity_.variables = variables_text(options.variables);
  identity_.tile = options.tile;
  if (options.display_server) {
    const PictureExtent extent{description.viewplane.hres, description.viewplane.vres, region};
    display_ = std::make_unique<DisplayClient>(*options.display_server, options.outputs.front(), extent, log_warning);
  }
}

RenderOutcome PictureRender::run() {
  const AovSettings aovs = aov_settings(options_.aovs);
  const int rows = rows_at_once(settings_.region, sizeof(PixelSum) + AovFilm::pixel_bytes(aovs));
  // What goes on later, or may end at any sample, needs the whole film; so does the number of channels that a piece's
  // AOVs need.
  const bool whole_film =
      !options_.checkpoint.empty() || options_.time_limit || (options_.sample_offset && aovs.gather());
  film_content_ = film_content();
  in_bands_ = !whole_film && rows < settings_.region.height();
  const RenderOutcome ending = in_bands_ ? render_in_bands(rows) : render_at_once();
  log_invalid_samples();
  return ending;
}

/// Means where nobody asks for more: neither for samples to come after a while, nor for pieces to be put together, be
/// they stopped or not.
FilmContent PictureRender::film_content() const {
  const Region picture{0, 0, description_.viewplane.hres, description_.viewplane.vres};
  if (!options_.checkpoint.empty() || options_.time_limit || options_.sample_offset || display_ ||
      !options_.aovs.empty() || settings_.region != picture)
    return FilmContent::sums;
  const bool halves = std::all_of(options_.outputs.begin(), options_.outputs.end(), [&](const std::string& file) {
    return holds_halves(file, options_.image_file_settings());
  });
  return halves ? FilmContent::half_means : FilmContent::means;
}

RenderOutcome PictureRender::render_at_once() {
  PhaseTimer timer(statistics_.phases.render);
  Film film(film_settings(scene_, description_, settings_), film_content_);
  identity_.film = film.settings();
  std::uint32_t done = 0;
  if (options_.resume && std::filesystem::exists(options_.checkpoint)) {
    checkpoint_ = file_identity(options_.checkpoint);  // first: one that takes its place is not ours to remove
    read_checkpoint(options_.checkpoint, identity_, film);
    done = film.fewest_samples();
    log_step("resumed from " + options_.checkpoint);
  }
  const std::uint32_t all = film.settings().samples.count;
  double seconds_a_sample = 0;
  while (done < all) {
    const std::uint32_t target = next_target(done, seconds_a_sample);
    if (target == done) break;  // the time is up
    const Clock::time_point pass_start = Clock::now();
    if (!render_pass(film, target, 1.0 * done / all, 1.0 * (target - done) / all)) break;
    seconds_a_sample = Seconds(Clock::now() - pass_start).count() / (target - done);
    done = target;
  }
  timer.stop();
  if (signals_.stop_signal() != 0 && done < all) return write_partial(film);
  if (display_) display_->show(film, film.region());
  progress_.finish();
  log_rendered();
  statistics_.samples = static_cast<int>(done);
  if (done < all) log_warning("the time limit was reached after " + counted(done, "sample") + " a pixel");
  if (!write_picture(film, options_.outputs, done, false)) return RenderOutcome::failed;
  remove_checkpoint();
  return RenderOutcome::written;
}

/// After a signal to stop: writes the checkpoint and the picture so far, and tells which of them there are.
RenderOutcome PictureRender::write_partial(const Film& film) {
  std::vector<std::string> files = options_.outputs, kept, reasons;
  bool saved = true;
  statistics_.outputs.clear();
  if (!options_.checkpoint.empty()) {
    saved = save_checkpoint(film);
    if (saved) kept.push_back("checkpoint " + options_.checkpoint + " written, --resume goes on from it");
  } else {
    // Nothing goes on from here: an earlier picture that is complete is worth more. And where no mark says that this
    // one is not, the next run would skip it.
    std::erase_if(files, [&](const std::string& file) {
      const bool earlier = is_complete_picture(file), unmarked = options_.skip_existing && !holds_data(file);
      if (earlier) reasons.push_back(file + " is complete, from an earlier run, and stays");
      if (unmarked && !earlier) reasons.push_back(file + " could not say that it is partial, and would be skipped");
      return earlier || unmarked;
    });
  }
  const bool written = files.empty() || write_picture(film, files, identity_.film.samples.count, true);
  if (!statistics_.outputs.empty()) kept.push_back("picture so far in " + joined(statistics_.outputs, ", "));
  log_stopped((kept.empty() ? "nothing kept" : samples_done_text(film) + ": ") + joined(kept, "; ") +
              (reasons.empty() ? "" : "; ") + joined(reasons, "; "));
  return written && saved ? RenderOutcome::stopped : RenderOutcome::failed;
}

void PictureRender::log_stopped(const std::string& what_is_kept) const {
  log_note("stopped by " + signals_.stop_signal_name() + ": " + what_is_kept);
}

/// The one that this run read or wrote last.
void PictureRender::remove_checkpoint() const {
  if (!checkpoint_ || remove_file(options_.checkpoint, *checkpoint_)) return;
  log_warning("the checkpoint " + options_.checkpoint + " is not removed: another file has taken its place");
}

/// Large pictures go to their files band by band, so that no more than one of them need be in memory.
RenderOutcome PictureRender::render_in_bands(int band_rows) {
  const Region region = settings_.region;
  identity_.film = film_settings(scene_, description_, settings_);
  Outputs outputs(options_, options_.outputs, identity_.film.extent, metadata(),
                  options_.sample_offset ? all_sum_channels() : std::vector<Channel>());
  for (Region band = region; band.y0 < region.y1; band.y0 = band.y1) {
    band.y1 = std::min(band.y0 + band_rows, region.y1);
    settings_.region = band;
    PhaseTimer timer(statistics_.phases.render);
    Film film(film_settings(scene_, description_, settings_), film_content_);
    const double height = region.height();
    if (!render_pass(film, film.settings().samples.count, (band.y0 - region.y0) / height, band.height() / height)) {
      log_stopped("nothing kept: of a picture of this size, only --checkpoint keeps what is done");
      return RenderOutcome::stopped;
    }
    timer.stop();
    if (display_) display_->show(film, band);
    if (band.y1 == region.y1) {
      progress_.finish();
      log_rendered();
    }
    if (!outputs.write(film, statistics_)) return RenderOutcome::failed;
  }
  return outputs.commit(statistics_) ? RenderOutcome::written : RenderOutcome::failed;
}

/// Until each pixel has `target` samples; false if a signal stopped it. work_before, work: fractions of all that there
/// is to do, what was done before and what this does.
bool PictureRender::render_pass(Film& film, std::uint32_t target, double work_before, double work) {
  for (;;) {
    // First the flag, then what it stands for: a signal in between pauses once more than it need.
    signals_.pause() = false;
    if (signals_.stop_signal() != 0) return false;
    service_requests(film);
    const auto update = [&](double fraction) {
      progress_.update(std::max(work_before + fraction * work, fraction_of_time()));
      if (is_due()) signals_.pause() = true;
    };
    count(render(scene_, film, target, options_.threads, update, &signals_.pause()));
    if (!signals_.pause()) return true;
  }
}

/// Does what is asked for, or due, while the render pauses.
void PictureRender::service_requests(const Film& film) {
  if (signals_.take_picture_request()) {
    if (in_bands_) {
      log_warning("a picture of this size goes to its files band by band: there is none to look at before the end");
    } else {
      if (write_picture(film, options_.outputs, film.settings().samples.count, true))
        log_note("picture so far, " + samples_done_text(film) + ", in " + joined(options_.outputs, ", "));
    }
  }
  if (!options_.checkpoint.empty() && Clock::now() >= next_checkpoint_) save_checkpoint(film);
  if (display_ && display_->is_due()) display_->show(film, film.region());
}

/// Whether something is to be done that wants the render to pause.
bool PictureRender::is_due() const {
  return (!options_.checkpoint.empty() && Clock::now() >= next_checkpoint_) || (display_ && display_->is_due());
}

/// The samples a pixel after the next pass: early passes are short, so that there is a whole picture soon. With a time
/// limit, no pass is begun that would not end in time.
std::uint32_t PictureRender::next_target(std::uint32_t done, double seconds_a_sample) const {
  const std::uint32_t all = identity_.film.samples.count;
  if (!options_.time_limit && options_.checkpoint.empty() && !display_) return all;
  constexpr std::uint32_t group = 4;  // of samples that are traced together: of fewer, each would cost more
  constexpr std::uint32_t least_samples = group, most_samples = 32;  // of a pass
  std::uint32_t samples = std::min(std::clamp(done, least_samples, most_samples), all - done);
  if (options_.time_limit && done > 0) {
    const double left = *options_.time_limit - Seconds(Clock::now() - start_).count();
    const double fitting = seconds_a_sample > 0 ? std::max(0.0, left / seconds_a_sample) : left > 0 ? group : 0.0;
    if (fitting < samples) samples = static_cast<std::uint32_t>(fitting) / group * group;
  }
  return done + samples;
}

void PictureRender::count(const RenderReport& report) {
  statistics_.rays += report.rays;
  statistics_.scene.bvh_bytes = scene_.statistics().bvh_bytes;  // rays may have been the first to want it
  set_aside_ += report.invalid_samples;
}

void PictureRender::log_rendered() const {
  char seconds[32];
  std::snprintf(seconds, sizeof seconds, " in %.3f s", statistics_.phases.render.seconds);
  log_step("rendered " + counted(statistics_.total_rays(), "ray") + " on " +
           counted(static_cast<std::uint64_t>(options_.threads), "thread") + seconds);
}

void PictureRender::log_invalid_samples() const {
  if (set_aside_.count == 0) return;
  std::string text = counted(set_aside_.count, "sample") + " without a finite radiance, counted as black:";
  for (const SampleId& id : set_aside_.listed) {
    text +=
        " sample " + std::to_string(id.sample) + " of pixel " + std::to_string(id.x) + "," + std::to_string(id.y) + ";";
  }
  const SampleId& first = set_aside_.listed.front();
  log_warning(text + " to see it again: --pixel " + std::to_string(first.x) + "," + std::to_string(first.y));
}

ImageMetadata PictureRender::metadata() const {
  ImageMetadata metadata;
  metadata.software = statistics_.software;
  metadata.scene_file = statistics_.scene_file;
  metadata.samples = static_cast<int>(identity_.film.samples.count);
  metadata.seed = statistics_.seed;
  metadata.threads = statistics_.threads;
  metadata.camera = camera_matrices(description_);
  metadata.attributes = identity_attributes(identity_);
  metadata.data_attributes = aov_attributes(options_.aovs, description_);
  return metadata;
}

/// samples: that each pixel has, or is to have if the picture is partial.
bool PictureRender::write_picture(const Film& film, const std::vector<std::string>& files, std::uint32_t samples,
                                  bool partial) {
  ImageMetadata its_metadata = metadata();
  its_metadata.samples = static_cast<int>(samples);
  if (!partial) its_metadata.render_seconds = statistics_.phases.render.seconds;
  its_metadata.attributes = partial ? partial_attributes(identity_, film) : identity_attributes(identity_);
  const bool keeps_sums = film.content() == FilmContent::sums && (partial || options_.sample_offset);
  Outputs outputs(options_, files, film.settings().extent, its_metadata,
                  keeps_sums ? sum_channels(film) : std::vector<Channel>());
  return outputs.write(film, statistics_) && outputs.commit(statistics_);
}

/// False if it could not be written, which is told: the render goes on, and an earlier one is as it was.
bool PictureRender::save_checkpoint(const Film& film) {
  const Clock::time_point begin = Clock::now();
  bool saved = true;
  try {
    checkpoint_ = write_checkpoint(options_.checkpoint, film, identity_, metadata());
    log_step("wrote checkpoint " + options_.checkpoint + ": " + samples_done_text(film));
  } catch (const OutputError& error) {
    log_error(error.what());
    saved = false;
  }
  // However long it took, it takes no more than a hundredth of the time.
  const Clock::time_point end = Clock::now();
  next_checkpoint_ = end + std::max(in_seconds(options_.checkpoint_interval), 100 * (end - begin));
  return saved;
}

double PictureRender::fraction_of_time() const {
  return options_.time_limit ? std::min(1.0, Seconds(Clock::now() - start_).count() / *options_.time_limit) : 0.0;
}

}  // namespace raytrace
