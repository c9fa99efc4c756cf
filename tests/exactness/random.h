// The tests' random numbers, and how many of them a test draws.
#pragma once

#include "reference/random.h"

namespace raytrace::test {

using Random = reference::RandomNumbers<double>;

/// `wanted` rays where the environment has RAYTRACE_LONG_TESTS, else a tenth of them; in builds with a sanitizer, a
/// fifth and a fiftieth. RAYTRACE_TEST_SHARE in the environment is the share itself (0.01: one in a hundred).
int ray_count(int wanted);

}  // namespace raytrace::test
