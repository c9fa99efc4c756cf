// Parts of the light that a film holds beside the whole of it: of light groups, and of passes.
#pragma once

#include <memory>
#include <string>

#include "raytrace/film/radiance_layer.h"

namespace raytrace {

struct LightLayer {
  std::string name;                        ///< of its AOV: "light_key", "diffuse_direct"
  std::unique_ptr<RadianceLayer> samples;  ///< by the pixels' own samples
  std::unique_ptr<RadianceLayer> splats;   ///< by light paths; null if there are none
};

}  // namespace raytrace
