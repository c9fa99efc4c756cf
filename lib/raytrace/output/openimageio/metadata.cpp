#include "raytrace/output/openimageio/metadata.h"

#include <sstream>

#include "raytrace/output/picture_date.h"

namespace raytrace {

void add_metadata(OIIO::ImageSpec& spec, const ImageMetadata& metadata, double exposure) {
  spec.attribute("DateTime", picture_date().text);
  if (!metadata.software.empty()) spec.attribute("Software", metadata.software);  // JPEG's IPTC aborts on empty text
  std::ostringstream description;
  description.imbue(std::locale::classic());
  description << "scene " << metadata.scene_file << ", " << metadata.samples << " samples a pixel, seed "
              << metadata.seed;
  if (exposure != 0) description << ", exposure " << exposure;
  for (const ImageAttribute& attribute : metadata.attributes)
    if (attribute.name == "raytrace:partial") description << ", partial";
  spec.attribute("ImageDescription", description.str());
}

}  // namespace raytrace
