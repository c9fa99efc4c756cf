#include "raytrace/aovs/id_manifest.h"

#include <nlohmann/json.hpp>

namespace raytrace {

ImageAttribute id_manifest(std::string_view channel, const std::vector<std::string>& names) {
  return {"raytrace:manifest/" + std::string(channel),
          nlohmann::json(names).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)};
}

}  // namespace raytrace
