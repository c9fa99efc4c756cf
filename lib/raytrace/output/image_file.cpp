#include "raytrace/output/image_file.h"

#include <cerrno>
#include <system_error>

#include "raytrace/output/image_encoder.h"

namespace raytrace {

namespace {

FileHandle open_to_write(const AtomicFile& atomic, const std::string& file) {
  FileHandle handle(std::fopen(atomic.temporary_name().c_str(), "wb"));
  if (!handle) throw OutputError("cannot write " + file + ": " + std::generic_category().message(errno));
  return handle;
}

PictureExtent extent_of(const Film& film) { return {film.full_width(), film.full_height(), film.region()}; }

}  // namespace

bool holds_float(const std::string& file) {
  ImageFileSettings settings;
  settings.full_float = true;
  return make_image_encoder(file, settings)->holds_float();
}

void check_writable(const std::string& file, const ImageFileSettings& settings) {
  constexpr int edge = 64;  // JPEG 2000 takes none below 32
  const Film black(edge, edge, {0, 0, edge, edge});
  const FileHandle memory = open_memory_file();
  const std::unique_ptr<ImageEncoder> encoder = make_image_encoder(file, settings);
  encoder->begin(extent_of(black), {}, memory.get());
  encoder->write(black);
  encoder->finish();
  const AtomicFile made_and_removed(file);
}

ImageFile::ImageFile(const std::string& file, const PictureExtent& extent, const ImageMetadata& metadata,
                     const ImageFileSettings& settings)
    : atomic_(file), temporary_(open_to_write(atomic_, file)), encoder_(make_image_encoder(file, settings)) {
  encoder_->begin(extent, metadata, temporary_.get());
}

ImageFile::~ImageFile() = default;

void ImageFile::write(const Film& band) { encoder_->write(band); }

Repairs ImageFile::commit() {
  const Repairs repairs = encoder_->finish();
  encoder_.reset();
  temporary_.reset();
  atomic_.commit();
  return repairs;
}

Repairs write_image(const std::string& file, const Film& film, const ImageMetadata& metadata,
                    const ImageFileSettings& settings) {
  ImageFile image(file, extent_of(film), metadata, settings);
  image.write(film);
  return image.commit();
}

}  // namespace raytrace
