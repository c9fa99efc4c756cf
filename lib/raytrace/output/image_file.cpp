#include "raytrace/output/image_file.h"

#include <algorithm>

#include "raytrace/output/image_encoder.h"

namespace raytrace {

bool holds_float(const std::string& file) {
  ImageFileSettings settings;
  settings.full_float = true;
  return make_image_encoder(file, settings)->holds_float();
}

bool holds_halves(const std::string& file, const ImageFileSettings& settings) {
  const auto encoder = make_image_encoder(file, settings);
  return encoder->holds_data() && !encoder->holds_float();
}

bool holds_data(const std::string& file) { return make_image_encoder(file, {})->holds_data(); }

bool holds_alpha(const std::string& file) { return make_image_encoder(file, {})->holds_alpha(); }

bool is_for_display(const std::string& file, const ImageFileSettings& settings) {
  return make_image_encoder(file, settings)->is_for_display();
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

void check_writable(const std::string& file, const ImageFileSettings& settings) {
  check_format(file, settings);
  const AtomicFile made_and_removed(file);
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

ImageFile::ImageFile(const std::string& file, const PictureExtent& extent, const ImageMetadata& metadata,
                     const ImageFileSettings& settings)
    : ImageFile(file, extent, color_channels(settings.full_float), metadata, settings) {}

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
  ImageFile image(file, film.settings().extent, metadata, settings);
  image.write(film);
  return image.commit();
}

}  // namespace raytrace
