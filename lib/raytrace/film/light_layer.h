// What the lights of a group bring to a film.
#pragma once

#include <memory>
#include <string>

#include "raytrace/film/radiance_layer.h"

namespace raytrace {

struct LightLayer {
  std::string group;
  std::unique_ptr<RadianceLayer> samples;  ///< by the pixels' own samples
  std::unique_ptr<RadianceLayer> splats;   ///< by light paths; null if there are none
};

}  // namespace raytrace
