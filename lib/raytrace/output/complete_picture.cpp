#include "raytrace/output/complete_picture.h"

#include <algorithm>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

#include "raytrace/output/exr_reader.h"
#include "raytrace/output/image_encoder.h"
#include "raytrace/output/openimageio_module.h"
#include "raytrace/output/png_file.h"

namespace raytrace {
namespace {

constexpr const char* partial_mark = "raytrace:partial";

std::string text_of(const ImageAttribute& attribute) {
  if (const auto* const text = std::get_if<std::string>(&attribute.value)) return *text;
  if (const auto* const number = std::get_if<int>(&attribute.value)) return std::to_string(*number);
  return std::to_string(std::get<float>(attribute.value));
}

using Texts = std::map<std::string, std::string>;

bool has(const Texts& texts, const std::string& name, const std::string& value) {
  const auto found = texts.find(name);
  return (found == texts.end() ? std::string() : found->second) == value;
}

bool fit(const Texts& texts, const WantedPicture* wanted) {
  return has(texts, partial_mark, "") &&
         (wanted == nullptr || std::all_of(wanted->attributes.begin(), wanted->attributes.end(),
                                           [&](const auto& pair) { return has(texts, pair.first, pair.second); }));
}

bool is_whole_exr(const std::string& file, const WantedPicture* wanted) {
  try {
    ExrReader picture(file);
    Texts texts;
    for (const ImageAttribute& attribute : picture.attributes()) texts[attribute.name] = text_of(attribute);
    const std::vector<Channel>& channels = picture.channels();
    const auto has_channel = [&](const Channel& channel) {
      return std::find(channels.begin(), channels.end(), channel) != channels.end();
    };
    if (!fit(texts, wanted)) return false;
    if (wanted != nullptr && (picture.extent() != wanted->extent ||
                              !std::all_of(wanted->channels.begin(), wanted->channels.end(), has_channel)))
      return false;
    const Region& region = picture.extent().region;
    picture.read({channels.front()}, region.y1 - 1, region.y1);  // throws where a copy was cut off
    return true;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    return false;
  }
}

bool is_whole_png(const std::string& file, const WantedPicture* wanted) {
  const auto picture = read_png_file(file);
  if (!picture || !fit(picture->texts, wanted)) return false;
  return wanted == nullptr ||
         (picture->width == wanted->extent.region.width() && picture->height == wanted->extent.region.height() &&
          picture->bits == wanted->bit_depth && has(picture->texts, exposure_keyword, exposure_text(wanted->exposure)));
}

bool is_whole(const std::string& file, const WantedPicture* wanted) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(file, unknown)) return false;
  const std::string extension = lower_extension(file);
  if (extension == ".exr") return is_whole_exr(file, wanted);
  if (extension == ".png") return is_whole_png(file, wanted);
  const Region region = wanted == nullptr ? Region() : wanted->extent.region;
  return openimageio_reads_all_of(file, region.width(), region.height());
}

}  // namespace

bool is_complete_picture(const std::string& file) { return is_whole(file, nullptr); }

bool is_complete_picture(const std::string& file, const WantedPicture& wanted) { return is_whole(file, &wanted); }

}  // namespace raytrace
