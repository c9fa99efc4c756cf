// What is timed once, since it is compiled once: the film, and reading scene files.
#pragma once

#include <vector>

#include "micro_case.h"

namespace raytrace::benchmark {

void add_narrow_cases(std::vector<MicroCase>& cases);

}  // namespace raytrace::benchmark
