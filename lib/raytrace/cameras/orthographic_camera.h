// Orthographic camera: parallel rays (Suffern, chapter 8).
//
//   <orthographiccamera> <eye x="0" y="2" z="10"/> <lookat x="0" y="0" z="0"/> <up x="0" y="1" z="0"/>
//   </orthographiccamera>
#pragma once

#include "raytrace/cameras/view_frame.h"
#include "raytrace/cameras/view_plane.h"

namespace raytrace {

/// The view plane goes through the eye, and pixelsize is its scale. What is behind it is not in the picture.
class OrthographicCamera {
 public:
  struct Parameters {
    Vec3d eye{}, lookat{};                     ///< they differ
    Vec3d up{0, 1, 0};                         ///< if parallel to the view direction, another is picked
    double nearclip = 0;                       ///< the camera sees nothing nearer, along the view; 0: all
    double shutteropen = 0, shutterclose = 0;  ///< frames after the current one
  };
  static constexpr std::string_view name = "orthographic";  ///< as --list cameras shows it
  static constexpr std::string_view element = "orthographiccamera";
  static Fields fields() { return view_plane_fields<Parameters>(); }
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) { return check_view(parameters); }

  static CameraMatrices matrices(const Parameters& parameters, const ViewPlane& viewplane) {
    const double x_scale = 1 / (viewplane.pixelsize * viewplane.hres),
                 y_scale = 1 / (viewplane.pixelsize * viewplane.vres);
    return make_camera_matrices(parameters.eye, ViewFrame(parameters.eye, parameters.lookat, parameters.up),
                                {{x_scale, 0, 0, 0}, {0, y_scale, 0, 0}, {0, 0, -1, 0}, {0.5, 0.5, 0, 1}});
  }
};

}  // namespace raytrace
