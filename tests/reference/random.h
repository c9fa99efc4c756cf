// Portable random numbers: the standard's distributions differ from library to library, its generator does not.
#pragma once

#include <cmath>
#include <random>

#include "vector.h"

namespace reference {

template <class Number>
class RandomNumbers {
 public:
  explicit RandomNumbers(unsigned seed) : bits_(seed) {}
  Number unit() { return static_cast<Number>(bits_()) / 4294967296.0; }
  Number between(Number low, Number high) { return low + (high - low) * unit(); }
  Number log_between(Number low, Number high) { return std::exp(between(std::log(low), std::log(high))); }
  int below(int n) { return static_cast<int>(unit() * static_cast<Number>(n)); }
  bool chance(Number p) { return unit() < p; }
  Number sign() { return chance(static_cast<Number>(0.5)) ? 1 : -1; }
  Vector color() { return {between(0, 1), between(0, 1), between(0, 1)}; }
  Vector in_cube(Number half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
  /// Uniform on the unit sphere.
  Vector direction() {
    Vector v;
    do v = in_cube(1);
    while (length(v) > 1 || length(v) < 0.01L);
    return reference::unit(v);
  }

 private:
  std::mt19937 bits_;
};

using Random = RandomNumbers<Real>;

}  // namespace reference
