// The sums of a film as channels of an image, so that a piece of a picture keeps all that was rendered.
#pragma once

#include "raytrace/film/film.h"
#include "raytrace/output/image_band.h"

namespace raytrace {

/// "sums.red.low", "sums.red.high", ... (the halves of 64 bit numbers), "sums.hits" and "sums.samples", all uint32.
std::vector<Channel> sum_channels();

/// These, and then those of what the film gathered for AOVs.
std::vector<Channel> sum_channels(const Film& film);

/// The same of those that a file has.
std::vector<Channel> sum_channels(const std::vector<Channel>& channels);

/// Appends the film's sums of the band's rows as planes. sums: sum_channels(film).
void append_sums(ImageBand& band, const std::vector<Channel>& sums, const Film& film);

/// Adds the band's sums to those of the film's pixels that it holds. sums: the channels of the band's planes from
/// first_plane on, the first of them sum_channels().
void add_sums(const ImageBand& band, std::size_t first_plane, const std::vector<Channel>& sums, Film& film);

}  // namespace raytrace
