// Arbitrary output variables (AOVs): what a picture can hold of each pixel besides its colour.
//
// All of them are the table below. A new AOV: a line in it and, unless the film knows its value, a case in
// tracing/aov_values.h, which says how a hit gives it. (docs/how-to-add-a-type.md)
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "raytrace/description/scene_description.h"
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
};

/// How many values all AOVs of a rule have together.
constexpr std::size_t all_values(AovRule rule) {
  std::size_t count = 0;
  for (const Aov& aov : aov_table) count += aov.rule == rule ? aov.values() : 0;
  return count;
}

}  // namespace raytrace
