#include "outputs.h"

#include "messages.h"

namespace raytrace {

namespace {

void tell_repairs(const std::string& file, const Repairs& repairs) {
  if (repairs.clamped > 0) {
    tell_warning(file + ": " + counted(repairs.clamped, "value") +
                 " beyond what the format holds became its largest; in EXR, --float keeps them");
  }
  if (repairs.not_finite > 0) {
    tell_warning(file + ": " + counted(repairs.not_finite, "value") + " not finite; NaN became 0");
  }
}

/// Whether the action could be done; its error is told.
template <class Action>
bool succeeds(const Action& action) {
  try {
    action();
    return true;
  } catch (const OutputError& error) {
    tell_error(error.what());
    return false;
  }
}

}  // namespace

void Outputs::begin(const Film& first_band, const Statistics& statistics) {
  ImageMetadata metadata;
  metadata.software = statistics.software;
  metadata.scene_file = statistics.scene_file;
  metadata.samples = statistics.samples;
  metadata.seed = statistics.seed;
  metadata.threads = statistics.threads;
  if (first_band.region() == extent_.region) metadata.render_seconds = statistics.seconds.render;
  metadata.camera = camera_;
  for (const std::string& name : options_.outputs) {
    succeeds([&] {
      files_.push_back({name, std::make_unique<ImageFile>(name, extent_, metadata, options_.image_file_settings())});
    });
  }
  begun_ = true;
}

bool Outputs::write(const Film& band, Statistics& statistics) {
  const PhaseTimer timer(statistics.seconds.write);
  if (!begun_) begin(band, statistics);
  std::erase_if(files_, [&](File& file) { return !succeeds([&] { file.image->write(band); }); });
  return !files_.empty();
}

bool Outputs::commit(Statistics& statistics) {
  const PhaseTimer timer(statistics.seconds.write);
  for (File& file : files_) {
    succeeds([&] {
      const Repairs repairs = file.image->commit();
      statistics.outputs.push_back(file.name);
      tell_repairs(file.name, repairs);
      tell_step("wrote " + file.name);
    });
  }
  return statistics.outputs.size() == options_.outputs.size();
}

}  // namespace raytrace
