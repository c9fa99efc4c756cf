// What holds for any input of a fuzzer.
#pragma once

#include <cstdio>
#include <cstdlib>

namespace raytrace {

/// Ends the process, which the fuzzer takes for a finding, where the condition does not hold.
inline void require(bool condition, const char* what) {
  if (condition) return;
  std::fputs(what, stderr);
  std::abort();
}

}  // namespace raytrace
