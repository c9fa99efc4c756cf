// The scenes that are rendered to be timed: random, but the same in every run.
#pragma once

#include "raytrace/description/scene_description.h"

namespace raytrace::benchmark {

/// `count` spheres over a plane, half of them glossy, under one shadowing point light. They fill the same share of the
/// space, however many there are. The picture is square: resolution x resolution pixels.
SceneDescription random_spheres(int count, int resolution, int samples);

/// The same with spheres, triangles, cylinders and toruses in turns: `count` objects with the plane.
SceneDescription random_mix(int count, int resolution, int samples);

}  // namespace raytrace::benchmark
