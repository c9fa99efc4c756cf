#include "raytrace/output/film_channels.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "raytrace/film/aov_film.h"
#include "raytrace/math/limbs.h"
#include "raytrace/output/aov_sum_channels.h"

namespace raytrace {

namespace {

constexpr std::array<const char*, 8> names = {"sums.red.low",  "sums.red.high",  "sums.green.low", "sums.green.high",
                                              "sums.blue.low", "sums.blue.high", "sums.hits",      "sums.samples"};
constexpr std::array<const char*, 6> limb_names = {"sums.limb2.red.low",   "sums.limb2.red.high",
                                                   "sums.limb2.green.low", "sums.limb2.green.high",
                                                   "sums.limb2.blue.low",  "sums.limb2.blue.high"};
constexpr std::size_t planes = names.size(), limb_planes = limb_names.size();

using Words = std::array<std::uint32_t, planes + limb_planes>;

Words words_of(const PixelSum& sum, const PixelSumHigh& high) {
  Words words{};
  const auto split = [&](std::size_t first, std::int64_t number) {
    words[first] = static_cast<std::uint32_t>(number);
    words[first + 1] = static_cast<std::uint32_t>(static_cast<std::uint64_t>(number) >> 32U);
  };
  split(0, sum.red);
  split(2, sum.green);
  split(4, sum.blue);
  words[6] = sum.hits;
  words[7] = sum.samples;
  split(planes, high.red);
  split(planes + 2, high.green);
  split(planes + 4, high.blue);
  return words;
}

/// Adds the sum if it can be of samples of the range.
bool add(const Words& words, const SampleRange& range, Film& film, int x, int y) {
  const auto number = [&](std::size_t first) {
    return static_cast<std::int64_t>(words[first] | std::uint64_t{words[first + 1]} << 32U);
  };
  const PixelSum sum{number(0), number(2), number(4), words[6], words[7]};
  const PixelSumHigh high{number(planes), number(planes + 2), number(planes + 4)};
  if (sum.samples > range.count || sum.hits > sum.samples) return false;
  const auto fits = [&](std::int64_t low, std::int64_t high_limb) {
    const double most = sum.samples * largest_units;  // rounded, both of them
    return std::abs(std::ldexp(static_cast<double>(high_limb), 64) + static_cast<double>(low)) <= most;
  };
  if (!fits(sum.red, high.red) || !fits(sum.green, high.green) || !fits(sum.blue, high.blue)) return false;
  film.add(x, y, sum, high);
  return true;
}

bool has_limbs(const std::vector<Channel>& channels) {
  return std::any_of(channels.begin(), channels.end(),
                     [](const Channel& channel) { return channel.name == limb_names.front(); });
}

template <std::size_t count>
void append(std::vector<Channel>& channels, const std::array<const char*, count>& more) {
  for (const char* name : more) channels.push_back({name, ChannelType::uint32});
}

void append(std::vector<Channel>& channels, std::vector<Channel> more) {
  for (Channel& channel : more) channels.push_back(std::move(channel));
}

std::vector<std::uint32_t>& words_in(ImageBand& band, std::size_t plane) {
  return std::get<std::vector<std::uint32_t>>(band.planes[plane]);
}
const std::vector<std::uint32_t>& words_in(const ImageBand& band, std::size_t plane) {
  return std::get<std::vector<std::uint32_t>>(band.planes[plane]);
}

}  // namespace

std::vector<Channel> sum_channels() {
  std::vector<Channel> channels;
  append(channels, names);
  return channels;
}

std::vector<Channel> all_sum_channels() {
  std::vector<Channel> channels = sum_channels();
  append(channels, limb_names);
  return channels;
}

bool is_sum(const Channel& channel) { return channel.name.starts_with("sums."); }

std::vector<Channel> sum_channels(const Film& film) {
  std::vector<Channel> channels = film.has_high() ? all_sum_channels() : sum_channels();
  if (film.aovs() != nullptr) append(channels, aov_sum_channels(*film.aovs()));
  return channels;
}

std::vector<Channel> sum_channels(const AovSettings& aovs, const std::vector<Channel>& channels) {
  std::vector<Channel> wanted = has_limbs(channels) ? all_sum_channels() : sum_channels();
  append(wanted, aov_sum_channels(aovs, channels));
  return wanted;
}

void append_sums(ImageBand& band, const std::vector<Channel>& sums, const Film& film) {
  const Region& region = band.region;
  const std::size_t first = band.planes.size(), own = has_limbs(sums) ? planes + limb_planes : planes;
  const auto pixels = static_cast<std::size_t>(region.width()) * static_cast<std::size_t>(region.height());
  for (std::size_t plane = 0; plane < own; ++plane) band.planes.emplace_back(std::vector<std::uint32_t>(pixels));
  std::size_t pixel = 0;
  for (int y = region.y0; y < region.y1; ++y)
    for (int x = region.x0; x < region.x1; ++x, ++pixel) {
      const Words words = words_of(film.sum(x, y), film.high(x, y));
      for (std::size_t plane = 0; plane < own; ++plane) words_in(band, first + plane)[pixel] = words[plane];
    }
  if (film.aovs() != nullptr)
    fill_aov_sums(band, first + own, {sums.begin() + static_cast<std::ptrdiff_t>(own), sums.end()}, *film.aovs());
}

bool add_sums(const ImageBand& band, const std::vector<Channel>& sums, const SampleRange& range, Film& film) {
  const Region& region = band.region;
  const std::size_t own = has_limbs(sums) ? planes + limb_planes : planes;
  bool sound = true;
  std::size_t pixel = 0;
  for (int y = region.y0; y < region.y1; ++y)
    for (int x = region.x0; x < region.x1; ++x, ++pixel) {
      Words words{};
      for (std::size_t plane = 0; plane < own; ++plane) words[plane] = words_in(band, plane)[pixel];
      sound = add(words, range, film, x, y) && sound;
    }
  if (!sound || film.aovs() == nullptr) return sound;
  return add_aov_sums(band, own, {sums.begin() + static_cast<std::ptrdiff_t>(own), sums.end()}, range,
                      words_in(band, planes - 1), *film.aovs());
}

}  // namespace raytrace
