// All integrators. A new integrator: its own pair of files, one include and one name here, one include in kernels.h.
// (docs/how-to-add-a-type.md)
#pragma once

#include "raytrace/integrators/raycast.h"
#include "raytrace/math/type_list.h"

namespace raytrace {

using Integrators = TypeList<Raycast>;

}  // namespace raytrace
