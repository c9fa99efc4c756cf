// Light that surfaces pass on to each other, by path tracing (Kajiya 1986; pbrt-v4, chapter 13): from what a camera ray
// meets, a path goes on in directions that the materials draw, and gets the direct light at each of its points.
//
//   <integrator> <path> <maxdepth>8</maxdepth> </path> </integrator>
#pragma once

#include <optional>

#include "raytrace/parameters/fields.h"

namespace raytrace {

/// How a path's point chooses the shining surface that it draws light from.
enum class LightSampling {
  tree,     ///< by power, distance and direction
  power,    ///< by power
  uniform,  ///< each as often as the others
};
template <>
struct Choices<LightSampling> {
  static constexpr std::array<std::string_view, 3> words = {"tree", "power", "uniform"};
};

/// How light comes to surfaces that scatter it by way of mirrors, metals and clear glass.
enum class Caustics {
  none,     ///< on paths from the camera that chance to meet a light
  light,    ///< where the camera sees the surface: on paths that start at the lights
  photons,  ///< on such paths there, and everywhere else by photons; a bias that falls with the samples
};
template <>
struct Choices<Caustics> {
  static constexpr std::array<std::string_view, 3> words = {"none", "light", "photons"};
};

class Path {
 public:
  static constexpr int most_indirectsamples = 16;

  struct Parameters {
    int maxdepth = 16;        ///< so many scatterings at most: 1 is direct light alone
    int roulettedepth = 3;    ///< from this scattering on, paths that carry little may end
    int indirectsamples = 1;  ///< paths that go on from a camera ray's first point
    LightSampling lightsampling = LightSampling::tree;
    Caustics caustics = Caustics::none;
    double photonradius = 0;  ///< within which the first pass looks up photons; 0: found from the photons
    double clampindirect =
        0;  ///< the most radiance, in each channel, that a path brings from beyond its first point; a bias. 0: any
  };
  static constexpr std::string_view element = "path";
  static Fields fields() {
    return {optional("maxdepth", &Parameters::maxdepth, Range::positive),
            optional("roulettedepth", &Parameters::roulettedepth, Range::positive),
            optional("indirectsamples", &Parameters::indirectsamples, Range::positive),
            optional("lightsampling", &Parameters::lightsampling),
            optional("caustics", &Parameters::caustics),
            optional("photonradius", &Parameters::photonradius, Range::not_negative),
            optional("clampindirect", &Parameters::clampindirect, Range::not_negative)};
  }
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    if (parameters.indirectsamples <= most_indirectsamples) return std::nullopt;
    return ParameterDiagnostic{ParameterDiagnostic::Effect::error, "<indirectsamples> is 16 at most"};
  }
};

}  // namespace raytrace
