// Random numbers that are the same with every standard library, and how many of them a test draws.
#pragma once

#include <random>

#include "reference/vector.h"

namespace raytrace::test {

class Random {
 public:
  explicit Random(unsigned seed) : bits_(seed) {}
  double unit() { return static_cast<double>(bits_()) / 4294967296.0; }
  double between(double low, double high) { return low + (high - low) * unit(); }
  double log_between(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  int below(int n) { return static_cast<int>(unit() * n); }
  bool chance(double p) { return unit() < p; }
  double sign() { return chance(0.5) ? 1 : -1; }

  reference::Vector in_cube(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }

  /// Uniform on the unit sphere.
  reference::Vector direction() {
    reference::Vector v;
    do v = in_cube(1);
    while (length(v) > 1 || length(v) < 0.01L);
    return reference::unit(v);
  }

 private:
  std::mt19937 bits_;
};

/// `wanted` rays where the environment has RAYTRACE_LONG_TESTS, else a tenth of them; in builds with a sanitizer, a
/// fifth and a fiftieth. RAYTRACE_TEST_SHARE in the environment is the share itself (0.01: one in a hundred).
int ray_count(int wanted);

}  // namespace raytrace::test
