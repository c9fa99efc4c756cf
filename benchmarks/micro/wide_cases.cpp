#include "wide_cases.h"

#include <stdexcept>

#include "raytrace/variants/variant_list.h"

#define RAYTRACE_DECLARE(name, isa)                                                              \
  extern "C" void raytrace_micro_##name(std::span<const raytrace::benchmark::ShapeScene> shapes, \
                                        std::vector<raytrace::benchmark::MicroCase>& cases);
RAYTRACE_VARIANTS(RAYTRACE_DECLARE)

namespace raytrace::benchmark {

void add_wide_cases(const std::string& isa, std::span<const ShapeScene> shapes, std::vector<MicroCase>& cases) {
#define RAYTRACE_CHOOSE(name, text) \
  if (isa == text) return raytrace_micro_##name(shapes, cases);
  RAYTRACE_VARIANTS(RAYTRACE_CHOOSE)
  throw std::invalid_argument("no cases for " + isa);
}

}  // namespace raytrace::benchmark
