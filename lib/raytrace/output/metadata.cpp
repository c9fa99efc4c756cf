#include "raytrace/output/metadata.h"

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <optional>
#include <sstream>

namespace raytrace {

namespace {

/// The time that the environment asks to be written instead of now:
/// https://reproducible-builds.org/specs/source-date-epoch
std::optional<std::time_t> source_date_epoch() {
  const char* const text = std::getenv("SOURCE_DATE_EPOCH");
  if (text == nullptr) return std::nullopt;
  const char* const end = text + std::strlen(text);
  constexpr std::time_t year_10000 = 253402300800;  // dates have four digits for the year
  std::time_t seconds = 0;
  const auto [stop, error] = std::from_chars(text, end, seconds);
  if (error != std::errc() || stop != end || seconds < 0 || seconds >= year_10000) {
    throw OutputError("the environment's SOURCE_DATE_EPOCH is '" + std::string(text) +
                      "': it must be a number of seconds since 1970");
  }
  return seconds;
}

/// The form of EXR's capDate and of TIFF's and PNG's DateTime.
std::string date_text(std::time_t time) {
  std::tm utc{};
  gmtime_r(&time, &utc);
  char text[sizeof "2026:01:31 23:59:59"];
  std::strftime(text, sizeof text, "%Y:%m:%d %H:%M:%S", &utc);
  return text;
}

std::string matrix_text(const float (&matrix)[16]) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(9);  // every float survives
  for (int i = 0; i < 16; ++i) text << (i == 0 ? "" : " ") << matrix[i];
  return text.str();
}

std::string seconds_text(double seconds) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << seconds;
  return text.str();
}

}  // namespace

void add_metadata(OIIO::ImageSpec& spec, const std::string& oiio_name, const ImageMetadata& metadata) {
  const std::optional<std::time_t> fixed_date = source_date_epoch();
  spec.attribute("DateTime", date_text(fixed_date.value_or(std::time(nullptr))));
  if (!metadata.software.empty()) spec.attribute("Software", metadata.software);  // JPEG's IPTC aborts on empty text

  // Text everywhere: neither EXR nor PNG has integers of 64 bit.
  const std::string seed = std::to_string(metadata.seed);
  if (oiio_name == "openexr") {
    spec.attribute("utcOffset", 0.0F);
    constexpr float rec709[8] = {0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F};
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), rec709);
    spec.attribute("worldToCamera", OIIO::TypeMatrix, metadata.camera.world_to_camera);
    spec.attribute("worldToNDC", OIIO::TypeMatrix, metadata.camera.world_to_ndc);
    spec.attribute("raytrace:scene", metadata.scene_file);
    spec.attribute("raytrace:samples", metadata.samples);
    spec.attribute("raytrace:seed", seed);
    if (!fixed_date) {
      spec.attribute("raytrace:threads", metadata.threads);
      spec.attribute("raytrace:renderSeconds", static_cast<float>(metadata.render_seconds));
    }
  } else if (oiio_name == "png") {
    spec.attribute("worldToCamera", matrix_text(metadata.camera.world_to_camera));
    spec.attribute("worldToNDC", matrix_text(metadata.camera.world_to_ndc));
    spec.attribute("raytrace:scene", metadata.scene_file);
    spec.attribute("raytrace:samples", std::to_string(metadata.samples));
    spec.attribute("raytrace:seed", seed);
    if (!fixed_date) {
      spec.attribute("raytrace:threads", std::to_string(metadata.threads));
      spec.attribute("raytrace:renderSeconds", seconds_text(metadata.render_seconds));
    }
  } else {
    spec.attribute("ImageDescription", "scene " + metadata.scene_file + ", " + std::to_string(metadata.samples) +
                                           " samples a pixel, seed " + seed);
  }
}

}  // namespace raytrace
