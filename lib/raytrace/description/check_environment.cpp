#include "raytrace/description/check_environment.h"

namespace raytrace {

void check_environment(const SceneDescription& scene, Diagnostics& diagnostics) {
  const auto& skies = std::get<LightItems<SkyLight>>(scene.lights);
  const auto& lights = std::get<LightItems<EnvironmentLight>>(scene.lights);
  const auto refuse = [&](const auto& light, const std::string& message) {
    diagnostics.error(location_of(light), message);
  };
  for (const auto& light : lights) {
    if (&light != lights.data()) refuse(light, "a second <environmentlight>; a scene has one, and it is all around");
    if (!skies.empty())
      refuse(light, "an <environmentlight> beside a <skylight>; a scene has one of them, and it is all around");
    if (light.parameters.ground != 1 && !light.parameters.file.path.empty())
      refuse(light, "the <environmentlight> has a <file>, which is its ground's light, too; take out its <ground>");
    if (!light.transform.affine().is_turn())
      refuse(light,
             "the <environmentlight> has a transform that moves, scales or skews it: it is infinitely far, so it can "
             "only be turned and mirrored");
  }
  for (const auto& sky : skies)
    if (&sky != skies.data()) refuse(sky, "a second <skylight>; a scene has one, and it is all around");
}

}  // namespace raytrace
