// Whether a file that OpenImageIO wrote is still whole.
#include <OpenImageIO/imageio.h>

#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "raytrace/film/region.h"
#include "raytrace/output/file_handle.h"
#include "raytrace/output/openimageio_module.h"

namespace raytrace {

namespace {

/// Whether the file ends as those of its format do. Readers make up what is missing of some.
bool has_its_end(const std::string& file, const std::string& format) {
  static const std::map<std::string, std::string> ends = {
      {"gif", ";"}, {"jpeg", "\xff\xd9"}, {"targa", std::string("TRUEVISION-XFILE.\0", 18)}};
  const auto end = ends.find(format);
  if (end == ends.end()) return true;
  const FileHandle stream(std::fopen(file.c_str(), "rb"));
  std::string bytes(end->second.size(), '\0');
  return stream && std::fseek(stream.get(), -static_cast<long>(bytes.size()), SEEK_END) == 0 &&
         std::fread(bytes.data(), 1, bytes.size(), stream.get()) == bytes.size() && bytes == end->second;
}

}  // namespace

bool raytrace_openimageio_reads_all_of(const std::string& file, int width, int height) {
  const auto picture = OIIO::ImageInput::create(file);
  OIIO::geterror();  // the answer is enough
  OIIO::ImageSpec spec;
  if (!picture || picture->format_name() == std::string("ico") || !picture->open(file, spec)) return false;
  const std::string format = picture->format_name();
  if (!is_allowed_size(spec.width, spec.height) || (width > 0 && (spec.width != width || spec.height != height)))
    return false;
  // The date is what TIFF files of ours have last.
  if (format == "tiff" && spec.get_string_attribute("DateTime").empty()) return false;
  std::vector<float> row(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.nchannels));
  // The last row; and the first, which some formats have at their end.
  const bool read = picture->read_scanline(spec.y, 0, OIIO::TypeFloat, row.data()) &&
                    picture->read_scanline(spec.y + spec.height - 1, 0, OIIO::TypeFloat, row.data());
  return read && !picture->has_error() && has_its_end(file, format);
}

}  // namespace raytrace
