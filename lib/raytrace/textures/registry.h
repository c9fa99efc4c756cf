// All textures. A new texture: its own pair of files, one include and one name here, and one
// include in kernels.h. (docs/how-to-add-a-type.md)
#pragma once

#include "raytrace/math/type_list.h"
#include "raytrace/textures/checker.h"
#include "raytrace/textures/image.h"
#include "raytrace/textures/noise.h"
#include "raytrace/textures/vertex_color.h"

namespace raytrace {

using Textures = TypeList<Image, Checker, Noise, VertexColor>;

}  // namespace raytrace
