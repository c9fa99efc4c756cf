#include "raytrace/output/image_encoder.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "raytrace/output/exr_encoder.h"
#include "raytrace/output/openimageio_module.h"
#include "raytrace/output/png_encoder.h"

namespace raytrace {

namespace {

/// Standard output, pipes and devices, wherever they lead to.
bool is_stream(const std::string& file) {
  return file == "-" || file.starts_with("/dev/") || file.starts_with("/proc/") ||
         (std::filesystem::exists(file) && std::filesystem::is_other(file));
}

}  // namespace

std::string lower_extension(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::unique_ptr<ImageEncoder> make_image_encoder(const std::string& file, const ImageFileSettings& settings) {
  const std::string extension = lower_extension(file);
  if (extension.size() < 2) {
    if (is_stream(file))
      throw OutputError("cannot write " + file +
                        ": pictures appear whole or not at all, and so in files only; write to a file, and cat it");
    if (std::filesystem::is_directory(file))
      throw OutputError("cannot write " + file + ": it is a folder; name a file in it, such as " +
                        (std::filesystem::path(file) / "picture.exr").string());
    throw OutputError("cannot write " + file +
                      ": the name has no extension to tell the format; .exr and .png are usual");
  }
  if (extension == ".exr") return std::make_unique<ExrEncoder>(file, settings);
  if (extension == ".png") return std::make_unique<PngEncoder>(file, settings);
  return make_openimageio_encoder(file, extension, settings);
}

}  // namespace raytrace
