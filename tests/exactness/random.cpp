#include "exactness/random.h"

#include <algorithm>
#include <cstdlib>

#include "support/sanitized.h"

namespace raytrace::test {

int ray_count(int wanted) {
  double share = is_sanitized ? 0.02 : 0.1;
  if (std::getenv("RAYTRACE_LONG_TESTS") != nullptr) share *= 10;
  if (const char* text = std::getenv("RAYTRACE_TEST_SHARE")) share = std::atof(text);
  return std::max(1, static_cast<int>(wanted * share));
}

}  // namespace raytrace::test
