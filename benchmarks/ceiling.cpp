#include "ceiling.h"

#include <stdexcept>

#include "raytrace/variants/variant_list.h"

#define RAYTRACE_DECLARE(name, isa)                                                                               \
  extern "C" raytrace::benchmark::Ceiling* raytrace_ceiling_##name(const raytrace::SceneDescription& description, \
                                                                   raytrace::benchmark::BareLoop bare);
RAYTRACE_VARIANTS(RAYTRACE_DECLARE)

namespace raytrace::benchmark {

std::unique_ptr<Ceiling> make_ceiling(const SceneDescription& description, const std::string& isa, BareLoop bare) {
#define RAYTRACE_CHOOSE(name, text) \
  if (isa == text) return std::unique_ptr<Ceiling>(raytrace_ceiling_##name(description, bare));
  RAYTRACE_VARIANTS(RAYTRACE_CHOOSE)
  throw std::invalid_argument("no ceiling for " + isa);
}

}  // namespace raytrace::benchmark
