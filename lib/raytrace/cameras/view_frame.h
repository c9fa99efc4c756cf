// The frame of a camera that looks from a point at another.
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

#include "raytrace/cameras/camera_matrices.h"
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

/// What is wrong with a camera's eye and lookat.
inline std::optional<ParameterDiagnostic> check_view(const Vec3d& eye, const Vec3d& lookat) {
  if (length(eye - lookat) >= smallest_size) return std::nullopt;
  return ParameterDiagnostic{ParameterDiagnostic::Effect::error,
                             "the camera's <eye> and <lookat> are the same point: it looks nowhere"};
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

}  // namespace raytrace
