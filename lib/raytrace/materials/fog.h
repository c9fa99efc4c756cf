// Fog: what scatters light inside of an object without a surface: mist, smoke, the air of a church.
//
//   <fog> <name>mist</name> <meanfreepath>8</meanfreepath> <color red="1" green="1" blue="1"/>
//     <anisotropy>0.5</anisotropy> </fog>
//
// It is inside of a closed object, and bends no light. It is the same everywhere, or as dense as a texture in space or
// the grid of a file says (OpenVDB, or Mitsuba's format; import/density_grid.h):
//
//   <fog> <name>smoke</name> <meanfreepath>0.1</meanfreepath> <densityfile>smoke.vdb</densityfile> </fog>
//   <fog> <name>cloud</name> <meanfreepath>0.1</meanfreepath> <density texture="clouds"/>
//     <densityfade x="2" y="1" z="2"/> </fog>
//
// All that they say multiplies 1 / meanfreepath. Both are in the space that the scene's file has, or, where the objects
// are in a group, in that of the group. Paths are scattered in it and lose what it
// absorbs, and it is lit by all lights (tracing/path_fog.cpp); to all other integrators it is not there. Where it is
// in the same place as what is clear, such as water, that counts; of several fogs, the one that the path came into
// last.
#pragma once

#include <cmath>
#include <optional>

#include "raytrace/parameters/fields.h"
#include "raytrace/text/extension.h"

namespace raytrace {

class Fog {
 public:
  /// T: double, or a batch.
  template <class T>
  struct Values {
    T meanfreepath = T(0);           ///< how far light goes in it, on average, until it is scattered or absorbed
    Rgb<T> color{T(1), T(1), T(1)};  ///< the share of it that is scattered
    T anisotropy = T(0);             ///< the mean cosine between the ways before and after a scattering
    T density = T(1);                ///< by how much more there is of it
    Rgb<T> ce{T(0), T(0), T(0)};     ///< what it sends: this radiance, of so much that nothing shines through
  };
  struct Parameters : Values<double> {
    FileName densityfile;   ///< .vdb or .vol
    Reference densitygrid;  ///< of several in the file; none: "density", or else the first
    /// Along each axis, how far inside of the bounds of the fog's objects a texture's density has grown to what the
    /// texture says: it takes away as much as the texture is at most at the bounds, and less from there on.
    Vec3d densityfade{0, 0, 0};
  };
  static constexpr std::string_view density_field = "density";
  /// A <transform> moves the density.
  static constexpr bool may_be_moved = true;
  static constexpr std::string_view group = "fogs";
  static constexpr std::string_view element = "fog";
  static Fields fields() {
    FieldInfo path{"meanfreepath", true, Range::positive};
    path.is_constant = true;
    return {Field(path, &Parameters::meanfreepath),
            constant("color", &Parameters::color, Range::not_negative),
            constant("anisotropy", &Parameters::anisotropy),
            constant("ce", &Parameters::ce, Range::not_negative),
            optional(density_field, &Parameters::density, Range::not_negative),
            optional("densityfile", &Parameters::densityfile),
            optional("densitygrid", &Parameters::densitygrid, Range::identifier),
            optional("densityfade", &Parameters::densityfade, Range::not_negative)};
  }
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    const auto error = [](const char* message) {
      return ParameterDiagnostic{ParameterDiagnostic::Effect::error, message};
    };
    const Rgb<double>& color = parameters.color;
    if (color.red > 1 || color.green > 1 || color.blue > 1)
      return error("the fog's <color> is above 1: light would grow inside");
    if (std::abs(parameters.anisotropy) > 1) return error("the fog's <anisotropy> is not between -1 and 1");
    const std::string& file = parameters.densityfile.path;
    if (!file.empty() && !has_extension(file, ".vdb") && !has_extension(file, ".vol"))
      return error("the fog's <densityfile> is neither a .vdb nor a .vol");
    if (!parameters.densitygrid.name.empty() && !has_extension(file, ".vdb"))
      return error("the fog's <densitygrid> names a grid of a .vdb file, and its <densityfile> is none");
    return std::nullopt;
  }
};

}  // namespace raytrace
