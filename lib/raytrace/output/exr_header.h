// What is checked of an EXR file's header before OpenEXR reads it and takes the memory that the header asks for.
#pragma once

#include <cstdio>

#include "raytrace/film/film.h"

namespace raytrace {

/// Reads the header, from the file's beginning: a single part of scan lines, no attribute or channel twice, each
/// attribute within the file, and windows that this program could have rendered, which are the result. Throws
/// InputError, whose text does not name the file.
PictureExtent check_exr_header(std::FILE* file);

}  // namespace raytrace
