// All cameras. A new camera: its own pair of files, one include and one name here. (docs/how-to-add-a-type.md)
#pragma once

#include "raytrace/cameras/pinhole_camera.h"
#include "raytrace/math/type_list.h"

namespace raytrace {

using Cameras = TypeList<PinholeCamera>;

}  // namespace raytrace
