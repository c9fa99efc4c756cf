// Normal maps among pictures that may be maps of heights as well.
#pragma once

#include <string>

#include "raytrace/textures/texel_image.h"

namespace raytrace {

/// Whether its colours are those of normals, which point up on the whole: their blue is more than their red and their
/// green; of halves, that they are no greys. A picture that cannot be read counts as one.
bool holds_normals(const std::string& file);

/// Whether it is a grey picture, as heights are, which are often taken for normals. Some of its texels are looked at.
bool is_grey(const TexelImage& image);

}  // namespace raytrace
