// Pinhole camera (Suffern, chapter 9).
//
//   <camera>
//     <eye x="0" y="2" z="10"/> <lookat x="0" y="0" z="0"/> <up x="0" y="1" z="0"/> <viewdistance>500</viewdistance>
//   </camera>
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
  };
  static constexpr std::string_view name = "pinhole";  ///< as --list cameras shows it
  static constexpr std::string_view element = "camera";
  static Fields<Parameters> fields() {
    return {required("eye", &Parameters::eye, a_point), required("lookat", &Parameters::lookat, a_point),
            optional("up", &Parameters::up, Range::nonzero),
            required("viewdistance", &Parameters::viewdistance, Range::positive)};
  }
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    return check_view(parameters.eye, parameters.lookat);
  }

  static CameraMatrices matrices(const Parameters& parameters, const ViewPlane& viewplane) {
    // The picture spans +-half on the view plane, and -z of camera space divides: x' = x * d / (width * -z) + 1/2.
    const double x_scale = parameters.viewdistance / (viewplane.pixelsize * viewplane.hres);
    const double y_scale = parameters.viewdistance / (viewplane.pixelsize * viewplane.vres);
    return make_camera_matrices(parameters.eye, ViewFrame(parameters.eye, parameters.lookat, parameters.up),
                                {{x_scale, 0, 0, 0}, {0, y_scale, 0, 0}, {-0.5, -0.5, -1, -1}, {0, 0, 0, 0}});
  }
};

}  // namespace raytrace
