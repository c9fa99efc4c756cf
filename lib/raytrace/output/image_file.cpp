#include "raytrace/output/image_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "raytrace/output/image_encoder.h"
#include "raytrace/output/openimageio_module.h"

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
      throw FormatError("cannot write " + file +
                        ": pictures appear whole or not at all, and so in files only; write to a file, and cat it");
    if (std::filesystem::is_directory(file))
      throw FormatError("cannot write " + file + ": it is a folder; name a file in it, such as " +
                        (std::filesystem::path(file) / "picture.exr").string());
    throw FormatError("cannot write " + file +
                      ": the name has no extension that says which format it is; .exr and .png are usual");
  }
  if (extension == ".exr") return make_exr_encoder(file, settings);
  if (extension == ".png") return make_png_encoder(file, settings);
  return make_openimageio_encoder(file, extension, settings);
}

ImageFormat image_format(const std::string& file, const ImageFileSettings& settings) {
  return make_image_encoder(file, settings)->format();
}

void check_format(const std::string& file, const ImageFileSettings& settings) {
  constexpr int edge = 64;  // JPEG 2000 takes none below 32
  const PictureExtent extent{edge, edge, {0, 0, edge, edge}};
  const std::vector<Channel> channels = color_channels(settings.full_float);
  const ImageBand black{extent.region, {channels.size(), std::vector<float>(std::size_t{edge} * edge)}};
  const FileHandle memory = open_memory_file();
  const std::unique_ptr<ImageEncoder> encoder = make_image_encoder(file, settings);
  encoder->begin(extent, channels, {}, memory.get());
  encoder->write(black);
  encoder->finish();
}

void check_size(const std::string& file, const Region& region, const ImageFileSettings& settings) {
  make_image_encoder(file, settings)->check_size(region.width(), region.height());
}

ImageFile::ImageFile(const std::string& file, std::unique_ptr<ImageEncoder> encoder, const PictureExtent& extent,
                     const std::vector<Channel>& channels, const ImageMetadata& metadata)
    : atomic_(file), encoder_(std::move(encoder)) {
  encoder_->begin(extent, channels, metadata, atomic_.stream());
}

ImageFile::ImageFile(const std::string& file, const PictureExtent& extent, const std::vector<Channel>& channels,
                     const ImageMetadata& metadata, const ImageFileSettings& settings)
    : ImageFile(file, make_image_encoder(file, settings), extent, channels, metadata) {}

ImageFile::~ImageFile() = default;

void ImageFile::write(const ImageBand& band) { encoder_->write(band); }

void ImageFile::write(const Film& film) {
  const Region& region = film.region();
  ImageBand band;  // a few rows at a time, so that no second copy of the picture is needed
  for (int y0 = region.y0; y0 < region.y1; y0 = band.region.y1) {
    fill_color(band, film, y0, std::min(y0 + band_rows(region.width(), 4), region.y1));
    encoder_->write(band);
  }
}

Repairs ImageFile::commit() {
  const Repairs repairs = encoder_->finish();
  encoder_.reset();
  atomic_.commit();
  return repairs;
}

Repairs write_image(const std::string& file, const Film& film, const ImageMetadata& metadata,
                    const ImageFileSettings& settings) {
  ImageFile image(file, film.settings().extent, color_channels(settings.full_float), metadata, settings);
  image.write(film);
  return image.commit();
}

}  // namespace raytrace
