// What packets of rays hit.
#pragma once

#include <cstdint>

#include "raytrace/math/simd.h"

namespace raytrace {

/// The nearest hits of a packet. Lanes that hit nothing hold anything.
struct Hits {
  /// Of lanes that hit no instance, as all do while scenes have none.
  static constexpr std::uint32_t no_instance = ~0U;

  MaskN hit;
  UintN instance;
  UintN geometry;  ///< index in the scene's GeometryTable
  IntN primitive;  ///< index among the geometry's
  FloatN u, v;     ///< barycentric coordinates on triangles

  // Of the first lane with a hit, and whether all others with one hit the same geometry, and the same primitive of it,
  // as neighbours mostly do.
  std::uint32_t first_geometry = 0;
  std::int32_t first_primitive = 0;
  bool one_geometry = false, one_primitive = false;
};

}  // namespace raytrace
