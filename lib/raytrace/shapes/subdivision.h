// Finer faces in place of a mesh's own, and their displacement: what meshes and models have of both.
//
//   <mesh> <file>cage.obj</file> <subdivision>3</subdivision> </mesh>
//   <mesh> <file>wall.obj</file> <subdivision>7</subdivision> <subdivisionscheme>flat</subdivisionscheme>
//     <displacement texture="bricks" height="0.04"/> <midlevel>0.5</midlevel> </mesh>
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "raytrace/parameters/fields.h"

namespace raytrace {

enum class SubdivisionScheme {
  smooth,  ///< by Catmull and Clark's rules, or Loop's (import/subdivide_mesh.h)
  flat,    ///< faces are cut, and stay where they are
};
template <>
struct Choices<SubdivisionScheme> {
  static constexpr std::array<std::string_view, 2> words = {"smooth", "flat"};
};

inline constexpr std::string_view subdivision_field = "subdivision", subdivisionscheme_field = "subdivisionscheme",
                                  displacement_field = "displacement", midlevel_field = "midlevel";

/// How often faces may be cut: one becomes 4^12, nearly 17 million.
inline constexpr int most_subdivisions = 12;

/// Parameters have
///
///   int subdivision = 0;      how often faces are cut: into four, or a polygon at first into as many as it has corners
///   SubdivisionScheme subdivisionscheme = SubdivisionScheme::smooth;
///   double displacement = 1;  how far a texture's 1 moves vertices along their normals, in the mesh's own units
///   double midlevel = 0;      of the texture, where vertices stay
template <class Parameters>
Fields with_subdivision(Fields fields) {
  fields.push_back(optional(subdivision_field, &Parameters::subdivision, Range::not_negative));
  fields.push_back(optional(subdivisionscheme_field, &Parameters::subdivisionscheme));
  FieldInfo displacement{displacement_field, false};
  displacement.number_attribute = "height";
  fields.emplace_back(displacement, &Parameters::displacement);
  fields.push_back(constant(midlevel_field, &Parameters::midlevel));
  return fields;
}

template <class Parameters>
std::optional<ParameterDiagnostic> check_subdivision(const Parameters& parameters) {
  if (parameters.subdivision <= most_subdivisions) return std::nullopt;
  return ParameterDiagnostic{ParameterDiagnostic::Effect::error,
                             "<subdivision> is at most " + std::to_string(most_subdivisions)};
}

template <class Parameters>
std::vector<ParameterWarning> subdivision_warnings(const Parameters& parameters, const IsTextured& is_textured) {
  std::vector<ParameterWarning> warnings;
  if (parameters.subdivisionscheme != SubdivisionScheme::smooth && parameters.subdivision == 0)
    warnings.push_back({subdivisionscheme_field, "<subdivisionscheme> changes nothing without a <subdivision>"});
  if (parameters.midlevel != 0 && !is_textured(displacement_field))
    warnings.push_back({midlevel_field, "<midlevel> changes nothing without a <displacement>"});
  return warnings;
}

}  // namespace raytrace
