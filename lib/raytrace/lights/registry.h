// All lights. A new light: its own pair of files, one include and one name here. (docs/how-to-add-a-type.md)
#pragma once

#include "raytrace/lights/ambient_light.h"
#include "raytrace/lights/directional_light.h"
#include "raytrace/lights/point_light.h"
#include "raytrace/math/type_list.h"

namespace raytrace {

using Lights = TypeList<AmbientLight, PointLight, DirectionalLight>;

}  // namespace raytrace
