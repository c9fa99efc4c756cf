// The field of view, which scene files may give in place of the view distance.
#include <cmath>
#include <numbers>
#include <string>

#include "raytrace/cameras/kernels.h"
#include "support/catch.h"
#include "support/lanes.h"
#include "support/parsed_scene.h"

namespace raytrace::test {

namespace {

SceneDescription with_fov(const std::string& element, const std::string& more = {}) {
  return parsed_scene("<raytracer><" + element + "><eye x='1' y='2' z='9'/><lookat x='0' y='0' z='0'/><fov>50</fov>" +
                      more + "</" + element + "><viewplane><hres>64</hres><vres>48</vres></viewplane></raytracer>");
}

template <class Camera>
void check_angle(const SceneDescription& description, const ViewPlane& viewplane) {
  const auto& parameters = std::get<typename Camera::Parameters>(description.camera);
  const Kernel<PinholeCamera> camera({parameters.eye, parameters.lookat, parameters.up, parameters.viewdistance},
                                     viewplane);
  const auto at = [&](double y) {
    return lane_of(camera.generate(FloatN(0), FloatN(static_cast<float>(y))).direction, 0);
  };
  const double half = viewplane.vres / 2.0;
  CHECK(std::acos(dot(at(half), at(-half))) * 180 / std::numbers::pi == Approx(50).epsilon(1e-5));
}

}  // namespace

TEST_CASE("fov is the angle under which the picture's height is seen") {
  const SceneDescription pinhole = with_fov("camera");
  check_angle<PinholeCamera>(pinhole, pinhole.viewplane);
  check_angle<PinholeCamera>(pinhole, with_resolution(pinhole.viewplane, 640, 480));
  const SceneDescription lens =
      with_fov("thinlenscamera", "<lensradius>1</lensradius><focaldistance>9</focaldistance>");
  check_angle<ThinLensCamera>(lens, lens.viewplane);
}

TEST_CASE("a camera with fov is printed with the view distance that it has by it") {
  const SceneDescription description = with_fov("camera");
  const double distance = std::get<PinholeCamera::Parameters>(description.camera).viewdistance;
  CHECK(distance == Approx(24 / std::tan(25 * std::numbers::pi / 180)));
  const SceneDescription again = parsed_scene(print_scene(description));
  CHECK(std::get<PinholeCamera::Parameters>(again.camera).viewdistance == distance);
}

}  // namespace raytrace::test
