// A small piece of work to be timed.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace raytrace::benchmark {

struct MicroCase {
  std::string name;        ///< what/of/which; wide code ends with the instruction set: "intersect/sphere/16/x86-64-v4"
  std::int64_t items = 0;  ///< done by one run: rays, samples, pixels, objects
  std::int64_t bytes = 0;  ///< read by one run; 0: not counted
  std::function<float()> run;  ///< gives something that depends on all of the work, so that no compiler leaves it out
};

}  // namespace raytrace::benchmark
