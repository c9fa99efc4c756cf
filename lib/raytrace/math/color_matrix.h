// Linear maps of colours: from one set of primaries to another, or from one light's white to another's.
#pragma once

#include <array>
#include <cstddef>

#include "raytrace/math/color.h"

namespace raytrace {

/// Row by row; colours are columns.
using ColorMatrix = std::array<std::array<double, 3>, 3>;

constexpr Rgb<double> product(const ColorMatrix& matrix, const Rgb<double>& color) {
  const auto part = [&](const std::array<double, 3>& row) {
    return row[0] * color.red + row[1] * color.green + row[2] * color.blue;
  };
  return {part(matrix[0]), part(matrix[1]), part(matrix[2])};
}

/// Of a matrix that has one.
constexpr ColorMatrix inverse(const ColorMatrix& m) {
  ColorMatrix result{};
  double determinant = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t a = (j + 1) % 3, b = (j + 2) % 3, c = (i + 1) % 3, d = (i + 2) % 3;
      result[i][j] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
    }
    determinant += m[0][i] * result[i][0];
  }
  for (auto& row : result)
    for (double& value : row) value /= determinant;
  return result;
}

}  // namespace raytrace
