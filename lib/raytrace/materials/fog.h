// Fog: what scatters light inside of an object without a surface: mist, smoke, the air of a church.
//
//   <fog> <name>mist</name> <meanfreepath>8</meanfreepath> <color red="1" green="1" blue="1"/>
//     <anisotropy>0.5</anisotropy> </fog>
//
// It is inside of a closed object, the same everywhere, and bends no light. Paths are scattered in it and lose what it
// absorbs, and it is lit by all lights (tracing/path_fog.cpp); to all other integrators it is not there. Where it is
// in the same place as what is clear, such as water, that counts; of several fogs, the one that the path came into
// last.
#pragma once

#include <cmath>
#include <optional>

#include "raytrace/parameters/fields.h"

namespace raytrace {

class Fog {
 public:
  /// T: double, or a batch.
  template <class T>
  struct Values {
    T meanfreepath = T(0);           ///< how far light goes in it, on average, until it is scattered or absorbed
    Rgb<T> color{T(1), T(1), T(1)};  ///< the share of it that is scattered
    T anisotropy = T(0);             ///< the mean cosine between the ways before and after a scattering
  };
  using Parameters = Values<double>;
  static constexpr std::string_view group = "fogs";
  static constexpr std::string_view element = "fog";
  static Fields fields() {
    FieldInfo path{"meanfreepath", true, Range::positive};
    path.is_constant = true;
    return {Field(path, &Parameters::meanfreepath), constant("color", &Parameters::color, Range::not_negative),
            constant("anisotropy", &Parameters::anisotropy)};
  }
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    const auto error = [](const char* message) {
      return ParameterDiagnostic{ParameterDiagnostic::Effect::error, message};
    };
    const Rgb<double>& color = parameters.color;
    if (color.red > 1 || color.green > 1 || color.blue > 1)
      return error("the fog's <color> is above 1: light would grow inside");
    if (std::abs(parameters.anisotropy) > 1) return error("the fog's <anisotropy> is not between -1 and 1");
    return std::nullopt;
  }
};

}  // namespace raytrace
