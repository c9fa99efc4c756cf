#include "raytrace/output/aov_sum_channels.h"

#include <algorithm>
#include <bit>
#include <cstdio>
#include <string>

namespace raytrace {

namespace {

const std::string prefix = "sums.aov.";
const std::string nearest_sample = prefix + "nearest.sample";  // its index, plus 1; 0: no sample met a surface
const std::string nearest_depth = prefix + "nearest.depth";    // a float's bits

std::string nearest_value(std::size_t value) { return prefix + "nearest.value" + std::to_string(value); }

std::string mean_half(std::size_t mean, const char* half) {
  return prefix + "mean" + std::to_string(mean) + '.' + half;
}

/// part: "id" or "count".
std::string cover_part(std::size_t coverage, const char* part, std::size_t place) {
  char digits[24];
  std::snprintf(digits, sizeof digits, "%03zu", place);  // in the order of their names
  return prefix + "cover" + std::to_string(coverage) + '.' + part + digits;
}

/// The planes of the channels, by name.
template <class Word>
class Planes {
 public:
  template <class Band>
  Planes(Band& band, std::size_t first_plane, const std::vector<Channel>& channels) {
    for (std::size_t i = 0; i < channels.size(); ++i)
      planes_.push_back({channels[i].name, std::get<std::vector<std::uint32_t>>(band.planes[first_plane + i]).data()});
  }

  /// Null if there is none.
  Word* operator[](const std::string& name) const {
    const auto found = std::find_if(planes_.begin(), planes_.end(), [&](const Plane& one) { return one.name == name; });
    return found == planes_.end() ? nullptr : found->words;
  }

