// What materials of all types have.
//
//   <matte> ... <opacity texture="leaf"/> </matte>      <phong> ... <opacity>0.5</opacity> </phong>
#pragma once

#include <utility>

#include "raytrace/parameters/fields.h"

namespace raytrace {

/// The name of the field, whose value in a material's parameters is `opacity`.
inline constexpr std::string_view opacity_field = "opacity";

/// A material's fields, and its opacity: the share of the rays, camera and shadow rays alike, that meet the surface.
/// The others pass as if there were none; where a picture cuts leaves out of their squares, a sample sees a leaf or
/// what is behind it.
template <class Parameters>
Fields with_opacity(Fields fields) {
  FieldInfo info{opacity_field, false, Range::not_negative};
  info.prefers_alpha = true;
  fields.emplace_back(info, &Parameters::opacity);
  return fields;
}

}  // namespace raytrace
