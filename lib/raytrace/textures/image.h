// Image: a picture file as a texture.
//
//   <image>
//     <name>wood</name> <file>wood.jpg</file> <wrap>mirror</wrap> <wrapv>clamp</wrapv>
//     <uvscale x="4" y="4"/> <uvrotation>90</uvrotation>
//   </image>
//
// (0, 0) is the picture's lower left corner and (1, 1) its upper right one, with u to the right and v upwards. The
// place in the picture is the surface's, scaled, then turned, then moved. valuescale multiplies what is there, alpha
// included, and valueoffset is added to that: a mask becomes sharp, or a number from 0.2 to 0.5.
//
// Of a file with <UDIM> or %(UDIM)d in its name there are several, each of which covers a unit of u and v (udim.h).
#pragma once

#include <array>
#include <string>

#include "raytrace/parameters/fields.h"
#include "raytrace/textures/udim.h"
#include "raytrace/textures/uv_set.h"

namespace raytrace {

/// Whether the numbers of the file are sRGB's, which follow the eye, or proportional to light.
enum class ColorSpace {
  automatic,  ///< sRGB for colours of 8 bits; linear for all else, and wherever a number is wanted
  srgb,
  linear,
};
template <>
struct Choices<ColorSpace> {
  static constexpr std::array<std::string_view, 3> words = {"auto", "srgb", "linear"};
};

/// What is beyond the picture's edges.
enum class Wrap { repeat, mirror, clamp, black };
template <>
struct Choices<Wrap> {
  static constexpr std::array<std::string_view, 4> words = {"repeat", "mirror", "clamp", "black"};
};

/// What is above and below; `same`: as Wrap has it for both.
enum class WrapV { same, repeat, mirror, clamp, black };
template <>
struct Choices<WrapV> {
  static constexpr std::array<std::string_view, 5> words = {"same", "repeat", "mirror", "clamp", "black"};
};

enum class TextureFilter {
  smart,    ///< between texels from near, means of them from afar
  nearest,  ///< the texel at hand
};
template <>
struct Choices<TextureFilter> {
  static constexpr std::array<std::string_view, 2> words = {"smart", "nearest"};
};

class Image {
 public:
  struct Parameters {
    FileName file;
    ColorSpace colorspace = ColorSpace::automatic;
    Wrap wrap = Wrap::repeat;
    WrapV wrapv = WrapV::same;
    TextureFilter filter = TextureFilter::smart;
    Vec2d uvscale{1, 1};    ///< how often the picture fits into one unit of u and v
    Vec2d uvoffset{0, 0};   ///< added to the place in the picture
    double uvrotation = 0;  ///< degrees by which the place turns about (0, 0), from u to v
    double valuescale = 1, valueoffset = 0;
    UvSet uvset = UvSet::first;
    bool vertexalpha = false;  ///< the alphas of a mesh's vertices multiply what is in the picture, before valuescale
  };
  static constexpr std::string_view group = "images";
  static constexpr std::string_view element = "image";
  static constexpr std::string_view wrapv_field = "wrapv";
  static Fields fields() {
    return {required("file", &Parameters::file),
            optional("colorspace", &Parameters::colorspace),
            optional("wrap", &Parameters::wrap),
            optional(wrapv_field, &Parameters::wrapv),
            optional("filter", &Parameters::filter),
            optional("uvscale", &Parameters::uvscale),
            optional("uvoffset", &Parameters::uvoffset),
            optional("uvrotation", &Parameters::uvrotation),
            optional("valuescale", &Parameters::valuescale),
            optional("valueoffset", &Parameters::valueoffset),
            optional("uvset", &Parameters::uvset),
            optional("vertexalpha", &Parameters::vertexalpha)};
  }
  static std::optional<ParameterDiagnostic> check(const Parameters& parameters) {
    using enum ParameterDiagnostic::Effect;
    if (parameters.file.path.empty()) return ParameterDiagnostic{error, "an image needs a <file>"};
    if (is_udim(parameters.file.path) && (parameters.wrap != Wrap::repeat || wrap_v(parameters) != Wrap::repeat))
      return ParameterDiagnostic{
          error, "an image of UDIM tiles has neither <wrap> nor <wrapv>: beyond a tile is the next one"};
    return std::nullopt;
  }

  static Wrap wrap_v(const Parameters& parameters) {
    return parameters.wrapv == WrapV::same ? parameters.wrap
                                           : static_cast<Wrap>(static_cast<int>(parameters.wrapv) - 1);
  }
  /// That is always this one, whatever <wrap> is.
  static WrapV own_wrap_v(Wrap wrap) { return static_cast<WrapV>(static_cast<int>(wrap) + 1); }
};

}  // namespace raytrace
