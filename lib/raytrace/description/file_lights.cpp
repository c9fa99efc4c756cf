#include "raytrace/description/file_lights.h"

#include <numbers>

namespace raytrace {

void add_file_lights(const std::vector<FileLight>& lights, const Affine& transform, SceneDescription& description) {
  constexpr double degree = std::numbers::pi / 180;
  for (const FileLight& light : lights) {
    const Vec3d position = transform.point(light.position), direction = transform.vector(light.direction);
    if (light.kind == FileLight::Kind::directional) {
      DirectionalLight::Parameters parameters;
      parameters.direction = -direction;
      parameters.color = light.intensity;
      std::get<LightItems<DirectionalLight>>(description.lights).push_back({parameters});
    } else if (light.kind == FileLight::Kind::spot) {
      SpotLight::Parameters parameters;
      parameters.location = position;
      parameters.lookat = position + direction;
      parameters.coneangle = 2 * light.outer_angle / degree;
      parameters.penumbraangle = (light.outer_angle - light.inner_angle) / degree;
      parameters.color = light.intensity;
      parameters.falloff = Falloff::inverse_square;
      std::get<LightItems<SpotLight>>(description.lights).push_back({parameters});
    } else {
      PointLight::Parameters parameters;
      parameters.location = position;
      parameters.color = light.intensity;
      parameters.falloff = Falloff::inverse_square;
      std::get<LightItems<PointLight>>(description.lights).push_back({parameters});
    }
  }
}

}  // namespace raytrace