 private:
  struct Plane {
    std::string name;
    Word* words;
  };
  std::vector<Plane> planes_;
};

/// Calls f(pixel, x, y) for each pixel; `pixel` counts them.
template <class Function>
void for_each_pixel(const Region& region, const Function& f) {
  std::size_t pixel = 0;
  for (int y = region.y0; y < region.y1; ++y)
    for (int x = region.x0; x < region.x1; ++x) f(pixel++, x, y);
}

/// ids(coverage): how many a coverage has.
template <class Ids>
std::vector<Channel> channels_of(const AovSettings& settings, const Ids& ids) {
  std::vector<Channel> channels;
  const auto add = [&](const std::string& name) { channels.push_back({name, ChannelType::uint32}); };
  if (settings.nearest_values > 0) {
    add(nearest_sample);
    add(nearest_depth);
    for (std::size_t i = 0; i < settings.nearest_values; ++i) add(nearest_value(i));
  }
  for (std::size_t i = 0; i < settings.mean_units.size(); ++i) {
    add(mean_half(i, "low"));
    add(mean_half(i, "high"));
  }
  for (std::size_t coverage = 0; coverage < settings.coverages; ++coverage) {
    const std::size_t count = ids(coverage);
    for (std::size_t i = 0; i < count; ++i) {
      add(cover_part(coverage, "id", i));
      add(cover_part(coverage, "count", i));
    }
  }
  return channels;
}

std::size_t most_ids(const AovFilm& film, std::size_t coverage) {
  std::size_t most = 0;
  for_each_pixel(film.region(),
                 [&](std::size_t, int x, int y) { most = std::max(most, film.ranked(x, y, coverage).size()); });
  return most;
}

}  // namespace

std::vector<Channel> aov_sum_channels(const AovFilm& film) {
  return channels_of(film.settings(), [&](std::size_t coverage) { return most_ids(film, coverage); });
}

std::vector<Channel> aov_sum_channels(const AovSettings& settings, const std::vector<Channel>& channels) {
  return channels_of(settings, [&](std::size_t coverage) {
    const std::string ids = prefix + "cover" + std::to_string(coverage) + ".id";
    return static_cast<std::size_t>(std::count_if(
        channels.begin(), channels.end(), [&](const Channel& channel) { return channel.name.starts_with(ids); }));
  });
}

void fill_aov_sums(ImageBand& band, std::size_t first_plane, const std::vector<Channel>& channels,
                   const AovFilm& film) {
  const Region& region = band.region;
  const auto pixels = static_cast<std::size_t>(region.width()) * static_cast<std::size_t>(region.height());
  band.planes.resize(std::max(band.planes.size(), first_plane + channels.size()));
  for (std::size_t i = 0; i < channels.size(); ++i) band.planes[first_plane + i] = std::vector<std::uint32_t>(pixels);
  const Planes<std::uint32_t> planes(band, first_plane, channels);
  const AovSettings& settings = film.settings();
  if (settings.nearest_values > 0) {
    std::uint32_t* const sample = planes[nearest_sample];
    std::uint32_t* const depth = planes[nearest_depth];
    std::vector<std::uint32_t*> values;
    for (std::size_t i = 0; i < settings.nearest_values; ++i) values.push_back(planes[nearest_value(i)]);
    for_each_pixel(region, [&](std::size_t pixel, int x, int y) {
      const AovFilm::Nearest nearest = film.nearest(x, y);
      if (nearest.values == nullptr) return;
      sample[pixel] = nearest.sample + 1;
      depth[pixel] = std::bit_cast<std::uint32_t>(nearest.depth);
      for (std::size_t i = 0; i < values.size(); ++i) values[i][pixel] = nearest.values[i];
    });
  }
  for (std::size_t i = 0; i < settings.mean_units.size(); ++i) {
    std::uint32_t* const low = planes[mean_half(i, "low")];
    std::uint32_t* const high = planes[mean_half(i, "high")];
    for_each_pixel(region, [&](std::size_t pixel, int x, int y) {
      const auto sum = static_cast<std::uint64_t>(film.sum(x, y, i));
      low[pixel] = static_cast<std::uint32_t>(sum);
      high[pixel] = static_cast<std::uint32_t>(sum >> 32U);
    });
  }
  for (std::size_t coverage = 0; coverage < settings.coverages; ++coverage) {
    std::vector<std::uint32_t*> ids, counts;
    while (std::uint32_t* const id = planes[cover_part(coverage, "id", ids.size())]) {
      counts.push_back(planes[cover_part(coverage, "count", ids.size())]);
      ids.push_back(id);
    }
    for_each_pixel(region, [&](std::size_t pixel, int x, int y) {
      const std::vector<IdCount> ranked = film.ranked(x, y, coverage);
      for (std::size_t i = 0; i < ranked.size(); ++i) {
        ids[i][pixel] = ranked[i].id;
        counts[i][pixel] = ranked[i].count;
      }
    });
  }
}

bool add_aov_sums(const ImageBand& band, std::size_t first_plane, const std::vector<Channel>& channels,
                  const SampleRange& range, const std::vector<std::uint32_t>& samples, AovFilm& film) {
  const Planes<const std::uint32_t> planes(band, first_plane, channels);
  const AovSettings& settings = film.settings();
  bool sound = true;
  if (settings.nearest_values > 0) {
    const std::uint32_t* const sample = planes[nearest_sample];
    const std::uint32_t* const depth = planes[nearest_depth];
    std::vector<const std::uint32_t*> values;
    for (std::size_t i = 0; i < settings.nearest_values; ++i) values.push_back(planes[nearest_value(i)]);
    std::vector<std::uint32_t> words(values.size());
    for_each_pixel(band.region, [&](std::size_t pixel, int x, int y) {
      if (sample[pixel] == 0) return;
      const std::uint32_t index = sample[pixel] - 1;
      if (index < range.first || index - range.first >= range.count || samples[pixel] == 0) sound = false;
      for (std::size_t i = 0; i < values.size(); ++i) words[i] = values[i][pixel];
      film.add_nearest(x, y, std::bit_cast<float>(depth[pixel]), index, words.data());
    });
  }
  for (std::size_t i = 0; i < settings.mean_units.size(); ++i) {
    const std::uint32_t* const low = planes[mean_half(i, "low")];
    const std::uint32_t* const high = planes[mean_half(i, "high")];
    for_each_pixel(band.region, [&](std::size_t pixel, int x, int y) {
      const auto sum = static_cast<std::int64_t>(low[pixel] | std::uint64_t{high[pixel]} << 32U);
      if (!film.add_mean(x, y, i, sum)) sound = false;
    });
  }
  for (std::size_t coverage = 0; coverage < settings.coverages; ++coverage) {
    std::vector<std::uint32_t> left = samples;  // that no id has yet
    for (std::size_t i = 0;; ++i) {
      const std::uint32_t* const id = planes[cover_part(coverage, "id", i)];
      const std::uint32_t* const count = planes[cover_part(coverage, "count", i)];
      if (id == nullptr || count == nullptr) break;
      for_each_pixel(band.region, [&](std::size_t pixel, int x, int y) {
        if (count[pixel] == 0) return;
        if (count[pixel] > left[pixel]) {
          sound = false;
          return;
        }
        left[pixel] -= count[pixel];
        film.add_coverage(x, y, coverage, {id[pixel], count[pixel]});
      });
    }
  }
  return sound;
}

}  // namespace raytrace
