// The sums of a film as channels of an image, so that a piece of a picture keeps all that was rendered.
#pragma once

#include "raytrace/film/film.h"
#include "raytrace/output/image_band.h"

namespace raytrace {

/// "sums.red.low", "sums.red.high", ... (the halves of 64 bit numbers), "sums.hits" and "sums.samples", all uint32.
std::vector<Channel> sum_channels();

/// Appends the film's sums of the band's rows as planes, in the order of sum_channels().
void append_sums(ImageBand& band, const Film& film);

/// Adds the band's sums to those of the film's pixels that it holds. first_plane: of the band's sum_channels().
void add_sums(const ImageBand& band, std::size_t first_plane, Film& film);

}  // namespace raytrace
