// Noise: clouds of two colours in space, by gradient noise (Perlin, "Improving Noise", 2002) in octaves, each of half
// the size and half the strength of the one before.
//
//   <noise>
//     <name>clouds</name> <color1 red="1" green="1" blue="1"/> <color2 red="0.2" green="0.3" blue="0.8"/>
//     <scale>0.5</scale> <octaves>6</octaves>
//   </noise>
//
// Octaves that are finer than a pixel fade away.
#pragma once

#include <optional>

#include "raytrace/parameters/fields.h"
#include "raytrace/textures/texture_space.h"

namespace raytrace {

class Noise {
 public:
  struct Parameters {
    Rgb<double> color1{0, 0, 0}, color2{1, 1, 1};
    double scale = 1;  ///< size of the largest clouds
    int octaves = 4;
    TextureSpace space = TextureSpace::world;
  };
  static constexpr int most_octaves = 16;
  static constexpr std::string_view group = "noises";
  static constexpr std::string_view element = "noise";
  static Fields fields() {
    return {optional("color1", &Parameters::color1), optional("color2", &Parameters::color2),
            optional("scale", &Parameters::scale, Range::positive),
            optional("octaves", &Parameters::octaves, Range::positive), optional("space", &Parameters::space)};
  }
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    if (parameters.octaves <= most_octaves) return std::nullopt;
    return ParameterDiagnostic{ParameterDiagnostic::Effect::error,
                               "<octaves> is at most " + std::to_string(most_octaves)};
  }
};

}  // namespace raytrace
