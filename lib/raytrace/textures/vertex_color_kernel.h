// Colours of meshes' vertices, between which they change evenly.
#pragma once

#include "raytrace/math/kernel.h"
#include "raytrace/math/rgba.h"
#include "raytrace/math/simd.h"
#include "raytrace/textures/texture_point.h"
#include "raytrace/textures/vertex_color.h"

namespace raytrace {

template <>
class Kernel<VertexColor> {
 public:
  explicit Kernel(const VertexColor::Parameters&) {}

  float largest() const { return 1; }
  Rgba<FloatN> at(const TexturePoint<FloatN>& point) const { return {point.vertex_color, FloatN(1)}; }
};

}  // namespace raytrace
