// All formats but EXR and PNG come through OpenImageIO, which brings some 250 shared libraries: loading them takes
// longer than a small render. So what uses it is a module of its own (output/openimageio/), loaded when a picture asks
// for it.
#pragma once

#include <memory>
#include <string>

#include "raytrace/output/image_encoder.h"

namespace raytrace {

/// extension: in lower case, with its dot. Throws OutputError as make_image_encoder does, or if the module is missing.
std::unique_ptr<ImageEncoder> make_openimageio_encoder(const std::string& file, const std::string& extension,
                                                       const ImageFileSettings& settings);

/// The module's only symbol. The caller owns what it returns.
using MakeOpenImageIOEncoder = ImageEncoder*(const std::string& file, const std::string& extension,
                                             const ImageFileSettings& settings);
extern "C" MakeOpenImageIOEncoder raytrace_make_openimageio_encoder;

}  // namespace raytrace
