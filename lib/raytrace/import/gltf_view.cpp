#include "raytrace/import/gltf_view.h"

#include <numbers>

namespace raytrace::gltf {

namespace {

/// Of unit length.
Vec3d direction(const Affine& transform, const Vec3d& local, const Item& item) {
  const Vec3d result = transform.vector(local);
  const double size = length(result);
  if (!(size > 1e-17 && size < 1e17)) item.fail("its node's transform leaves it no direction");
  return result * (1 / size);
}

}  // namespace

FileCamera read_camera(const Item& camera, const Affine& transform) {
  FileCamera result;
  result.name = camera.name();
  result.eye = transform.origin;
  result.forward = direction(transform, {0, 0, -1}, camera);
  result.up = direction(transform, {0, 1, 0}, camera);
  const Item type = camera["type"];
  if (type.text() == "perspective") {
    const Item angle = camera["perspective"]["yfov"];
    result.angle = angle.number();
    if (!(result.angle > 1e-6 && result.angle < std::numbers::pi - 1e-6)) angle.fail("is not between 0 and pi");
  } else if (type.text() == "orthographic") {
    const Item half = camera["orthographic"]["ymag"];
    result.height = 2 * std::abs(half.number()) * length(transform.vector({0, 1, 0}));
    if (!(result.height > 1e-15 && result.height < 1e15)) half.fail("is 0, or too large or small");
  } else {
    type.fail("is neither 'perspective' nor 'orthographic'");
  }
  return result;
}

FileLight read_light(const Item& light, const Affine& transform) {
  FileLight result;
  result.name = light.name();
  result.position = transform.origin;
  result.direction = direction(transform, {0, 0, -1}, light);
  const auto [red, green, blue] = light.numbers<3>("color").value_or(std::array<double, 3>{1, 1, 1});
  const double intensity = light.number("intensity", 1);
  result.intensity = Rgb<double>(red, green, blue) * intensity;
  for (const double channel : {result.intensity.red, result.intensity.green, result.intensity.blue})
    if (!(channel >= 0 && channel < 1e15)) light.fail("its colour or intensity is negative or too large");
  const Item type = light["type"];
  if (type.text() == "directional") {
    result.kind = FileLight::Kind::directional;
  } else if (type.text() == "point") {
    result.kind = FileLight::Kind::point;
  } else if (type.text() == "spot") {
    result.kind = FileLight::Kind::spot;
    const std::optional<Item> cone = light.find("spot");
    if (cone) result.inner_angle = cone->number("innerConeAngle", 0);
    if (cone) result.outer_angle = cone->number("outerConeAngle", std::numbers::pi / 4);
    if (!(result.inner_angle >= 0 && result.inner_angle <= result.outer_angle && result.outer_angle > 1e-6 &&
          result.outer_angle <= std::numbers::pi / 2))
      light.fail("its cone's angles are not 0 <= inner <= outer <= pi / 2");
  } else {
    type.fail("is none of 'directional', 'point' and 'spot'");
  }
  return result;
}

}  // namespace raytrace::gltf
