#include "raytrace/output/complete_picture.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <new>
#include <string_view>
#include <system_error>

#include "raytrace/output/exr_reader.h"
#include "raytrace/output/file_handle.h"
#include "raytrace/output/image_encoder.h"
#include "raytrace/output/openimageio_module.h"

namespace raytrace {

namespace {

constexpr const char* partial_mark = "raytrace:partial";
constexpr const char* light_paths_mark = "raytrace:lightPaths";

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

bool have(const Texts& texts, const Texts& wanted) {
  return std::all_of(wanted.begin(), wanted.end(),
                     [&](const auto& pair) { return has(texts, pair.first, pair.second); });
}

bool fit(const Texts& texts, const WantedPicture* wanted) {
  return has(texts, partial_mark, "") && (wanted == nullptr || have(texts, wanted->attributes));
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
    PictureExtent extent = wanted == nullptr ? PictureExtent{} : wanted->extent;
    if (wanted != nullptr && has(texts, light_paths_mark, "1")) extent.region = wanted->light_paths_extent;
    if (wanted != nullptr &&
        (picture.extent() != extent || !std::all_of(wanted->channels.begin(), wanted->channels.end(), has_channel)))
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
          picture->bits == wanted->bit_depth && have(picture->texts, wanted->view));
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

constexpr std::string_view signature("\x89PNG\r\n\x1a\n", 8);
constexpr std::uint32_t header_size = 13, checksum_size = 4;
constexpr std::uint32_t longest_text = 1U << 20U;  // ours are far shorter

std::uint32_t number(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + 4; ++i) value = value << 8U | static_cast<unsigned char>(bytes[i]);
  return value;
}

/// So many bytes; fewer where the file ends.
std::string read(std::FILE* file, std::size_t size) {
  std::string bytes(size, '\0');
  bytes.resize(std::fread(bytes.data(), 1, size, file));
  return bytes;
}

/// Of a tEXt chunk "keyword, 0, text"; of an iTXt chunk "keyword, 0, is compressed, method, language, 0, translated
/// keyword, 0, text".
void add_text(const std::string& type, const std::string& content, std::map<std::string, std::string>& texts) {
  std::size_t end = content.find('\0');
  if (end == std::string::npos) return;
  const std::string keyword = content.substr(0, end);
  if (type == "iTXt") {
    if (content.size() < end + 3 || content[end + 1] != 0) return;
    end = content.find('\0', end + 3);
    if (end != std::string::npos) end = content.find('\0', end + 1);
    if (end == std::string::npos) return;
  }
  texts[keyword] = content.substr(end + 1);
}

}  // namespace

bool is_complete_picture(const std::string& file) { return is_whole(file, nullptr); }

bool is_complete_picture(const std::string& file, const WantedPicture& wanted) { return is_whole(file, &wanted); }

std::optional<PngFile> read_png_file(const std::string& file) {
  const FileHandle stream(std::fopen(file.c_str(), "rb"));
  if (!stream || read(stream.get(), signature.size()) != signature) return std::nullopt;
  PngFile png;
  for (;;) {
    const std::string head = read(stream.get(), 8);
    if (head.size() < 8) return std::nullopt;
    std::uint64_t left = std::uint64_t{number(head, 0)} + checksum_size;
    const std::string type = head.substr(4);
    const bool is_header = type == "IHDR", is_text = type == "tEXt" || type == "iTXt";
    if (is_header != (png.width == 0) || (is_header && left != header_size + checksum_size)) return std::nullopt;
    if (is_header || (is_text && left < longest_text)) {
      const std::string content = read(stream.get(), left - checksum_size);
      if (content.size() < left - checksum_size) return std::nullopt;
      left = checksum_size;
      if (is_text) add_text(type, content, png.texts);
      if (is_header) {
        png.width = static_cast<int>(number(content, 0));
        png.height = static_cast<int>(number(content, 4));
        png.bits = static_cast<unsigned char>(content[8]);
        if (png.width <= 0 || png.height <= 0) return std::nullopt;
      }
    }
    if (type == "IEND") return read(stream.get(), left).size() == left ? std::optional(png) : std::nullopt;
    // Past what is not looked at; behind the file's end, the next head is not there.
    if (fseeko(stream.get(), static_cast<off_t>(left), SEEK_CUR) != 0) return std::nullopt;
  }
}

}  // namespace raytrace
