#include "exactness/random.h"

#include <algorithm>
#include <cstdlib>

#if defined(__has_feature)
#define RAYTRACE_HAS_FEATURE(name) __has_feature(name)
#else
#define RAYTRACE_HAS_FEATURE(name) 0
#endif

namespace raytrace::test {

int ray_count(int wanted) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || RAYTRACE_HAS_FEATURE(address_sanitizer) || \
    RAYTRACE_HAS_FEATURE(thread_sanitizer)
  double share = 0.02;
#else
  double share = 0.1;
#endif
  if (std::getenv("RAYTRACE_LONG_TESTS") != nullptr) share *= 10;
  if (const char* text = std::getenv("RAYTRACE_TEST_SHARE")) share = std::atof(text);
  return std::max(1, static_cast<int>(wanted * share));
}

}  // namespace raytrace::test
