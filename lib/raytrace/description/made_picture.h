// Pictures that follow from others of a model.
#pragma once

#include <memory>

#include "raytrace/import/specular_glossiness.h"
#include "raytrace/output/picture.h"

namespace raytrace {

/// As wide as the wider one of those that it is made of, and as high as the higher one; between the pixels of the
/// smaller one. `from` stays for as long as the reader does. Throws as open_picture().
std::unique_ptr<PictureReader> open_made_picture(const SpecularGlossiness& from);

}  // namespace raytrace
