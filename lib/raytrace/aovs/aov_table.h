// Arbitrary output variables (AOVs): what a picture can hold of each pixel besides its colour.
//
// All of them are the table below. A new AOV: a line in it and, unless the film knows its value, a case in
// tracing/aov_values.h, which says how a hit gives it. (docs/how-to-add-a-type.md)
#pragma once

#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "raytrace/description/scene_description.h"
#include "raytrace/film/light_pass.h"
#include "raytrace/output/image_band.h"
#include "raytrace/output/image_file.h"

namespace raytrace {

/// What objects are called where a picture has ids of them, in the order that objects are counted in: type by type as
/// in the Shapes registry, each type's as the file has them, and behind them the parts of meshes, mesh by mesh. An
/// object without a name is called by its type and its number among that type's, counted from 1: "sphere#12"; a part by
/// its name in the mesh's file, with "NAME/" before it if the mesh is called NAME. Where another is called so, or has
/// the Cryptomatte id of that name, "sphere#12#2", "sphere#12#3"...
std::vector<std::string> object_names(const SceneDescription& description);

/// The same of materials: type by type as in the Materials registry, each type's as the file has them.
std::vector<std::string> material_names(const SceneDescription& description);

/// How samples become a pixel's value (film/aov_film.h says it exactly).
enum class AovRule {
  nearest,   ///< the value at the sample that met the nearest surface
  mean,      ///< the mean of all samples, those that met nothing counting as 0
  coverage,  ///< the share of the samples that met each object, or each material, by id: Cryptomatte
  samples,   ///< how many samples the pixel has
  light,     ///< the mean of a part of the light: a LightPass
};

/// What a scene's values may reach.
struct AovBounds {
  float albedo = 0;  ///< of any material in use, in any channel, by magnitude
};

struct Aov {
  std::string_view name;  ///< as --aov spells it
  AovRule rule;
  /// In the file, one for each value; those of a coverage follow from the name.
  const char* channel_names[3] = {};
  ChannelType type = ChannelType::float32;
  /// nearest, of floats: the value of a pixel without a hit; it is 0 of integers.
  float without_hit = 0;
  /// mean: no value is larger, of either sign; one that is counts as 0.
  float (*bound)(const AovBounds& bounds) = nullptr;
  /// The names of what its ids stand for, in the order of their indices.
  std::vector<std::string> (*names)(const SceneDescription& description) = nullptr;
  /// mean: where paths are traced, it is of the first surface on the way of a sample that is neither a mirror nor
  /// clear.
  bool follows_mirrors = false;

