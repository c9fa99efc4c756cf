#include "raytrace/batch/model_lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include "raytrace/description/file_lights.h"

namespace raytrace {

namespace {

/// A rectangle that faces the model, `distance` radii away in a direction of the picture, of that size in radii.
struct Lamp {
  const char* name;
  Vec3d direction;
  double distance, width, height;
  Rgb<double> radiance;
};
constexpr std::array<Lamp, 2> lamps{{{"key light", {-0.8, 0.75, 0.75}, 4, 2.6, 2.6, {5, 4.8, 4.5}},
                                     {"rim light", {0.85, 0.6, -0.8}, 4, 0.7, 3, {5.2, 5.6, 6}}}};

void add_lamps(SceneDescription& description, const Directions& to, const Extent& extent) {
  const Vec3d middle = extent.middle();
  const Vec3d center = to.right * middle.x + to.up * middle.y + to.back * middle.z;
  const double radius = extent.radius() > 0 ? extent.radius() : 1;
  auto& materials = std::get<MaterialItems<Emissive>>(description.materials);
  for (const Lamp& lamp : lamps) {
    Emissive::Parameters emission;
    emission.ce = lamp.radiance;
    const MaterialReference material{static_cast<std::uint32_t>(index_of<Emissive>(Materials{})),
                                     static_cast<std::uint32_t>(materials.size())};
    materials.push_back({emission, lamp.name});
    const Vec3d& d = lamp.direction;
    const Vec3d outwards = normalize(to.right * d.x + to.up * d.y + to.back * d.z);
    const Vec3d across = normalize(cross(outwards, to.up)) * (lamp.width * radius);
    const Vec3d upwards = normalize(cross(across, outwards)) * (lamp.height * radius);
    // edge1 turns to edge2 anticlockwise as the model has it in view.
    const Vec3d corner = center + outwards * (lamp.distance * radius) - (across + upwards) * 0.5;
    std::get<ObjectItems<Rectangle>>(description.objects).push_back({{corner, across, upwards}, lamp.name, material});
  }
}

/// In place of lamps that a file's camera might see: as much light as from disks of their areas, infinitely far.
void add_unseen_lamps(SceneDescription& description, const Directions& to) {
  for (const Lamp& lamp : lamps) {
    const Vec3d& d = lamp.direction;
    const double half_angle = std::atan(std::sqrt(lamp.width * lamp.height / std::numbers::pi) / lamp.distance);
    const double solid_angle = 2 * std::numbers::pi * (1 - std::cos(half_angle));
    DirectionalLight::Parameters light;
    light.direction = to.right * d.x + to.up * d.y + to.back * d.z;
    light.color = lamp.radiance * solid_angle;
    light.angle = 2 * half_angle / degree;
    std::get<LightItems<DirectionalLight>>(description.lights).push_back({light});
  }
}

/// Brighter above than below, so that metal and glass, which show nothing but what is around, have a shape. radiance:
/// its mean, in green.
void add_studio_sky(SceneDescription& description, double radiance) {
  LightItem<EnvironmentLight> sky;
  sky.parameters.ground = 0.2;
  const double above = 2 * radiance / (1 + sky.parameters.ground);
  sky.parameters.color = {0.986 * above, above, 1.028 * above};
  std::get<LightItems<EnvironmentLight>>(description.lights).push_back(sky);
}
constexpr double studio_radiance = 0.3;

/// Of the sky beside a file's lights, of any brightness: a part of what they give to a surface in the middle that faces
/// each of them, in its brightest channel, so that shadows and metals are not black. Lights within the model count as
/// if at its edge.
double radiance_beside(const std::vector<FileLight>& lights, const Affine& affine, const SceneDescription& shown) {
  Extent extent;
  for_each_vertex(shown, [&](const Vec3d& p) { extent.add(p); });
  const double least = std::max(extent.radius() * extent.radius(), 1e-300);
  double irradiance = 0;
  for (const FileLight& light : lights) {
    const Vec3d way = affine.point(light.position) - extent.middle();
    const bool is_far = light.kind == FileLight::Kind::directional;
    irradiance += std::max({light.intensity.red, light.intensity.green, light.intensity.blue}) /
                  (is_far ? 1 : std::max(dot(way, way), least));
  }
  constexpr double share = 0.08;
  return share * std::min(irradiance, 1e18) / std::numbers::pi;
}

/// The stage's own, in place of the studio.
void add_daylight(SceneDescription& description, const ModelStage& stage) {
  const auto [azimuth, elevation] = stage.sun.value_or(std::array{-40.0, 40.0});
  const Vec3d sun = towards(azimuth, elevation);
  if (stage.environment == sky_environment) {
    SkyLight::Parameters sky;
    sky.sundirection = sun;
    std::get<LightItems<SkyLight>>(description.lights).push_back({sky});
    return;
  }
  if (stage.environment.empty()) {
    add_studio_sky(description, studio_radiance);
  } else if (stage.environment != no_environment) {
    LightItem<EnvironmentLight> picture;
    picture.parameters.file.path = stage.environment;
    std::get<LightItems<EnvironmentLight>>(description.lights).push_back(picture);
  }
  if (!stage.sun) return;
  DirectionalLight::Parameters light;
  light.direction = sun;
  light.scaleradiance = 2.5;
  light.color = {1, 0.95, 0.88};
  light.angle = 0.53;
  std::get<LightItems<DirectionalLight>>(description.lights).push_back({light});
}

}  // namespace

void add_model_lights(SceneDescription& description, const SceneDescription& shown, const ModelStage& stage,
                      const Directions& to, const std::optional<Extent>& extent) {
  const std::vector<FileLight>& lights = data_of(description).lights;
  const bool is_dark = stage.environment == no_environment;
  if ((stage.environment.empty() || is_dark) && !stage.sun && !lights.empty()) {
    const Affine affine = std::get<ObjectItems<Mesh>>(description.objects).front().transform.affine();
    add_file_lights(lights, affine, description);
    if (!is_dark) add_studio_sky(description, radiance_beside(lights, affine, shown));
  } else if (stage.environment.empty() && !stage.sun) {
    if (extent)
      add_lamps(description, to, *extent);
    else
      add_unseen_lamps(description, to);
    add_studio_sky(description, studio_radiance);
  } else {
    add_daylight(description, stage);
  }
  // Lights of files are of any brightness, and so is what shines in the dark.
  description.viewplane.autoexposure = !stage.sun && (is_dark || (stage.environment.empty() && !lights.empty()));
}

}  // namespace raytrace
