// How the light of a scene is computed that does not say how.
#pragma once

#include <algorithm>

#include "raytrace/description/scene_description.h"

namespace raytrace {

/// By paths, where it has materials or lights that nothing else shows right; else by raycasting.
inline IntegratorParameters default_integrator(const SceneDescription& scene) {
  const auto& suns = std::get<LightItems<DirectionalLight>>(scene.lights);
  const auto has = [&]<class... Types>(TypeList<Types...>) {
    return (!std::get<MaterialItems<Types>>(scene.materials).empty() || ...);
  };
  const bool needs_path =
      has(TypeList<Emissive, Mirror, Conductor, Dielectric, OpenPbr, Fog, Hair>{}) ||
      !std::get<LightItems<EnvironmentLight>>(scene.lights).empty() ||
      !std::get<LightItems<SkyLight>>(scene.lights).empty() ||
      std::any_of(suns.begin(), suns.end(), [](const auto& sun) { return sun.parameters.angle > 0; });
  if (needs_path) return Path::Parameters{};
  return Raycast::Parameters{};
}

/// The scene's own, or the default.
inline IntegratorParameters integrator_of(const SceneDescription& scene) {
  return scene.integrator ? *scene.integrator : default_integrator(scene);
}

}  // namespace raytrace
