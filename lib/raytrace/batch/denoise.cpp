#include "raytrace/batch/denoise.h"

#include <algorithm>
#include <iterator>
#include <new>
#include <string>
#include <utility>
#include <vector>

#include "raytrace/aovs/aov_selection.h"
#include "raytrace/text/message.h"

namespace raytrace {

AovSet film_aovs(const RenderJob& job) {
  AovSet aovs = job.aovs;
  if (job.denoise) aovs.add(aov_set({std::begin(denoiser_aovs), std::end(denoiser_aovs)}));
  return aovs;
}

namespace {

DenoisedPicture picture_of(const Film& film, int threads) {
  const Region& region = film.region();
  std::vector<Channel> channels = color_channels(true);
  for (Channel& channel : aov_channels(film.settings().aovs.wanted)) channels.push_back(std::move(channel));
  DenoisedPicture picture(region, channels, film.settings().transparent);
  ImageBand band;
  for (int y0 = region.y0; y0 < region.y1; y0 = band.region.y1) {
    fill_color(band, film, y0, std::min(y0 + band_rows(region.width(), channels.size()), region.y1), threads);
    fill_aovs(band, ImageBand::colors, film);
    picture.add(band);
  }
  return picture;
}

}  // namespace

bool is_denoised(const RenderJob& job) { return job.denoise && !job.tile && !job.sample_offset; }

Denoising denoise(const Film& film, const RenderJob& job, RenderObserver& observer, const RenderControl& control,
                  RenderStatistics& statistics, std::optional<DenoisedPicture>& denoised) {
  Phase& phase = statistics.phases.denoise;
  const auto fail = [&](const std::string& reason) {
    observer.on_message(MessageLevel::error, reason + "; it is written with its noise");
    return Denoising::failed;
  };
  try {
    const PhaseTimer timer(phase);
    DenoisedPicture picture = picture_of(film, job.threads);
    if (!picture.denoise(job.threads, [&] { return control.is_stopped(); })) return Denoising::stopped;
    denoised = std::move(picture);
  } catch (const OutputError& error) {
    return fail(error.what());
  } catch (const std::bad_alloc&) {
    return fail("no memory to denoise the picture");
  }
  observer.on_message(MessageLevel::step, "denoised" + time_taken(phase.seconds));
  return Denoising::done;
}

}  // namespace raytrace
