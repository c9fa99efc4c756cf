// Colours of meshes' vertices, between which they change evenly.
#pragma once

#include <cmath>

#include "raytrace/math/kernel.h"
#include "raytrace/math/rgba.h"
#include "raytrace/math/simd.h"
#include "raytrace/textures/texture_point.h"
#include "raytrace/textures/vertex_color.h"

namespace raytrace {

template <>
class Kernel<VertexColor> {
 public:
  explicit Kernel(const VertexColor::Parameters& parameters)
      : value_scale_(static_cast<float>(parameters.valuescale)),
        value_offset_(static_cast<float>(parameters.valueoffset)) {}

  float largest() const { return std::abs(value_scale_) + std::abs(value_offset_); }
  Rgba<FloatN> at(const TexturePoint<FloatN>& point) const {
    const Rgba<FloatN> value{point.vertex_color, point.vertex_alpha};
    return value_scale_ == 1 && value_offset_ == 0 ? value : scaled(value, value_scale_, value_offset_);
  }

 private:
  float value_scale_, value_offset_;
};

}  // namespace raytrace
