// What a film gathered for AOVs as channels of an image, so that a piece of a picture keeps all that was rendered.
#pragma once

#include <vector>

#include "raytrace/film/aov_film.h"
#include "raytrace/output/image_band.h"

namespace raytrace {

/// "sums.aov.nearest.sample", "sums.aov.mean0.low", "sums.aov.cover0.id000"..., all uint32: as many ids of a coverage
/// as the pixel with the most has.
std::vector<Channel> aov_sum_channels(const AovFilm& film);

/// Those that a file must have of a film with these settings. channels: that it has, which say how many ids there are.
std::vector<Channel> aov_sum_channels(const AovSettings& settings, const std::vector<Channel>& channels);

/// Sets the planes of these channels of the film from `first_plane` on, for the rows of band.region.
void fill_aov_sums(ImageBand& band, std::size_t first_plane, const std::vector<Channel>& channels, const AovFilm& film);

/// Adds what the band's planes from `first_plane` on hold of these channels to the film, in which the band lies, and
/// which has them. range, samples: those that they may be of, and how many each of the band's pixels has. False, with
/// some of it added, if it cannot be of these.
[[nodiscard]] bool add_aov_sums(const ImageBand& band, std::size_t first_plane, const std::vector<Channel>& channels,
                                const SampleRange& range, const std::vector<std::uint32_t>& samples, AovFilm& film);

}  // namespace raytrace
