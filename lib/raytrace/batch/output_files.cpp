#include "raytrace/batch/output_files.h"

#include <algorithm>
#include <filesystem>

#include "raytrace/aovs/aov_selection.h"
#include "raytrace/batch/denoise.h"
#include "raytrace/batch/provenance.h"
#include "raytrace/batch/settings_error.h"
#include "raytrace/description/scene_description.h"
#include "raytrace/output/atomic_file.h"
#include "raytrace/output/complete_picture.h"
#include "raytrace/output/image_band.h"
#include "raytrace/output/pixel_format.h"
#include "raytrace/text/message.h"

namespace raytrace {

void check_output_settings(const RenderJob& job) {
  const std::vector<std::string>& files = job.outputs;
  const ImageFileSettings settings = job.image_file_settings();
  for (const std::string& file : files) check_format(file, settings);
  const auto none = [&](bool ImageFormat::* ability) {
    return std::none_of(files.begin(), files.end(),
                        [&](const std::string& file) { return image_format(file, settings).*ability; });
  };
  if (job.full_float && none(&ImageFormat::floats))
    throw SettingsError("--float: none of the outputs can hold floats; .exr and .tif can");
  if (job.transparent && none(&ImageFormat::alpha))
    throw SettingsError("--transparent: none of the outputs can hold alpha; .exr, .png and .tif can");
  ViewOptions view = job.view;
  if (job.tile || job.crop || job.sample_offset)
    view = {{}, {}, false, {}, job.view.dither, job.view.ocio};  // the merge shows them
  refuse_useless_view(files, settings, view);
  if (!job.aovs.empty() && none(&ImageFormat::data))
    throw SettingsError("--aov: none of the outputs can hold more than colour; .exr can");
  if (!job.checkpoint.empty() && !job.resume && std::filesystem::exists(job.checkpoint))
    throw SettingsError("--checkpoint: there is a " + job.checkpoint +
                        " already; --resume goes on from it, or remove it");
}

void check_outputs(const RenderJob& job) {
  if (job.outputs.empty()) throw SettingsError("--output: none is given; a picture needs a file");
  check_output_settings(job);
  if (is_denoised(job)) denoiser_name();  // throws if there is no denoiser
  for (const std::string& file : job.files()) {
    const AtomicFile made_and_removed(file);
  }
}

bool any_for_display(const std::vector<std::string>& files, const ImageFileSettings& settings) {
  return std::any_of(files.begin(), files.end(),
                     [&](const std::string& file) { return image_format(file, settings).for_display; });
}

void refuse_useless_view(const std::vector<std::string>& files, const ImageFileSettings& settings,
                         const ViewOptions& view) {
  const std::string option = view.first_given();
  if (!option.empty() && !any_for_display(files, settings))
    throw SettingsError(option +
                        ": all outputs hold linear colour, which it does not change; .png, .jpg and .tif (without "
                        "--float) are sRGB-encoded");
}

void refuse_useless_tile(const RenderJob& job, const ViewPlane& viewplane, bool light_paths_of_others) {
  for (const std::string& file : job.outputs) {
    const ImageFormat format = image_format(file, job.image_file_settings());
    if (light_paths_of_others && !format.data)
      throw SettingsError("--tile: " + file +
                          ": the scene's light paths (<caustics>) reach all tiles; write EXR files and merge them");
    if (job.denoise && !is_denoised(job) && !format.data)
      throw SettingsError("--denoise: " + file +
                          ": a picture is denoised as a whole; write EXR files of its parts and merge them");
    if (job.tile && viewplane.autoexposure && format.for_display)
      throw SettingsError(
          "--tile: " + file +
          ": the whole picture's brightness says how it is exposed; write EXR files and merge them, or say it "
          "with --exposure");
  }
}

void set_view(ImageFileSettings& settings, const ViewSettings& view, double found) {
  settings.view_transform = view.transform;
  settings.exposure = view.exposure;
  settings.white_balance = view.white_balance;
  if (!view.auto_exposure) return;
  settings.auto_exposure = view.exposure;
  settings.exposure += found;
}

bool may_be_skipped(const RenderJob& job) {
  const auto exists = [](const std::string& file) { return std::filesystem::exists(file); };
  return job.skip_existing && !job.outputs.empty() && (job.checkpoint.empty() || !exists(job.checkpoint)) &&
         std::all_of(job.outputs.begin(), job.outputs.end(), exists);
}

bool outputs_are_complete(const RenderJob& job, const SceneDescription& description) {
  PieceIdentity identity;
  identity.provenance.scene = scene_hash(description, job.threads);
  identity.whole = crop_window(description.viewplane, job);
  identity.film.seed = job.seed;
  identity.film.transparent = job.transparent;
  identity.film.extent = {description.viewplane.hres, description.viewplane.vres, render_window(identity.whole, job)};
  identity.film.samples = sample_range(description.viewplane, job);
  WantedPicture wanted;
  wanted.extent = identity.film.extent;
  wanted.light_paths_extent = identity.whole;
  wanted.channels = color_channels(job.full_float);
  for (Channel& channel : aov_channels(film_aovs(job))) wanted.channels.push_back(std::move(channel));
  if (job.sample_offset)
    for (Channel& channel : sum_channels()) wanted.channels.push_back(std::move(channel));
  wanted.bit_depth = job.bit_depth;
  const ViewSettings view = view_settings(description.viewplane);
  ImageFileSettings settings = job.image_file_settings();
  set_view(settings, view, 0);
  for (const char* const keyword : {view_transform_keyword, ocio_keyword, exposure_keyword, auto_exposure_keyword,
                                    white_balance_keyword, dither_keyword})
    wanted.view[keyword];
  for (const ImageAttribute& attribute : view_attributes(settings))
    wanted.view[attribute.name] = std::get<std::string>(attribute.value);
  if (view.auto_exposure) wanted.view.erase(exposure_keyword);  // which only the picture knows
  wanted.attributes = picture_attributes(identity, job.time_limit || job.error_limit);
  wanted.attributes[denoised_name] = is_denoised(job) ? "1" : "";
  return std::all_of(job.outputs.begin(), job.outputs.end(),
                     [&](const std::string& file) { return is_complete_picture(file, wanted); });
}

std::vector<std::string> warnings_of(const Repairs& repairs, const std::string& file) {
  std::vector<std::string> warnings;
  const auto add = [&](std::uint64_t count, const char* thing, const char* what) {
    if (count > 0) warnings.push_back(file + ": " + counted(count, thing) + what);
  };
  add(repairs.clamped, "value", " beyond what the format holds became its largest; in EXR, --float keeps them");
  add(repairs.not_finite, "value", " not finite; NaN became 0");
  add(repairs.negative, "pixel", " with radiance below 0, which became 0; EXR keeps it");
  return warnings;
}

/// Whether the action could be done; its error is reported.
template <class Action>
bool OutputFiles::succeeds(const Action& action) const {
  try {
    action();
    return true;
  } catch (const OutputError& error) {
    observer_.on_message(MessageLevel::error, error.what());
    return false;
  }
}

OutputFiles::OutputFiles(const RenderJob& job, const std::vector<std::string>& files, const ImageFileSettings& settings,
                         const PictureExtent& extent, const ImageMetadata& metadata, std::vector<Channel> sums,
                         const DenoisedPicture* denoised, RenderObserver& observer)
    : job_(job),
      observer_(observer),
      denoised_(denoised),
      sums_(std::move(sums)),
      channels_(color_channels(job.full_float)) {
  const auto add = [&](const std::vector<Channel>& more) {
    channels_.insert(channels_.end(), more.begin(), more.end());
  };
  add(aov_channels(film_aovs(job)));
  if (denoised_ != nullptr) add(noisy_channels(channels_, job.transparent));
  add(sums_);
  for (const std::string& name : files) {
    succeeds(
        [&] { files_.push_back({name, std::make_unique<ImageFile>(name, extent, channels_, metadata, settings)}); });
  }
}

bool OutputFiles::write(const Film& film) {
  const Region& region = film.region();
  ImageBand band;  // a few rows at a time, so that no second copy of the picture is needed
  for (int y0 = region.y0; y0 < region.y1 && !files_.empty(); y0 = band.region.y1) {
    band.planes.resize(std::min(band.planes.size(), ImageBand::colors));
    fill_color(band, film, y0, std::min(y0 + band_rows(region.width(), channels_.size()), region.y1), job_.threads);
    fill_aovs(band, ImageBand::colors, film);
    if (denoised_ != nullptr) denoised_->put_into(band);
    if (!sums_.empty()) append_sums(band, sums_, film);
    std::erase_if(files_, [&](File& file) { return !succeeds([&] { file.image->write(band); }); });
  }
  return !files_.empty();
}

std::vector<std::string> OutputFiles::commit() {
  std::vector<std::string> written;
  for (File& file : files_) {
    succeeds([&] {
      const Repairs repairs = file.image->commit();
      written.push_back(file.name);
      for (const std::string& warning : warnings_of(repairs, file.name))
        observer_.on_message(MessageLevel::warning, warning);
      observer_.on_message(MessageLevel::step, "wrote " + file.name);
    });
  }
  return written;
}

}  // namespace raytrace
