// What the files of a render say about the picture.
#pragma once

#include "raytrace/batch/provenance.h"
#include "raytrace/batch/render_job.h"
#include "raytrace/batch/render_statistics.h"
#include "raytrace/output/image_file.h"

namespace raytrace {

/// Of the job's picture, or of a piece of it; but for the time that it took. denoised: whether its colours are.
ImageMetadata picture_metadata(const RenderJob& job, const SceneDescription& description, const PieceIdentity& identity,
                               const RenderStatistics& statistics, bool denoised);

/// What a file of a picture without noise says of that: by what. Throws OutputError as denoiser_name() does.
std::vector<ImageAttribute> denoised_attributes();

}  // namespace raytrace
