// Pinhole camera (Suffern, chapter 9).
//
//   <camera>
//     <eye x="0" y="2" z="10"/> <lookat x="0" y="0" z="0"/> <up x="0" y="1" z="0"/> <viewdistance>500</viewdistance>
//   </camera>
#pragma once

#include "raytrace/cameras/camera_matrices.h"
#include "raytrace/cameras/view_plane.h"
#include "raytrace/math/ray.h"
#include "raytrace/math/simd.h"
#include "raytrace/parameters/fields.h"

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
  static Fields<Parameters> fields();
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters);

  /// pixelsize: edge of a pixel on the view plane, in world units.
  PinholeCamera(const Parameters& parameters, double pixelsize);

  Vec3f origin() const { return eye_; }

  /// Rays through points of the view plane: x to the right and y upwards from its center, in pixels. Unit directions.
  template <class F>
  Ray<F> generate(const F& x, const F& y) const {
    const Vec3<F> direction{multiply_add(F(right_.x), x, multiply_add(F(up_.x), y, F(forward_.x))),
                            multiply_add(F(right_.y), x, multiply_add(F(up_.y), y, F(forward_.y))),
                            multiply_add(F(right_.z), x, multiply_add(F(up_.z), y, F(forward_.z)))};
    return {Vec3<F>(eye_), normalize(direction), F(0), infinity<F>()};
  }

  /// The camera's orthonormal frame: u to the right, v up, w towards the eye from what it looks at.
  struct Frame {
    Vec3d u, v, w;
  };
  static Frame frame(const Parameters& parameters);

  static CameraMatrices matrices(const Parameters& parameters, const ViewPlane& viewplane);

 private:
  Vec3f eye_;
  Vec3f right_, up_,
      forward_;  ///< one pixel to the right, one up, and to the view plane's center; divided by viewdistance
};

}  // namespace raytrace
