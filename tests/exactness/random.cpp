#include "exactness/random.h"

#include <algorithm>
#include <cstdlib>

#include "support/sanitizers.h"

namespace raytrace::test {

int ray_count(int wanted) {
  double share = sanitized ? 0.02 : 1;
  if (const char* text = std::getenv("RAYTRACE_TEST_SHARE")) share = std::atof(text);
  return std::max(1, static_cast<int>(wanted * share));
}

}  // namespace raytrace::test
