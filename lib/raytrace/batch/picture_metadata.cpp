#include "raytrace/batch/picture_metadata.h"

#include <utility>

#include "raytrace/aovs/aov_selection.h"
#include "raytrace/output/denoiser.h"

namespace raytrace {

std::vector<ImageAttribute> denoised_attributes() {
  return {{denoised_name, 1}, {"raytrace:denoiser", denoiser_name()}};
}

ImageMetadata picture_metadata(const RenderJob& job, const SceneDescription& description, const PieceIdentity& identity,
                               const RenderStatistics& statistics, bool denoised) {
  ImageMetadata metadata;
  metadata.software = statistics.software;
  metadata.scene_file = statistics.scene_file;
  metadata.samples = static_cast<int>(identity.film.samples.count);
  metadata.seed = statistics.seed;
  metadata.threads = statistics.threads;
  metadata.camera = camera_matrices(description);
  metadata.attributes = identity_attributes(identity);
  metadata.data_attributes = aov_attributes(job.aovs, description);
  const auto add = [](std::vector<ImageAttribute>& attributes, std::vector<ImageAttribute> more) {
    for (ImageAttribute& attribute : more) attributes.push_back(std::move(attribute));
  };
  add(metadata.data_attributes, wished_view(view_settings(description.viewplane)));
  if (denoised) add(metadata.attributes, denoised_attributes());
  if (job.denoise && !denoised) add(metadata.data_attributes, {{denoise_name, 1}});
  return metadata;
}

}  // namespace raytrace
