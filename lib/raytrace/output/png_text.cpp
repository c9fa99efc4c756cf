#include "raytrace/output/png_text.h"

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

std::vector<PngText> png_texts(const ImageMetadata& metadata, const ImageFileSettings& settings) {
  std::vector<PngText> all;
  if (!metadata.software.empty()) all.push_back({"Software", metadata.software});
  all.push_back({"worldToCamera", matrix_text(metadata.camera.world_to_camera)});
  all.push_back({"worldToNDC", matrix_text(metadata.camera.world_to_ndc)});
  all.push_back({"raytrace:scene", metadata.scene_file});
  all.push_back({"raytrace:samples", std::to_string(metadata.samples)});
  all.push_back({"raytrace:seed", std::to_string(metadata.seed)});
  if (!picture_date().fixed) {
    all.push_back({"raytrace:threads", std::to_string(metadata.threads)});
    if (metadata.render_seconds) all.push_back({"raytrace:renderSeconds", text_of(*metadata.render_seconds)});
  }
  if (settings.exposure != 0) all.push_back({exposure_keyword, exposure_text(settings.exposure)});
  for (const ImageAttribute& attribute : metadata.attributes)
    all.push_back({attribute.name, std::visit([](const auto& value) { return text_of(value); }, attribute.value)});
  return all;
}

std::string exposure_text(double exposure) { return exposure == 0 ? std::string() : text_of(exposure); }

}  // namespace raytrace
