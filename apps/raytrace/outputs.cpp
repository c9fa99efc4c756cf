#include "outputs.h"

#include <algorithm>

#include "messages.h"
#include "raytrace/aovs/aov_selection.h"
#include "raytrace/output/film_channels.h"

namespace raytrace {

namespace {

void log_repairs(const std::string& file, const Repairs& repairs) {
  if (repairs.clamped > 0) {
    log_warning(file + ": " + counted(repairs.clamped, "value") +
                " beyond what the format holds became its largest; in EXR, --float keeps them");
  }
  if (repairs.not_finite > 0) {
    log_warning(file + ": " + counted(repairs.not_finite, "value") + " not finite; NaN became 0");
  }
}

/// Whether the action could be done; its error is told.
template <class Action>
bool succeeds(const Action& action) {
  try {
    action();
    return true;
  } catch (const OutputError& error) {
    log_error(error.what());
    return false;
  }
}

}  // namespace

void refuse_useless_exposure(const std::vector<std::string>& files, const ImageFileSettings& settings) {
  const auto uses_it = [&](const std::string& file) { return is_for_display(file, settings); };
  if (std::none_of(files.begin(), files.end(), uses_it))
    throw UsageError(
        "--exposure: all outputs hold linear colour, which it does not change; .png, .jpg and .tif (without "
        "--float) are sRGB-encoded");
}

Outputs::Outputs(const Options& options, const std::vector<std::string>& files, const PictureExtent& extent,
                 const ImageMetadata& metadata, std::vector<Channel> sums)
    : options_(options),
      wanted_files_(files.size()),
      sums_(std::move(sums)),
      channels_(color_channels(options.full_float)) {
  const std::vector<Channel> aovs = aov_channels(options_.aovs);
  channels_.insert(channels_.end(), aovs.begin(), aovs.end());
  channels_.insert(channels_.end(), sums_.begin(), sums_.end());
  for (const std::string& name : files) {
    succeeds([&] {
      files_.push_back(
          {name, std::make_unique<ImageFile>(name, extent, channels_, metadata, options_.image_file_settings())});
    });
  }
}

bool Outputs::write(const Film& film, Statistics& statistics) {
  const PhaseTimer timer(statistics.phases.write);
  const Region& region = film.region();
  ImageBand band;  // a few rows at a time, so that no second copy of the picture is needed
  for (int y0 = region.y0; y0 < region.y1 && !files_.empty(); y0 = band.region.y1) {
    band.planes.resize(std::min(band.planes.size(), ImageBand::colors));
    fill_color(band, film, y0, std::min(y0 + band_rows(region.width(), channels_.size()), region.y1), options_.threads);
    fill_aovs(band, ImageBand::colors, film);
    if (!sums_.empty()) append_sums(band, sums_, film);
    std::erase_if(files_, [&](File& file) { return !succeeds([&] { file.image->write(band); }); });
  }
  return !files_.empty();
}

bool Outputs::commit(Statistics& statistics) {
  const PhaseTimer timer(statistics.phases.write);
  statistics.outputs.clear();
  for (File& file : files_) {
    succeeds([&] {
      const Repairs repairs = file.image->commit();
      statistics.outputs.push_back(file.name);
      log_repairs(file.name, repairs);
      log_step("wrote " + file.name);
    });
  }
  return statistics.outputs.size() == wanted_files_;
}

}  // namespace raytrace
