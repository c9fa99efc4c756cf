// What image files say about the camera, for programs that put other things into the picture.
#pragma once

namespace raytrace {

/// Row-major, for row vectors (p' = p M), as OpenEXR's standard attributes of these names want them.
struct CameraMatrices {
  float world_to_camera[16] = {};  ///< to camera space: x to the right, y up, looking along -z
  float world_to_ndc[16] = {};     ///< to the picture, after the divide: (0, 0) bottom left, (1, 1) top right
  bool is_projection = true;       ///< false: no matrix leads to the picture, and files have no world_to_ndc
};

}  // namespace raytrace
