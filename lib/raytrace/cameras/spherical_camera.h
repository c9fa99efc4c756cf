// Spherical camera: all around in one picture, by longitude and latitude (Suffern, chapter 11).
//
//   <sphericalcamera> <eye x="0" y="1" z="0"/> <lookat x="0" y="1" z="-1"/> <up x="0" y="1" z="0"/> </sphericalcamera>
#pragma once

#include "raytrace/cameras/view_frame.h"
#include "raytrace/cameras/view_plane.h"

namespace raytrace {

/// Equirectangular: the picture is 360 degrees wide and 180 degrees high, with what the camera looks at in the middle.
class SphericalCamera {
 public:
  struct Parameters {
    Vec3d eye{}, lookat{};                     ///< they differ
    Vec3d up{0, 1, 0};                         ///< if parallel to the view direction, another is picked
    double shutteropen = 0, shutterclose = 0;  ///< frames after the current one
  };
  static constexpr std::string_view name = "spherical";  ///< as --list cameras shows it
  static constexpr std::string_view element = "sphericalcamera";
  static Fields fields() { return view_fields<Parameters>(); }
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) { return check_view(parameters); }

  static CameraMatrices matrices(const Parameters& parameters, const ViewPlane&) {
    return all_round_matrices(parameters);
  }
};

}  // namespace raytrace
