#include "raytrace/output/png_file.h"

#include <cstdint>
#include <sstream>
#include <string_view>

#include "raytrace/output/file_handle.h"

namespace raytrace {

namespace {

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

std::string exposure_text(double exposure) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  if (exposure != 0) text << exposure;
  return text.str();
}

}  // namespace raytrace
