#include "raytrace/output/openimageio/metadata.h"

#include <sstream>

#include "raytrace/output/picture_date.h"

namespace raytrace {

namespace {

std::string matrix_text(const float (&matrix)[16]) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(9);  // every float survives
  for (int i = 0; i < 16; ++i) text << (i == 0 ? "" : " ") << matrix[i];
  return text.str();
}

template <class Value>
std::string text_of(const Value& value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << value;
  return text.str();
}

}  // namespace

void add_metadata(OIIO::ImageSpec& spec, const std::string& oiio_name, const ImageMetadata& metadata) {
  const PictureDate date = picture_date();
  spec.attribute("DateTime", date.text);
  if (!metadata.software.empty()) spec.attribute("Software", metadata.software);  // JPEG's IPTC aborts on empty text

  const std::string seed = std::to_string(metadata.seed);
  if (oiio_name == "png") {
    spec.attribute("worldToCamera", matrix_text(metadata.camera.world_to_camera));
    spec.attribute("worldToNDC", matrix_text(metadata.camera.world_to_ndc));
    spec.attribute("raytrace:scene", metadata.scene_file);
    spec.attribute("raytrace:samples", std::to_string(metadata.samples));
    spec.attribute("raytrace:seed", seed);
    if (!date.fixed) {
      spec.attribute("raytrace:threads", std::to_string(metadata.threads));
      if (metadata.render_seconds) spec.attribute("raytrace:renderSeconds", text_of(*metadata.render_seconds));
    }
    for (const ImageAttribute& attribute : metadata.attributes)
      spec.attribute(attribute.name, std::visit([](const auto& value) { return text_of(value); }, attribute.value));
  } else {
    std::string description =
        "scene " + metadata.scene_file + ", " + std::to_string(metadata.samples) + " samples a pixel, seed " + seed;
    for (const ImageAttribute& attribute : metadata.attributes)
      if (attribute.name == "raytrace:partial") description += ", partial";
    spec.attribute("ImageDescription", description);
  }
}

}  // namespace raytrace
