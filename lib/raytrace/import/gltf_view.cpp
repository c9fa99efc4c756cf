#include "raytrace/import/gltf_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace raytrace::gltf {

namespace {

constexpr const char* no_direction = "its node's transform leaves it no direction";

/// Of unit length, if there is one.
std::optional<Vec3d> placed_direction(const Affine& transform, const Vec3d& local) {
  const Vec3d result = transform.vector(local);
  const double size = length(result);
  if (!(size > 1e-17 && size < 1e17)) return std::nullopt;
  return result * (1 / size);
}

Vec3d direction(const Affine& transform, const Vec3d& local, const Item& item) {
  const std::optional<Vec3d> placed = placed_direction(transform, local);
  if (!placed) item.fail(no_direction);
  return *placed;
}

double aspect_of(double aspect) { return aspect > 0 && std::isfinite(aspect) ? aspect : 0; }

/// Of a spot that Blender's exporter has written.
bool is_of_blender(const Document& document) {
  const std::optional<Item> generator = document.root()["asset"].find("generator");
  return generator && generator->is_text() && generator->text().starts_with("Khronos glTF Blender I/O");
}

void read_cone(const Item& cone, FileLight& light) {
  // Half a turn in floats, as files have it, is above pi.
  constexpr double rounding = 1e-6, right = std::numbers::pi / 2;
  light.inner_angle = cone.number("innerConeAngle", 0);
  light.outer_angle = cone.number("outerConeAngle", std::numbers::pi / 4);
  if (light.outer_angle > right && light.outer_angle <= right + rounding) light.outer_angle = right;
  if (light.inner_angle > right && light.inner_angle <= right + rounding) light.inner_angle = right;
}

/// Blender's exporter writes an inner angle of (1 - Blend) times the outer one. Blender's penumbra is of that share of
/// cosines.
double inner_angle_of_blender(const FileLight& light) {
  if (light.inner_angle == light.outer_angle) return light.outer_angle;
  const double edge = std::cos(light.outer_angle), blend = 1 - light.inner_angle / light.outer_angle;
  return std::min(std::acos(edge + (1 - edge) * blend), light.outer_angle);
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
    result.aspect = aspect_of(camera["perspective"].number("aspectRatio", 0));
    if (!(result.angle > 1e-6 && result.angle < std::numbers::pi - 1e-6)) angle.fail("is not between 0 and pi");
  } else if (type.text() == "orthographic") {
    // Its size is its own, whatever the scale of its node, as Blender and glTF's viewers have it.
    const Item half = camera["orthographic"]["ymag"];
    result.height = 2 * std::abs(half.number());
    if (!(result.height > 1e-15 && result.height < 1e15)) half.fail("is 0, or too large or small");
    result.aspect = aspect_of(2 * std::abs(camera["orthographic"].number("xmag", 0)) / result.height);
  } else {
    type.fail("is neither 'perspective' nor 'orthographic'");
  }
  return result;
}

std::optional<FileLight> read_light(const Item& light, const Affine& transform, Document& document) {
  const auto leave_out = [&](const std::string& why) {
    document.warn(light.place(), why + ": it is left out");
    return std::nullopt;
  };
  FileLight result;
  result.name = light.name();
  result.position = transform.origin;
  const auto [red, green, blue] = light.numbers<3>("color").value_or(std::array<double, 3>{1, 1, 1});
  const double intensity = light.number("intensity", 1);
  result.intensity = Rgb<double>(red, green, blue) * intensity;
  for (const double channel : {result.intensity.red, result.intensity.green, result.intensity.blue})
    if (!(channel >= 0 && channel < 1e15)) return leave_out("its colour or intensity is negative or too large");
  const Item type = light["type"];
  if (type.text() == "directional") {
    result.kind = FileLight::Kind::directional;
  } else if (type.text() == "point") {
    result.kind = FileLight::Kind::point;
  } else if (type.text() == "spot") {
    result.kind = FileLight::Kind::spot;
    if (const std::optional<Item> cone = light.find("spot")) read_cone(*cone, result);
    if (!(result.inner_angle >= 0 && result.inner_angle <= result.outer_angle && result.outer_angle > 1e-6 &&
          result.outer_angle <= std::numbers::pi / 2))
      light.fail("its cone's angles are not 0 <= inner <= outer <= pi / 2");
    if (is_of_blender(document)) result.inner_angle = inner_angle_of_blender(result);
  } else {
    type.fail("is none of 'directional', 'point' and 'spot'");
  }
  if (result.kind == FileLight::Kind::point) return result;
  const std::optional<Vec3d> shone_into = placed_direction(transform, {0, 0, -1});
  if (!shone_into) return leave_out(no_direction);
  result.direction = *shone_into;
  return result;
}

}  // namespace raytrace::gltf
