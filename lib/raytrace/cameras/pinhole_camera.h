// Pinhole camera (Suffern, chapter 9).
//
//   <camera>
//     <eye x="0" y="2" z="10"/> <lookat x="0" y="0" z="0"/> <up x="0" y="1" z="0"/> <viewdistance>500</viewdistance>
//   </camera>
//
// In place of viewdistance, <fov>40</fov> is the vertical angle of view in degrees. <shift x="0" y="0.2"/> moves the
// picture on the view plane, as the lens of an architect's camera does.
#pragma once

#include "raytrace/cameras/view_frame.h"
#include "raytrace/cameras/view_plane.h"

namespace raytrace {

class PinholeCamera {
 public:
  struct Parameters {
    Vec3d eye{}, lookat{};  ///< they differ
    Vec3d up{0, 1, 0};      ///< if parallel to the view direction, another is picked
    double viewdistance = 0;
    Vec2d shift{0, 0};    ///< of the picture on the view plane, right and up, in larger sides of it
    double fov = 0;       ///< of files alone, in degrees; load_scene() sets viewdistance by it
    double nearclip = 0;  ///< the camera sees nothing nearer, along the view; 0: all
    double shutteropen = 0, shutterclose = 0;  ///< frames after the current one
  };
  static constexpr std::string_view name = "pinhole";  ///< as --list cameras shows it
  static constexpr std::string_view element = "camera";
  static Fields fields() { return perspective_fields<Parameters>(); }
  static Fields shorthands() { return perspective_shorthands<Parameters>(); }
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    return check_perspective(parameters);
  }

  static CameraMatrices matrices(const Parameters& parameters, const ViewPlane& viewplane) {
    return perspective_matrices(parameters, viewplane);
  }
};

}  // namespace raytrace
