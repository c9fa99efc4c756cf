#include "raytrace/cameras/pinhole_camera.h"

namespace raytrace {

Fields<PinholeCamera::Parameters> PinholeCamera::fields() {
  return {required("eye", &Parameters::eye), required("lookat", &Parameters::lookat),
          optional("up", &Parameters::up, Range::nonzero),
          required("viewdistance", &Parameters::viewdistance, Range::positive)};
}

std::optional<ParameterDiagnostic> PinholeCamera::check(const Parameters& parameters) {
  if (length(parameters.eye - parameters.lookat) >= smallest_size) return std::nullopt;
  return ParameterDiagnostic{ParameterDiagnostic::Effect::error,
                             "the camera's <eye> and <lookat> are the same point: it looks nowhere"};
}

PinholeCamera::Frame PinholeCamera::frame(const Parameters& parameters) {
  const Vec3d w = normalize(parameters.eye - parameters.lookat);
  Vec3d up = normalize(parameters.up);
  if (length(cross(up, w)) < 1e-9) {
    // Looking along `up`: the axis least along the view.
    const double x = std::abs(w.x), y = std::abs(w.y), z = std::abs(w.z);
    up = x <= y && x <= z ? Vec3d{1, 0, 0} : z <= y ? Vec3d{0, 0, 1} : Vec3d{0, 1, 0};
  }
  const Vec3d u = normalize(cross(up, w));
  return {u, cross(w, u), w};
}

PinholeCamera::PinholeCamera(const Parameters& parameters, double pixelsize) : eye_(parameters.eye) {
  const Frame frame = PinholeCamera::frame(parameters);
  const double pixel = pixelsize / parameters.viewdistance;
  right_ = Vec3f(frame.u * pixel);
  up_ = Vec3f(frame.v * pixel);
  forward_ = Vec3f(-frame.w);
}

CameraMatrices PinholeCamera::matrices(const Parameters& parameters, const ViewPlane& viewplane) {
  const auto [u, v, w] = frame(parameters);
  const Vec3d& eye = parameters.eye;
  const double camera[4][4] = {
      {u.x, v.x, w.x, 0}, {u.y, v.y, w.y, 0}, {u.z, v.z, w.z, 0}, {-dot(eye, u), -dot(eye, v), -dot(eye, w), 1}};
  // The picture spans +-half on the view plane, and -z of camera space divides: x' = x * d / (width * -z) + 1/2.
  const double x_scale = parameters.viewdistance / (viewplane.pixelsize * viewplane.hres);
  const double y_scale = parameters.viewdistance / (viewplane.pixelsize * viewplane.vres);
  const double screen[4][4] = {{x_scale, 0, 0, 0}, {0, y_scale, 0, 0}, {-0.5, -0.5, -1, -1}, {0, 0, 0, 0}};
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
