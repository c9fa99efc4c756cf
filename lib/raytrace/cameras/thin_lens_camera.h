// Thin lens camera: what is not at the focal distance is blurred (Suffern, chapter 10).
//
//   <thinlenscamera>
//     <eye x="0" y="2" z="10"/> <lookat x="0" y="0" z="0"/> <fov>40</fov>
//     <lensradius>0.2</lensradius> <focaldistance>9</focaldistance> <blades>6</blades>
//     <bladerotation>15</bladerotation>
//   </thinlenscamera>
#pragma once

#include "raytrace/cameras/view_frame.h"
#include "raytrace/cameras/view_plane.h"

namespace raytrace {

/// Its picture is a pinhole camera's where things lie at `focaldistance` along the view, whatever point of the lens
/// the rays start at.
class ThinLensCamera {
 public:
  struct Parameters {
    Vec3d eye{}, lookat{};  ///< the middle of the lens; they differ
    Vec3d up{0, 1, 0};      ///< if parallel to the view direction, another is picked
    double viewdistance = 0;
    double lensradius = 0;     ///< 0: a pinhole
    double focaldistance = 0;  ///< from the lens to the plane that is in focus
    int blades = 0;            ///< corners of the lens, on a circle of lensradius; 0: it is round
    double bladerotation = 0;  ///< degrees that the first corner is turned from the right towards the top
    Vec2d shift{0, 0};         ///< of the picture on the view plane, right and up, in larger sides of it
    double fov = 0;            ///< of files alone, in degrees; load_scene() sets viewdistance by it
    double nearclip = 0;       ///< the camera sees nothing nearer, along the view; 0: all
    double shutteropen = 0, shutterclose = 0;  ///< frames after the current one
  };
  static constexpr std::string_view name = "thinlens";  ///< as --list cameras shows it
  static constexpr std::string_view element = "thinlenscamera";
  static Fields fields() {
    Fields fields = perspective_fields<Parameters>();
    fields.push_back(required("lensradius", &Parameters::lensradius, Range::not_negative));
    fields.push_back(required("focaldistance", &Parameters::focaldistance, Range::positive));
    fields.push_back(optional("blades", &Parameters::blades, Range::not_negative));
    fields.push_back(optional("bladerotation", &Parameters::bladerotation));
    return fields;
  }
  static Fields shorthands() { return perspective_shorthands<Parameters>(); }
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    if (parameters.blades == 1 || parameters.blades == 2)
      return ParameterDiagnostic{ParameterDiagnostic::Effect::error,
                                 "a lens has 3 <blades> or more, or 0, which make it round"};
    return check_perspective(parameters);
  }

  static CameraMatrices matrices(const Parameters& parameters, const ViewPlane& viewplane) {
    return perspective_matrices(parameters, viewplane);
  }
};

}  // namespace raytrace
