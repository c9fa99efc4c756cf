// All formats but EXR and PNG, and JPEG to read, come through OpenImageIO, which brings some 250 shared libraries:
// loading them takes longer than a small render. So what uses it is a module of its own (output/openimageio/), loaded
// when a picture asks for it.
#pragma once

#include <memory>
#include <string>

#include "raytrace/import/grid_tiles.h"
#include "raytrace/output/color_transform.h"
#include "raytrace/output/image_encoder.h"
#include "raytrace/output/picture.h"

namespace raytrace {

/// extension: in lower case, with its dot. Throws OutputError as make_image_encoder does, or if the module is missing.
std::unique_ptr<ImageEncoder> make_openimageio_encoder(const std::string& file, const std::string& extension,
                                                       const ImageFileSettings& settings);

/// From linear Rec. 709 to the settings' display and view; null if they have no configuration. Throws OutputError if
/// there are no such things, or if the module is missing.
std::shared_ptr<const ColorTransform> ocio_transform(const OcioSettings& settings);

/// As open_picture() has it. bytes: of the file, which has no more than a name then; empty: it is read. Throws
/// OutputError if the module is missing.
std::unique_ptr<PictureReader> make_openimageio_reader(const std::string& file, std::string_view bytes);

/// Whether the file is a picture that OpenImageIO can read from its first row to its last, of this size; 0 x 0: of any.
/// Throws OutputError if the module is missing.
bool openimageio_reads_all_of(const std::string& file, int width, int height);

/// A grid of an OpenVDB file; name: empty for "density", or else the first. Throws GridError, or OutputError if the
/// module is missing.
GridTiles read_vdb_tiles(const std::string& file, const std::string& name);

/// The module's symbols. The caller owns the encoder.
using MakeOpenImageIOEncoder = ImageEncoder*(const std::string& file, const std::string& extension,
                                             const ImageFileSettings& settings);
extern "C" MakeOpenImageIOEncoder raytrace_make_openimageio_encoder;
using OpenImageIOColorTransform = void(const OcioSettings& settings, std::shared_ptr<const ColorTransform>& transform);
extern "C" OpenImageIOColorTransform raytrace_openimageio_color_transform;
using OpenImageIOReadsAllOf = bool(const std::string& file, int width, int height);
extern "C" OpenImageIOReadsAllOf raytrace_openimageio_reads_all_of;
using MakeOpenImageIOReader = void(const std::string& file, std::string_view bytes,
                                   std::unique_ptr<PictureReader>& reader);
extern "C" MakeOpenImageIOReader raytrace_make_openimageio_reader;
using ReadOpenImageIOGrid = void(const std::string& file, const std::string& name, GridTiles& grid);
extern "C" ReadOpenImageIOGrid raytrace_read_grid;

}  // namespace raytrace
