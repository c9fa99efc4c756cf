#include "raytrace/output/film_channels.h"

#include <array>

#include "raytrace/film/aov_film.h"
#include "raytrace/output/aov_sum_channels.h"

namespace raytrace {

namespace {

constexpr std::size_t halves = 6, planes = halves + 2;

using Words = std::array<std::uint32_t, planes>;

Words words_of(const PixelSum& sum) {
  Words words{};
  std::size_t next = 0;
  for (const std::int64_t total : {sum.red, sum.green, sum.blue}) {
    const auto bits = static_cast<std::uint64_t>(total);
    words[next++] = static_cast<std::uint32_t>(bits);
    words[next++] = static_cast<std::uint32_t>(bits >> 32U);
  }
  words[next++] = sum.hits;
  words[next] = sum.samples;
  return words;
}

PixelSum sum_of(const Words& words) {
  const auto total = [&](std::size_t low) {
    return static_cast<std::int64_t>(words[low] | std::uint64_t{words[low + 1]} << 32U);
  };
  return {total(0), total(2), total(4), words[halves], words[halves + 1]};
}

/// Whether the sum can be of samples of the range, and the total can hold it, too.
bool add(const PixelSum& sum, const SampleRange& range, PixelSum& total) {
  const bool empty = sum.red == 0 && sum.green == 0 && sum.blue == 0;
  if (sum.samples > range.count || sum.hits > sum.samples || (sum.samples == 0 && !empty)) return false;
  total.hits += sum.hits;
  total.samples += sum.samples;
  return !__builtin_add_overflow(total.red, sum.red, &total.red) &&
         !__builtin_add_overflow(total.green, sum.green, &total.green) &&
         !__builtin_add_overflow(total.blue, sum.blue, &total.blue);
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
  for (const char* name : {"sums.red.low", "sums.red.high", "sums.green.low", "sums.green.high", "sums.blue.low",
                           "sums.blue.high", "sums.hits", "sums.samples"})
    channels.push_back({name, ChannelType::uint32});
  return channels;
}

bool is_sum(const Channel& channel) { return channel.name.starts_with("sums."); }

std::vector<Channel> sum_channels(const Film& film) {
  std::vector<Channel> channels = sum_channels();
  if (film.aovs() == nullptr) return channels;
  for (Channel& channel : aov_sum_channels(*film.aovs())) channels.push_back(std::move(channel));
  return channels;
}

std::vector<Channel> sum_channels(const AovSettings& aovs, const std::vector<Channel>& channels) {
  std::vector<Channel> wanted = sum_channels();
  for (Channel& channel : aov_sum_channels(aovs, channels)) wanted.push_back(std::move(channel));
  return wanted;
}

void append_sums(ImageBand& band, const std::vector<Channel>& sums, const Film& film) {
  const Region& region = band.region;
  const std::size_t first = band.planes.size();
  const auto pixels = static_cast<std::size_t>(region.width()) * static_cast<std::size_t>(region.height());
  for (std::size_t plane = 0; plane < planes; ++plane) band.planes.emplace_back(std::vector<std::uint32_t>(pixels));
  std::size_t pixel = 0;
  for (int y = region.y0; y < region.y1; ++y)
    for (int x = region.x0; x < region.x1; ++x, ++pixel) {
      const Words words = words_of(film.sum(x, y));
      for (std::size_t plane = 0; plane < planes; ++plane) words_in(band, first + plane)[pixel] = words[plane];
    }
  if (film.aovs() != nullptr) fill_aov_sums(band, first + planes, {sums.begin() + planes, sums.end()}, *film.aovs());
}

bool add_sums(const ImageBand& band, const std::vector<Channel>& sums, const SampleRange& range, Film& film) {
  const Region& region = band.region;
  bool sound = true;
  std::size_t pixel = 0;
  for (int y = region.y0; y < region.y1; ++y)
    for (int x = region.x0; x < region.x1; ++x, ++pixel) {
      Words words{};
      for (std::size_t plane = 0; plane < planes; ++plane) words[plane] = words_in(band, plane)[pixel];
      sound = add(sum_of(words), range, film.sum(x, y)) && sound;
    }
  if (!sound || film.aovs() == nullptr) return sound;
  return add_aov_sums(band, planes, {sums.begin() + planes, sums.end()}, range, words_in(band, planes - 1),
                      *film.aovs());
}

}  // namespace raytrace
