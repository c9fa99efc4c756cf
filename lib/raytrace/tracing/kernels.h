// The kernels of all integrators.
//
// An integrator's Kernel provides:
//   static RadianceRange radiance_range(const SceneTables& scene);   it scales the film's unit
//   static RayResult radiance(const TracedScene& scene, const Rgb<float>& background, CameraRays& camera,
//                             const MaskN& active, const MaskN& counted, RayCounts& counts, FirstHits* first);
//       the radiance that arrives along camera rays, whose directions have unit length, in the lanes of `active`; it
//       ends the rays where they meet something, and `background` arrives along those that meet nothing. Adds the
//       further rays in the lanes of `counted` to `counts`, and sets `first` to what was met if it is not null.
//   or, where it follows many packets' rays together, which PathBatch explains,
//   using Batch;
//   static constexpr bool takes_samples;   whether it wants CameraRays::pixel and sample
#pragma once

#include "raytrace/integrators/registry.h"
#include "raytrace/tracing/albedo_kernel.h"
#include "raytrace/tracing/ambient_occlusion_kernel.h"
#include "raytrace/tracing/normals_kernel.h"
#include "raytrace/tracing/path_kernel.h"
#include "raytrace/tracing/raycast_kernel.h"
#include "raytrace/tracing/uv_kernel.h"
