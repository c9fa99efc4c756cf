// All cameras. A new camera: its own pair of files, one include and one name here, and one
// include in kernels.h. (docs/how-to-add-a-type.md)
#pragma once

#include "raytrace/cameras/fisheye_camera.h"
#include "raytrace/cameras/orthographic_camera.h"
#include "raytrace/cameras/pinhole_camera.h"
#include "raytrace/cameras/spherical_camera.h"
#include "raytrace/cameras/thin_lens_camera.h"
#include "raytrace/math/type_list.h"

namespace raytrace {

using Cameras = TypeList<PinholeCamera, OrthographicCamera, ThinLensCamera, FisheyeCamera, SphericalCamera>;

}  // namespace raytrace
