// What a picture says about itself, in OpenImageIO's names.
#pragma once

#include <OpenImageIO/imageio.h>

#include "raytrace/output/image_file.h"

namespace raytrace {

/// Adds the metadata as standard attributes, which are all that these formats keep: one line of description holds most
/// of it. exposure: of a picture for display, else 0. Throws OutputError if SOURCE_DATE_EPOCH is not a time.
void add_metadata(OIIO::ImageSpec& spec, const ImageMetadata& metadata, double exposure);

}  // namespace raytrace
