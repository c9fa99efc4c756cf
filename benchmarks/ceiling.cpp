#include "ceiling.h"

#include <stdexcept>

#include "raytrace/render/variant_list.h"

#define RAYTRACE_DECLARE(name, isa)                                                                               \
  extern "C" raytrace::benchmark::Ceiling* raytrace_ceiling_##name(const raytrace::SceneDescription& description, \
                                                                   raytrace::benchmark::SphereGeometry spheres);
RAYTRACE_VARIANTS(RAYTRACE_DECLARE)

namespace raytrace::benchmark {

std::unique_ptr<Ceiling> make_ceiling(const SceneDescription& description, const std::string& isa,
                                      SphereGeometry spheres) {
#define RAYTRACE_CHOOSE(name, text) \
  if (isa == text) return std::unique_ptr<Ceiling>(raytrace_ceiling_##name(description, spheres));
  RAYTRACE_VARIANTS(RAYTRACE_CHOOSE)
  throw std::invalid_argument("no ceiling for " + isa);
}

}  // namespace raytrace::benchmark
