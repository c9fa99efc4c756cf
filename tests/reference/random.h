// Portable random numbers: the standard's distributions differ from library to library, its generator does not.
#pragma once

#include <cmath>
#include <random>

#include "vector.h"

namespace reference {

class Random {
 public:
  explicit Random(unsigned seed) : bits_(seed) {}
  Real between(Real low, Real high) { return low + (high - low) * (static_cast<Real>(bits_()) / 4294967296.0L); }
  Real log_between(Real low, Real high) { return std::exp(between(std::log(low), std::log(high))); }
  int below(int n) { return static_cast<int>(between(0, n)); }
  bool chance(Real p) { return between(0, 1) < p; }
  Vector color() { return {between(0, 1), between(0, 1), between(0, 1)}; }
  Vector in_cube(Real half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
  Vector direction() {
    Vector v;
    do v = in_cube(1);
    while (length(v) > 1 || length(v) < 0.01L);
    return unit(v);
  }

 private:
  std::mt19937 bits_;
};

}  // namespace reference
