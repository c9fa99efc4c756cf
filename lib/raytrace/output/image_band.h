// Rows of a picture as a list of named channels, colour and data alike: what goes into image files; and what of a film
// goes into such rows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "raytrace/film/film.h"

namespace raytrace {

/// How a file stores a channel's values. Only EXR has the choice, and keeps it.
enum class ChannelType { half, float32, uint32 };

struct Channel {
  std::string name;  ///< as EXR has it: "R", "Z", "N.X", "crypto_object00.R"
  ChannelType type = ChannelType::float32;
  friend bool operator==(const Channel&, const Channel&) = default;
};

/// A channel's values, row by row: floats for ChannelType::half and float32, integers for uint32.
using ChannelValues = std::variant<std::vector<float>, std::vector<std::uint32_t>>;

struct ImageBand {
  /// The first channels of every picture: red, green, blue and alpha.
  static constexpr std::size_t colors = 4;

  Region region;                      ///< whole rows of a picture's region
  std::vector<ChannelValues> planes;  ///< of the picture's channels, in their order: a value for each pixel
  /// Where it is not null, the first four planes are empty, and their values stand here: Film::half_means().
  const std::uint16_t* half_colors = nullptr;
};

/// Calls f(pixel, x, y) for each pixel of the region, row by row; `pixel` counts them.
template <class Function>
void for_each_pixel(const Region& region, const Function& f) {
  std::size_t pixel = 0;
  for (int y = region.y0; y < region.y1; ++y)
    for (int x = region.x0; x < region.x1; ++x) f(pixel++, x, y);
}

/// R, G, B and A: 16 bits each, or 32.
std::vector<Channel> color_channels(bool full_float);

/// Makes the planes from `first_plane` on, of these channels and with a 0 for each pixel of band.region.
void make_planes(ImageBand& band, std::size_t first_plane, const std::vector<Channel>& channels);

/// Rows of a band of the picture whose planes together take a few megabytes: a multiple of 16, since EXR compresses
/// that many rows together, and 16 times 16 at most, which is enough for the threads that compress them. Larger bands
/// would only take memory, which costs time where it comes fresh from the system.
int band_rows(int width, std::size_t channels);

/// The film's rows [y0, y1) as the first four planes of `band`, those of color_channels(); further ones stay. Planes
/// that are there are filled again, so that bands of one size take memory once. From a film of half_means, nothing is
/// copied: it must outlive the band. threads: as RenderSettings::threads.
void fill_color(ImageBand& band, const Film& film, int y0, int y1, int threads = 1);

/// "sums.red.low", "sums.red.high", ... (the halves of 64 bit numbers), "sums.hits" and "sums.samples", all uint32.
std::vector<Channel> sum_channels();

/// These and, for what 64 bits cannot hold, "sums.limb2.red.low"... (Film::high).
std::vector<Channel> all_sum_channels();

/// Whether it is one of them, or of an AOV's sums: by its name.
bool is_sum(const Channel& channel);

/// Those that the film needs: the second limbs only where one is not zero; "sums.splat.red.low"... of what light paths
/// brought, if it has them; then those of what it gathered for AOVs,
/// "sums.aov.nearest.sample", "sums.aov.mean0.low", "sums.aov.cover0.id000"...: as many ids of a coverage as the pixel
/// with the most has.
std::vector<Channel> sum_channels(const Film& film);

/// Those that a file must have of a film with these settings. channels: that it has, which say how many ids there are.
std::vector<Channel> sum_channels(const FilmSettings& settings, const std::vector<Channel>& channels);

/// Appends the film's sums of the band's rows as planes. sums: sum_channels(film), or all_sum_channels() of a film
/// without AOVs.
void append_sums(ImageBand& band, const std::vector<Channel>& sums, const Film& film);

/// Adds the band's sums to those of the film's pixels that it holds. sums: the channels of the band's planes, the first
/// of them sum_channels(); range: of the samples that they may hold. False, with some of them added, if they cannot be
/// sums of such samples.
[[nodiscard]] bool add_sums(const ImageBand& band, const std::vector<Channel>& sums, const SampleRange& range,
                            Film& film);

}  // namespace raytrace
