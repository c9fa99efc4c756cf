// id.material: the material of the nearest object, by its place among the materials, counted from 1; 0: nothing.
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "raytrace/aovs/aov.h"
#include "raytrace/aovs/id_manifest.h"
#include "raytrace/output/image_band.h"

namespace raytrace {

class MaterialId {
 public:
  static constexpr std::string_view name = "material_id";
  static constexpr AovRule rule = AovRule::nearest;
  static constexpr ChannelType type = ChannelType::uint32;
  static constexpr std::array<std::string_view, 1> channels{"id.material"};

  template <class Surface>
  static auto values(const Surface& surface) {
    return std::array{surface.id(surface.material())};
  }

  static std::vector<ImageAttribute> attributes(const SceneDescription& description) {
    return {id_manifest(channels[0], material_names(description))};
  }
};

}  // namespace raytrace
