#include "raytrace/output/image_file.h"

#include <cerrno>
#include <system_error>

#include "raytrace/output/atomic_file.h"
#include "raytrace/output/image_encoder.h"

namespace raytrace {

bool holds_float(const std::string& file) {
  ImageFileSettings settings;
  settings.full_float = true;
  return ImageEncoder(file, settings).pixel_format().type == OIIO::TypeFloat;
}

void check_writable(const std::string& file, const ImageFileSettings& settings) {
  constexpr int edge = 64;  // JPEG 2000 takes none below 32
  const Film black(edge, edge, {0, 0, edge, edge});
  ImageEncoder(file, settings).encode(black, {}, open_memory_file().get());
  const AtomicFile made_and_removed(file);
}

Repairs write_image(const std::string& file, const Film& film, const ImageMetadata& metadata,
                    const ImageFileSettings& settings) {
  ImageEncoder encoder(file, settings);
  AtomicFile atomic(file);
  FileHandle temporary(std::fopen(atomic.temporary_name().c_str(), "wb"));
  if (!temporary) throw OutputError("cannot write " + file + ": " + std::generic_category().message(errno));
  const Repairs repairs = encoder.encode(film, metadata, temporary.get());
  temporary.reset();
  atomic.commit();
  return repairs;
}

}  // namespace raytrace
