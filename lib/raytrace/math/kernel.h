// The two halves of a type.
//
// A shape, light, material, camera or integrator has two headers. The first, such as shapes/sphere.h, has its
// parameters: what a scene file says of it. All code may include it. The second, shapes/sphere_kernel.h, computes with
// packets of rays: it is compiled once for each instruction set, and only the code that is may include it.
#pragma once

#include <variant>

#include "raytrace/math/type_list.h"

namespace raytrace {

/// The second half of a type. What it provides: shapes/kernels.h, lights/kernels.h, materials/kernels.h,
/// cameras/kernels.h, tracing/kernels.h.
template <class Type>
class Kernel;

/// A std::variant of the kernels of a list's types.
template <class List>
struct KernelVariant;
template <class... Types>
struct KernelVariant<TypeList<Types...>> {
  using type = std::variant<Kernel<Types>...>;
};

}  // namespace raytrace