  /// What a sample, or for a coverage its index, takes in AovSettings.
  constexpr std::size_t values() const {
    std::size_t count = 0;
    for (const char* const channel : channel_names) count += channel != nullptr ? 1 : 0;
    return rule == AovRule::coverage ? 1 : count;
  }
};

/// The order is that of the values in films and of the channels in checkpoints.
inline constexpr Aov aov_table[] = {
    // How far the nearest surface is, measured along the camera's viewing direction and not along the ray: a wall
    // across the view has one depth. In world units, from the eye.
    Aov{.name = "depth", .rule = AovRule::nearest, .channel_names = {"Z"}, .without_hit = 1e30F},
    // Where the nearest surface is, in world space.
    Aov{.name = "position", .rule = AovRule::nearest, .channel_names = {"P.X", "P.Y", "P.Z"}},
    // The surface's unit normal in world space, on the camera's side. Its bound leaves room for rounding.
    Aov{.name = "normal",
        .rule = AovRule::mean,
        .channel_names = {"N.X", "N.Y", "N.Z"},
        .bound = [](const AovBounds&) { return 1.001F; }},
    // The share of light that the material scatters diffusely (kd * cd).
    Aov{.name = "albedo",
        .rule = AovRule::mean,
        .channel_names = {"albedo.R", "albedo.G", "albedo.B"},
        .bound = [](const AovBounds& bounds) { return bounds.albedo; }},
    // The same of what a pixel shows, in mirrors and behind glass as well, in the colour that they give it: what a
    // denoiser takes for edges and textures. Of the last surface if a way ends in a mirror or in glass.
    Aov{.name = "denoise_albedo",
        .rule = AovRule::mean,
        .channel_names = {"denoise_albedo.R", "denoise_albedo.G", "denoise_albedo.B"},
        .bound = [](const AovBounds& bounds) { return bounds.albedo; },
        .follows_mirrors = true},
    // The unit normal there, in world space, on the side that the ray comes from.
    Aov{.name = "denoise_normal",
        .rule = AovRule::mean,
        .channel_names = {"denoise_normal.X", "denoise_normal.Y", "denoise_normal.Z"},
        .bound = [](const AovBounds&) { return 1.001F; },
        .follows_mirrors = true},
    // The nearest object and its material, by their numbers in the scene, counted from 1; 0: none.
    Aov{.name = "object_id",
        .rule = AovRule::nearest,
        .channel_names = {"id.object"},
        .type = ChannelType::uint32,
        .names = object_names},
    Aov{.name = "material_id",
        .rule = AovRule::nearest,
        .channel_names = {"id.material"},
        .type = ChannelType::uint32,
        .names = material_names},
    Aov{.name = "crypto_object", .rule = AovRule::coverage, .names = object_names},
    Aov{.name = "crypto_material", .rule = AovRule::coverage, .names = material_names},
    Aov{.name = "samples", .rule = AovRule::samples, .channel_names = {"samples"}, .type = ChannelType::uint32},
    // The light by what it was scattered by first on the way from the camera (film/light_pass.h, in that order).
    Aov{.name = "diffuse_direct",
        .rule = AovRule::light,
        .channel_names = {"diffuse_direct.R", "diffuse_direct.G", "diffuse_direct.B"}},
    Aov{.name = "diffuse_indirect",
        .rule = AovRule::light,
        .channel_names = {"diffuse_indirect.R", "diffuse_indirect.G", "diffuse_indirect.B"}},
    Aov{.name = "specular_direct",
        .rule = AovRule::light,
        .channel_names = {"specular_direct.R", "specular_direct.G", "specular_direct.B"}},
    Aov{.name = "specular_indirect",
        .rule = AovRule::light,
        .channel_names = {"specular_indirect.R", "specular_indirect.G", "specular_indirect.B"}},
    Aov{.name = "transmission_direct",
        .rule = AovRule::light,
        .channel_names = {"transmission_direct.R", "transmission_direct.G", "transmission_direct.B"}},
    Aov{.name = "transmission_indirect",
        .rule = AovRule::light,
        .channel_names = {"transmission_indirect.R", "transmission_indirect.G", "transmission_indirect.B"}},
    Aov{.name = "volume_direct",
        .rule = AovRule::light,
        .channel_names = {"volume_direct.R", "volume_direct.G", "volume_direct.B"}},
    Aov{.name = "volume_indirect",
        .rule = AovRule::light,
        .channel_names = {"volume_indirect.R", "volume_indirect.G", "volume_indirect.B"}},
    Aov{.name = "emission", .rule = AovRule::light, .channel_names = {"emission.R", "emission.G", "emission.B"}},
    Aov{.name = "background",
        .rule = AovRule::light,
        .channel_names = {"background.R", "background.G", "background.B"}},
};

/// Where in the table the passes begin.
inline constexpr std::size_t first_light_pass = std::size(aov_table) - light_pass_count;
static_assert([] {
  for (std::size_t i = 0; i < light_pass_count; ++i)
    if (const Aov& aov = aov_table[first_light_pass + i]; aov.rule != AovRule::light || aov.name != light_pass_names[i])
      return false;
  return aov_table[first_light_pass - 1].rule != AovRule::light;
}());

/// How many values all AOVs of a rule have together.
constexpr std::size_t all_values(AovRule rule) {
  std::size_t count = 0;
  for (const Aov& aov : aov_table) count += aov.rule == rule ? aov.values() : 0;
  return count;
}

}  // namespace raytrace
