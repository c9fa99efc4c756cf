// Shapes under transforms that leave them what they are.
#pragma once

#include <optional>

#include "raytrace/math/affine.h"
#include "raytrace/parameters/fields.h"

namespace raytrace {

/// The parameters of the transformed shape, if it is still one of its type. A type that stays so under more transforms
/// than those of the same scale in all directions, or under fewer, has a function of this name. In others, vectors that
/// are no points are edges or directions of any length, and numbers are sizes.
template <class Shape>
std::optional<typename Shape::Parameters> transformed(typename Shape::Parameters parameters, const Affine& affine) {
  if constexpr (requires { Shape::transformed(parameters, affine); }) {
    return Shape::transformed(parameters, affine);
  } else {
    const std::optional<double> scale = affine.uniform_scale();
    if (!scale) return std::nullopt;
    for (const Field& field : element_type<Shape>().fields) {
      if (field.is<double>()) field.get<double>(&parameters) *= *scale;
      if (!field.is<Vec3d>()) continue;
      Vec3d& vector = field.get<Vec3d>(&parameters);
      vector = field.is_point ? affine.point(vector) : affine.vector(vector);
    }
    return parameters;
  }
}

/// Whether the texture coordinates of the transformed shape, by its new numbers, are those that it had before. Those
/// of most shapes are counted from the world's axes.
template <class Shape>
bool keeps_uv(const Affine& affine) {
  if constexpr (requires { Shape::keeps_uv(affine); }) {
    return Shape::keeps_uv(affine);
  } else {
    return affine.keeps_axes();
  }
}

}  // namespace raytrace
