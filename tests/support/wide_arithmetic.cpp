#include "support/wide_arithmetic.h"

#include <stdexcept>

#include "raytrace/variants/variant_list.h"

#define RAYTRACE_DECLARE(name, isa) extern "C" const raytrace::test::WideArithmetic* raytrace_arithmetic_##name();
RAYTRACE_VARIANTS(RAYTRACE_DECLARE)
#undef RAYTRACE_DECLARE

namespace raytrace::test {

const WideArithmetic& wide_arithmetic(const std::string& isa) {
#define RAYTRACE_CHOOSE(name, text) \
  if (isa == text) return *raytrace_arithmetic_##name();
  RAYTRACE_VARIANTS(RAYTRACE_CHOOSE)
#undef RAYTRACE_CHOOSE
  throw std::invalid_argument("no arithmetic for " + isa);
}

}  // namespace raytrace::test
