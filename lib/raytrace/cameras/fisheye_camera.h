// Fisheye camera: a wide angle in a circle (Suffern, chapter 11).
//
//   <fisheyecamera>
//     <eye x="0" y="1" z="0"/> <lookat x="0" y="1" z="-1"/> <up x="0" y="1" z="0"/> <angle>180</angle>
//   </fisheyecamera>
#pragma once

#include "raytrace/cameras/view_frame.h"
#include "raytrace/cameras/view_plane.h"

namespace raytrace {

/// Equidistant: the distance from the middle of the picture is proportional to the angle from the view direction. The
/// circle is as large as the picture has room for; outside of it there are no rays, and the picture is black.
class FisheyeCamera {
 public:
  struct Parameters {
    Vec3d eye{}, lookat{};                     ///< they differ
    Vec3d up{0, 1, 0};                         ///< if parallel to the view direction, another is picked
    double angle = 180;                        ///< degrees from edge to edge of the circle, at most 360
    double shutteropen = 0, shutterclose = 0;  ///< frames after the current one
  };
  static constexpr std::string_view name = "fisheye";  ///< as --list cameras shows it
  static constexpr std::string_view element = "fisheyecamera";
  static Fields fields() {
    Fields fields = view_fields<Parameters>();
    fields.push_back(optional("angle", &Parameters::angle, Range::positive));
    return fields;
  }
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    if (parameters.angle > 360)
      return ParameterDiagnostic{ParameterDiagnostic::Effect::error,
                                 "the <angle> of a fisheye camera is at most 360 degrees: all around"};
    return check_view(parameters);
  }

  static CameraMatrices matrices(const Parameters& parameters, const ViewPlane&) {
    return all_round_matrices(parameters);
  }
};

}  // namespace raytrace
