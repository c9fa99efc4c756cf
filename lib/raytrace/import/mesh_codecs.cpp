#include "raytrace/import/mesh_codecs.h"

#include "raytrace/import/gltf_draco.h"
#include "raytrace/import/gltf_meshopt.h"

namespace raytrace {

std::vector<std::string> mesh_codecs() {
  std::vector<std::string> codecs;
  for (const std::string& codec : {gltf::draco_version(), gltf::meshopt_version()})
    if (!codec.empty()) codecs.push_back(codec);
  return codecs;
}

}  // namespace raytrace
