// The sums of a film as channels of an image, so that a piece of a picture keeps all that was rendered.
#pragma once

#include "raytrace/film/film.h"
#include "raytrace/output/image_band.h"

namespace raytrace {

/// "sums.red.low", "sums.red.high", ... (the halves of 64 bit numbers), "sums.hits" and "sums.samples", all uint32.
std::vector<Channel> sum_channels();

/// These and, for what 64 bits cannot hold, "sums.limb2.red.low"... (Film::high).
std::vector<Channel> all_sum_channels();

/// Whether it is one of them, or of an AOV's sums: by its name.
bool is_sum(const Channel& channel);

/// Those that the film needs: the second limbs only where one is not zero; then those of what it gathered for AOVs,
/// "sums.aov.nearest.sample", "sums.aov.mean0.low", "sums.aov.cover0.id000"...: as many ids of a coverage as the pixel
/// with the most has.
std::vector<Channel> sum_channels(const Film& film);

/// Those that a file must have of a film with these settings. channels: that it has, which say how many ids there are.
std::vector<Channel> sum_channels(const AovSettings& aovs, const std::vector<Channel>& channels);

/// Appends the film's sums of the band's rows as planes. sums: sum_channels(film), or all_sum_channels() of a film
/// without AOVs.
void append_sums(ImageBand& band, const std::vector<Channel>& sums, const Film& film);

/// Adds the band's sums to those of the film's pixels that it holds. sums: the channels of the band's planes, the first
/// of them sum_channels(); range: of the samples that they may hold. False, with some of them added, if they cannot be
/// sums of such samples.
[[nodiscard]] bool add_sums(const ImageBand& band, const std::vector<Channel>& sums, const SampleRange& range,
                            Film& film);

}  // namespace raytrace
