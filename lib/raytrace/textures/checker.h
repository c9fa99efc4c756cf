// Checker: squares on a surface, or cubes in space, of two colours in turn.
//
//   <checker>
//     <name>tiles</name> <color1 red="1" green="1" blue="1"/> <color2 red="0" green="0" blue="0"/> <scale>0.5</scale>
//   </checker>
//
// From afar it is the mean of both, weighted as a pixel sees them: it does not flicker.
#pragma once

#include <optional>

#include "raytrace/parameters/fields.h"
#include "raytrace/textures/texture_space.h"
#include "raytrace/textures/uv_set.h"

namespace raytrace {

class Checker {
 public:
  struct Parameters {
    Rgb<double> color1{1, 1, 1}, color2{0, 0, 0};
    Vec2d uvscale{1, 1};  ///< how many squares fit into one unit of u and v
    double scale = 0;     ///< edge of the cubes in space that are there in place of squares; 0: none are
    UvSet uvset = UvSet::first;
    TextureSpace space = TextureSpace::world;  ///< of the cubes
  };
  static constexpr std::string_view group = "checkers";
  static constexpr std::string_view element = "checker";
  static Fields fields() {
    return {optional("color1", &Parameters::color1),   optional("color2", &Parameters::color2),
            optional("uvscale", &Parameters::uvscale), optional("scale", &Parameters::scale, Range::not_negative),
            optional("uvset", &Parameters::uvset),     optional("space", &Parameters::space)};
  }
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    const auto error = [](const char* message) {
      return ParameterDiagnostic{ParameterDiagnostic::Effect::error, message};
    };
    const bool on_surface = parameters.uvscale.x != 1 || parameters.uvscale.y != 1;
    if (parameters.scale != 0 && on_surface)
      return error("<uvscale> is for squares on a surface, and <scale> for cubes in space; remove one");
    if (parameters.scale == 0 && parameters.space == TextureSpace::object)
      return error("<space> is for cubes in space, which have a <scale>; squares are on the object");
    return std::nullopt;
  }
};

}  // namespace raytrace
