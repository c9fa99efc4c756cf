// AOVs by their names, and what a film and a file need for some of them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "raytrace/aovs/aov_table.h"
#include "raytrace/description/scene_description.h"
#include "raytrace/film/aov_settings.h"
#include "raytrace/film/film.h"
#include "raytrace/output/image_band.h"
#include "raytrace/output/image_file.h"

namespace raytrace {

/// All of the table, in its order. Those of light groups are none of it: light_NAME.
std::vector<std::string> aov_names();
std::vector<std::string> aov_names(const AovSet& aovs);

/// names: all of them in aov_names(), or of light groups. Throws std::invalid_argument for another, with those there
/// are.
AovSet aov_set(const std::vector<std::string>& names);

/// "light_key" -> "key": none if that is no name of an AOV of a light group.
std::optional<std::string> light_group_of(std::string_view aov);

/// The set for a scene of these light groups (description/light_groups.h): with the names of all if it wants all.
/// Throws std::invalid_argument for a group that the scene does not have, with what to write instead.
AovSet with_light_groups(AovSet aovs, const std::vector<std::string>& groups);

/// But for the units of means, which are 0, and the ids, as an empty film of a file's sums needs it.
AovSettings aov_settings(const AovSet& aovs);

/// For a film that takes samples of the scene. samples: the most that a pixel will have, with those of other parts of
/// the picture.
AovSettings aov_settings(const AovSet& aovs, const AovBounds& bounds, const SceneDescription& description,
                         std::uint64_t samples);

std::vector<Channel> aov_channels(const AovSet& aovs);

/// The names of the ids that the channels have, and how Cryptomatte's are made.
std::vector<ImageAttribute> aov_attributes(const AovSet& aovs, const SceneDescription& description);

/// The names of a channel's ids as an attribute of the picture, "raytrace:manifest/id.object": a JSON array, the name
/// of id 1 first.
ImageAttribute id_manifest(std::string_view channel, const std::vector<std::string>& names);

/// Sets the planes of aov_channels() from `first_plane` on to the values of the rows of band.region.
void fill_aovs(ImageBand& band, std::size_t first_plane, const Film& film);

}  // namespace raytrace
