// Cryptomatte of the objects, each by its name.
#pragma once

#include <string_view>
#include <vector>

#include "raytrace/aovs/aov.h"
#include "raytrace/aovs/scene_names.h"

namespace raytrace {

class CryptoObject {
 public:
  static constexpr std::string_view name = "crypto_object";
  static constexpr AovRule rule = AovRule::coverage;

  template <class Surface>
  static auto index(const Surface& surface) {
    return surface.object();
  }

  static std::vector<std::string> names(const SceneDescription& description) { return object_names(description); }
};

}  // namespace raytrace
