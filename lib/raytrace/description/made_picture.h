// Pictures that follow from others of a model.
#pragma once

#include <memory>
#include <string>

#include "raytrace/import/specular_glossiness.h"
#include "raytrace/output/picture.h"
#include "raytrace/text/message.h"

namespace raytrace {

/// f(), whose PictureErrors become those of that one of the pictures.
template <class Function>
auto naming(const SpecularGlossiness::Source& source, const Function& f) {
  try {
    return f();
  } catch (const PictureError& error) {
    throw PictureError("it is made of " + in_quotes(source.file) + ": " + error.what());
  }
}

/// As wide as the wider one of those that it is made of, and as high as the higher one; between the pixels of the
/// smaller one. `from` stays for as long as the reader does. Throws as open_picture().
std::unique_ptr<PictureReader> open_made_picture(const SpecularGlossiness& from);

}  // namespace raytrace
