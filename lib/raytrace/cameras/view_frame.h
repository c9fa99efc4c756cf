// The frame of a camera that looks from a point at another.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>

#include "raytrace/cameras/camera_matrices.h"
#include "raytrace/cameras/view_plane.h"
#include "raytrace/parameters/fields.h"

namespace raytrace {

/// Orthonormal: u to the right, v up, w towards the eye from what it looks at.
struct ViewFrame {
  Vec3d u, v, w;

  /// up: of any length but 0; where it is parallel to the view, another is picked.
  ViewFrame(const Vec3d& eye, const Vec3d& lookat, const Vec3d& up_wanted) : w(normalize(eye - lookat)) {
    Vec3d up = normalize(up_wanted);
    if (length(cross(up, w)) < 1e-9) {
      // Looking along `up`: the axis least along the view.
      const double x = std::abs(w.x), y = std::abs(w.y), z = std::abs(w.z);
      up = x <= y && x <= z ? Vec3d{1, 0, 0} : z <= y ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
    }
    u = normalize(cross(up, w));
    v = cross(w, u);
  }
};

/// The fields of a camera that looks from a point at another.
template <class Parameters>
Fields view_fields() {
  return {required("eye", &Parameters::eye, a_point), required("lookat", &Parameters::lookat, a_point),
          optional("up", &Parameters::up, Range::nonzero), optional("shutteropen", &Parameters::shutteropen),
          optional("shutterclose", &Parameters::shutterclose)};
}

/// The same of one with a view plane.
template <class Parameters>
Fields view_plane_fields() {
  Fields fields = view_fields<Parameters>();
  fields.push_back(optional("nearclip", &Parameters::nearclip, Range::not_negative));
  return fields;
}

/// The same of one with a view plane at `viewdistance`.
template <class Parameters>
Fields perspective_fields() {
  Fields fields = view_plane_fields<Parameters>();
  fields.push_back(required("viewdistance", &Parameters::viewdistance, Range::positive));
  fields.push_back(optional("shift", &Parameters::shift));
  return fields;
}
template <class Parameters>
Fields perspective_shorthands() {
  return {shorthand("fov", &Parameters::fov, Range::positive, "viewdistance")};
}

/// What is wrong with a camera's eye and lookat, or with its shutter.
template <class Parameters>
std::optional<ParameterDiagnostic> check_view(const Parameters& parameters) {
  using enum ParameterDiagnostic::Effect;
  if (length(parameters.eye - parameters.lookat) < smallest_size)
    return ParameterDiagnostic{error, "the camera's <eye> and <lookat> are the same point: it looks nowhere"};
  if (parameters.shutterclose < parameters.shutteropen)
    return ParameterDiagnostic{
        error, "the camera's shutter closes before it opens: <shutterclose> is less than <shutteropen>"};
  return std::nullopt;
}

/// Larger sides of the picture, to either side: far beyond what any lens has, and no float overflows.
inline constexpr double largest_shift = 100;

/// The same, and with its field of view or its shift.
template <class Parameters>
std::optional<ParameterDiagnostic> check_perspective(const Parameters& parameters) {
  constexpr double least = 1e-6;
  if (std::abs(parameters.shift.x) > largest_shift || std::abs(parameters.shift.y) > largest_shift)
    return ParameterDiagnostic{
        ParameterDiagnostic::Effect::error,
        "the numbers of the camera's <shift> are from -100 to 100, in larger sides of the picture"};
  if (parameters.fov == 0 || (parameters.fov >= least && parameters.fov < 180)) return check_view(parameters);
  return ParameterDiagnostic{ParameterDiagnostic::Effect::error,
                             "the camera's <fov> is an angle of at least 0.000001 and less than 180 degrees"};
}

/// From the eye to the view plane on which the picture's height is seen under that angle, in degrees.
inline double view_distance(double fov, const ViewPlane& viewplane) {
  return viewplane.pixelsize * viewplane.vres / (2 * std::tan(fov * std::numbers::pi / 360));
}

/// From where the axis of the view meets the view plane to the picture's middle, to the right and upwards, in pixels.
template <class Parameters>
Vec2d shift_in_pixels(const Parameters& parameters, const ViewPlane& viewplane) {
  const double side = std::max(viewplane.hres, viewplane.vres);
  return {parameters.shift.x * side, parameters.shift.y * side};
}

/// screen: from camera space to the picture, as CameraMatrices has it.
inline CameraMatrices make_camera_matrices(const Vec3d& eye, const ViewFrame& frame, const double (&screen)[4][4]) {
  const auto& [u, v, w] = frame;
  const double camera[4][4] = {
      {u.x, v.x, w.x, 0}, {u.y, v.y, w.y, 0}, {u.z, v.z, w.z, 0}, {-dot(eye, u), -dot(eye, v), -dot(eye, w), 1}};
  CameraMatrices matrices;
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column) {
      double sum = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += camera[row][k] * screen[k][column];
      matrices.world_to_camera[row * 4 + column] = static_cast<float>(camera[row][column]);
      matrices.world_to_ndc[row * 4 + column] = static_cast<float>(sum);
    }
  return matrices;
}

/// Of a camera with a view plane at `viewdistance`.
template <class Parameters>
CameraMatrices perspective_matrices(const Parameters& parameters, const ViewPlane& viewplane) {
  // The picture spans +-half on the view plane, and -z of camera space divides: x' = x * d / (width * -z) + 1/2; what
  // is on the axis is as far from the middle as the picture is shifted.
  const Vec2d shift = shift_in_pixels(parameters, viewplane);
  const double x_shift = shift.x / viewplane.hres, y_shift = shift.y / viewplane.vres;
  const double x_scale = parameters.viewdistance / (viewplane.pixelsize * viewplane.hres);
  const double y_scale = parameters.viewdistance / (viewplane.pixelsize * viewplane.vres);
  return make_camera_matrices(
      parameters.eye, ViewFrame(parameters.eye, parameters.lookat, parameters.up),
      {{x_scale, 0, 0, 0}, {0, y_scale, 0, 0}, {x_shift - 0.5, y_shift - 0.5, -1, -1}, {0, 0, 0, 0}});
}

/// Of a camera whose picture no matrix leads to.
template <class Parameters>
CameraMatrices all_round_matrices(const Parameters& parameters) {
  CameraMatrices matrices =
      make_camera_matrices(parameters.eye, ViewFrame(parameters.eye, parameters.lookat, parameters.up), {});
  matrices.is_projection = false;
  return matrices;
}

}  // namespace raytrace
