// Arbitrary output variables: what a picture can hold of each pixel besides its colour.
//
// An AOV provides
//   static constexpr std::string_view name;             as --aov spells it
//   static constexpr AovRule rule;                      how a pixel's samples become its value
// and, as the rule has it:
//   nearest, mean:
//     static constexpr std::array<std::string_view, n> channels;
//     template <class Surface> static auto values(const Surface&);     n packets: scene/aov_inputs.h
//   nearest:
//     static constexpr ChannelType type;                float32, or uint32 with the values' bits
//     static constexpr float nothing;                   float32: the value of a pixel that sees no surface
//   mean:
//     static float largest(const Scene&);               no value is larger, either sign; those that are count as 0
//   coverage (Cryptomatte): the channels follow from the name;
//     template <class Surface> static auto index(const Surface&);      of the thing met
//     static std::vector<std::string> names(const SceneDescription&);  of the things, in the order of their indices
//   film:
//     static constexpr std::array<std::string_view, 1> channels;
//     static std::uint32_t value(const PixelSum&);
// An AOV whose numbers need explanation in the file adds
//   static std::vector<ImageAttribute> attributes(const SceneDescription&);
#pragma once

namespace raytrace {

/// How samples become a pixel's value (film/aov_film.h says it exactly).
enum class AovRule {
  nearest,   ///< the value at the sample that met the nearest surface
  mean,      ///< the mean of all samples, those that met nothing counting as 0
  coverage,  ///< the share of the samples that met each thing, by id
  film,      ///< what the film itself counts
};

}  // namespace raytrace
