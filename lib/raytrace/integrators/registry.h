// All integrators, by their parameters: tracing/ has their kernels, since these need the whole scene, and descriptions
// need these. A new integrator: its own pair of files, one include and one name here, and one include in
// tracing/kernels.h. (docs/how-to-add-a-type.md)
#pragma once

#include "raytrace/integrators/albedo.h"
#include "raytrace/integrators/ambient_occlusion.h"
#include "raytrace/integrators/normals.h"
#include "raytrace/integrators/path.h"
#include "raytrace/integrators/raycast.h"
#include "raytrace/integrators/uv.h"
#include "raytrace/math/type_list.h"

namespace raytrace {

using Integrators = TypeList<Raycast, Normals, Path, AmbientOcclusion, Uv, Albedo>;

}  // namespace raytrace
