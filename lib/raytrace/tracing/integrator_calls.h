// How the innermost loop calls a scene's integrator.
#pragma once

#include "raytrace/scene/scene_tables.h"
#include "raytrace/tracing/kernels.h"

namespace raytrace {

/// An integrator, as one that is called by a pointer.
struct IntegratorCalls {
  decltype(&Kernel<Raycast>::radiance) radiance;  ///< null: it has a batch
  bool takes_samples;
};

template <class Integrator>
constexpr bool has_batch = requires { typename Kernel<Integrator>::Batch; };

/// Of a scene's integrator.
inline IntegratorCalls calls_of(const SceneTables& scene) {
  return with_type(Integrators{}, scene.integrator().index(), [&]<class Integrator>(std::type_identity<Integrator>) {
    IntegratorCalls calls{nullptr, Kernel<Integrator>::takes_samples};
    if constexpr (!has_batch<Integrator>) calls.radiance = &Kernel<Integrator>::radiance;
    return calls;
  });
}

}  // namespace raytrace
