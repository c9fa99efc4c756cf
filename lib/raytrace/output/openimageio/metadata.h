// What a picture says about itself, in OpenImageIO's names.
#pragma once

#include <OpenImageIO/imageio.h>

#include <string>

#include "raytrace/output/image_file.h"

namespace raytrace {

/// Adds the metadata to an image of the format that OpenImageIO calls `oiio_name`: as text to PNG, which drops
/// numbers, and as one line of description to the rest, which keep only standard attributes. Throws OutputError if
/// SOURCE_DATE_EPOCH is not a time.
void add_metadata(OIIO::ImageSpec& spec, const std::string& oiio_name, const ImageMetadata& metadata);

}  // namespace raytrace
