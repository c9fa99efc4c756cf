// What is timed once for each instruction set: intersections, BRDFs, camera, sampler, sums.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "micro_case.h"
#include "shape_scenes.h"

namespace raytrace::benchmark {

/// isa: one of isa_names() that isa_supported().
void add_wide_cases(const std::string& isa, std::span<const ShapeScene> shapes, std::vector<MicroCase>& cases);

}  // namespace raytrace::benchmark
