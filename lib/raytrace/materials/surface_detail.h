// What materials of all types have: opacity, normal maps and bumps. Those whose reflection differs along the surface
// have tangents, too.
//
//   <matte> ... <opacity texture="leaf"/> <normalmap texture="tiles" strength="0.8"/> </matte>
//   <phong> ... <opacity>0.5</opacity> <bump texture="bark" height="0.02"/> </phong>
//   <conductor> ... <tangentmap texture="brushed"/> <tangentrotation>90</tangentrotation> </conductor>
#pragma once

#include <utility>

#include "raytrace/parameters/fields.h"

namespace raytrace {

// The names of their fields, and of the members for them in a material's parameters.
inline constexpr std::string_view opacity_field = "opacity", normalmap_field = "normalmap", bump_field = "bump",
                                  tangentrotation_field = "tangentrotation", tangentmap_field = "tangentmap",
                                  coatnormalmap_field = "coatnormalmap";

/// A material's own fields, and
///   opacity: the share of the rays, camera and shadow rays alike, that meet the surface. The others pass as if there
///     were none; where a picture cuts leaves out of their squares, a sample sees a leaf or what is behind it.
template <class Parameters>
Fields with_opacity(Fields fields) {
  FieldInfo opacity{opacity_field, false, Range::not_negative};
  opacity.prefers_alpha = true;
  fields.emplace_back(opacity, &Parameters::opacity);
  return fields;
}

/// The same, and
///   normalmap: a texture of shading normals, x along u, y along v and z out of the surface, each from -1 at 0 to 1 at
///     1; x and y are multiplied by its strength;
///   bump: a texture of heights in space over the surface, multiplied by its height, that shading follows.
template <class Parameters>
Fields with_surface_detail(Fields fields) {
  fields = with_opacity<Parameters>(std::move(fields));
  FieldInfo normalmap{normalmap_field, false};
  normalmap.number_attribute = "strength";
  normalmap.whole_color = true;
  fields.emplace_back(normalmap, &Parameters::normalmap);
  FieldInfo bump{bump_field, false};
  bump.number_attribute = "height";
  fields.emplace_back(bump, &Parameters::bump);
  return fields;
}

/// The fields of a material whose reflection differs along the surface, and
///   tangentrotation: degrees by which the tangent turns from where u grows towards where v grows;
///   tangentmap: a texture of tangents before that turn, x along u and y along v, each from -1 at 0 to 1 at 1.
template <class Parameters>
Fields with_tangent(Fields fields) {
  fields.emplace_back(FieldInfo{tangentrotation_field, false}, &Parameters::tangentrotation);
  FieldInfo tangentmap{tangentmap_field, false};
  tangentmap.whole_color = true;
  fields.emplace_back(tangentmap, &Parameters::tangentmap);
  return fields;
}

/// The fields of a material with a coat, and
///   coatnormalmap: as normalmap, of the coat alone. Without it a coat is smooth, whatever relief is below it.
template <class Parameters>
Fields with_coat_normals(Fields fields) {
  FieldInfo coatnormalmap{coatnormalmap_field, false};
  coatnormalmap.number_attribute = "strength";
  coatnormalmap.whole_color = true;
  fields.emplace_back(coatnormalmap, &Parameters::coatnormalmap);
  return fields;
}

/// Whether a field of this name is one of all these, and none of the material's own.
inline bool is_surface_detail(std::string_view field) {
  return field == opacity_field || field == normalmap_field || field == bump_field || field == tangentrotation_field ||
         field == tangentmap_field || field == coatnormalmap_field;
}

}  // namespace raytrace
