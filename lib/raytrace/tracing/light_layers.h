// Which layers of a film get which part of the light.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "raytrace/aovs/aov_table.h"
#include "raytrace/film/film.h"
#include "raytrace/film/light_layer.h"
#include "raytrace/film/light_pass.h"
#include "raytrace/parameters/light_group.h"
#include "raytrace/scene/scene_tables.h"

namespace raytrace {

/// The layer of that AOV; null where the film has none.
inline LightLayer* find_layer(Film& film, std::string_view name) {
  for (LightLayer& layer : film.lights())
    if (layer.name == name) return &layer;
  return nullptr;
}

/// Of each light group.
inline std::vector<LightLayer*> light_layers(const SceneTables& scene, Film& film) {
  std::vector<LightLayer*> layers;
  for (const SceneTables::LightGroup& group : scene.light_groups())
    layers.push_back(find_layer(film, std::string(light_aov_prefix) + group.name));
  return layers;
}

/// Whether a film with these AOVs has layers of passes.
inline bool has_passes(const AovSet& aovs) {
  for (std::size_t i = 0; i < light_pass_count; ++i)
    if (aovs.has(first_light_pass + i)) return true;
  return false;
}

/// Of each pass.
using PassLayers = std::array<LightLayer*, light_pass_count>;
inline PassLayers pass_layers(Film& film) {
  PassLayers layers;
  for (std::size_t i = 0; i < layers.size(); ++i) layers[i] = find_layer(film, aov_table[first_light_pass + i].name);
  return layers;
}

}  // namespace raytrace
