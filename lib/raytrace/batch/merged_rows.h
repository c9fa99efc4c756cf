// What the rows of a merged picture are filled with.
#pragma once

#include "raytrace/film/film.h"
#include "raytrace/output/image_band.h"

namespace raytrace {

/// Where pieces are missing: checks of 8 x 8 pixels in two greys with alpha 0. Nobody takes them for a part of the
/// picture. (But "over" adds them to what is behind a transparent one.)
void fill_missing(ImageBand& band);

/// A piece's rows, all of which are in the band, to the same planes.
void copy_rows(const ImageBand& from, ImageBand& to);

/// The means of all pixels that have sums.
void copy_means(const Film& sums, ImageBand& band);

}  // namespace raytrace
