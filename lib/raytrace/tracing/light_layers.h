// Which layers of a film get the light of the scene's light groups.
#pragma once

#include <vector>

#include "raytrace/film/film.h"
#include "raytrace/film/light_layer.h"
#include "raytrace/scene/scene_tables.h"

namespace raytrace {

/// Of each light group; null where the film has no layer for it.
inline std::vector<LightLayer*> light_layers(const SceneTables& scene, Film& film) {
  std::vector<LightLayer*> layers;
  for (const SceneTables::LightGroup& group : scene.light_groups()) {
    LightLayer* found = nullptr;
    for (LightLayer& layer : film.lights())
      if (layer.group == group.name) found = &layer;
    layers.push_back(found);
  }
  return layers;
}

}  // namespace raytrace
