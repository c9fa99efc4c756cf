#include "raytrace/output/image_band.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <string>

#include "raytrace/film/aov_film.h"
#include "raytrace/film/light_layer.h"
#include "raytrace/film/splat_layer.h"
#include "raytrace/math/limbs.h"
#include "raytrace/parallel/for_each_index.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

/// What a film's sums consist of. A pixel's are written as words, whose order is that of channels_of().
struct SumLayout {
  AovSettings aovs;
  bool has_high = false, has_splats = false, has_splat_high = false;
  std::vector<std::size_t> ids{};  ///< of each coverage: as many as the pixel with the most has

  struct Light {
    bool has_high = false, has_splat_high = false;
  };
  std::vector<Light> lights{};  ///< of each of aovs.layers
};

/// Of one of AovSettings::layers, by its number: names of up to 31 characters are those that all programs read.
std::string layer_start(std::size_t layer) { return formatted("sums.layer%02zu.", layer); }

std::string coverage_name(std::size_t coverage) { return "sums.aov.cover" + std::to_string(coverage); }

std::vector<Channel> channels_of(const SumLayout& layout) {
  std::vector<Channel> channels;
  const auto add = [&](const std::string& name) { channels.push_back({name, ChannelType::uint32}); };
  const auto add_halves = [&](const std::string& name) {
    add(name + ".low");
    add(name + ".high");
  };
  const auto add_colors = [&](const std::string& start) {
    for (const char* const color : {"red", "green", "blue"}) add_halves(start + color);
  };
  add_colors("sums.");
  add("sums.hits");
  add("sums.samples");
  if (layout.has_high) add_colors("sums.limb2.");
  if (layout.has_splats) add_colors("sums.splat.");
  if (layout.has_splat_high) add_colors("sums.splat.limb2.");
  if (layout.aovs.nearest_values > 0) {
    add("sums.aov.nearest.sample");  // its index, plus 1; 0: no sample met a surface
    add("sums.aov.nearest.depth");   // a float's bits
    for (std::size_t i = 0; i < layout.aovs.nearest_values; ++i) add("sums.aov.nearest.value" + std::to_string(i));
  }
  for (std::size_t i = 0; i < layout.aovs.mean_units.size(); ++i) add_halves("sums.aov.mean" + std::to_string(i));
  for (std::size_t coverage = 0; coverage < layout.aovs.coverages; ++coverage)
    for (std::size_t i = 0; i < layout.ids[coverage]; ++i) {
      const std::string digits = formatted("%03zu", i);  // in the order of their names
      add(coverage_name(coverage) + ".id" + digits);
      add(coverage_name(coverage) + ".count" + digits);
    }
  auto light = layout.lights.begin();
  for (std::size_t i = 0; i < layout.aovs.layers.size(); ++i) {
    const std::string start = layer_start(i);
    add_colors(start);
    if (light->has_high) add_colors(start + "limb2.");
    if (layout.has_splats) add_colors(start + "splat.");
    if (light->has_splat_high) add_colors(start + "splat.limb2.");
    ++light;
  }
  return channels;
}

/// That of a film whose sums are in such channels.
SumLayout layout_of(const FilmSettings& settings, const std::vector<Channel>& channels) {
  const auto count = [&](const std::string& start) {
    return static_cast<std::size_t>(std::count_if(
        channels.begin(), channels.end(), [&](const Channel& channel) { return channel.name.starts_with(start); }));
  };
  SumLayout layout{settings.aovs, count("sums.limb2.red.low") > 0, settings.light_paths_of.has_value(),
                   settings.light_paths_of && count("sums.splat.limb2.red.low") > 0};
  for (std::size_t coverage = 0; coverage < settings.aovs.coverages; ++coverage)
    layout.ids.push_back(count(coverage_name(coverage) + ".id"));
  for (std::size_t i = 0; i < settings.aovs.layers.size(); ++i)
    layout.lights.push_back({count(layer_start(i) + "limb2.red.low") > 0,
                             layout.has_splats && count(layer_start(i) + "splat.limb2.red.low") > 0});
  return layout;
}

void append_halves(std::int64_t number, std::vector<std::uint32_t>& words) {
  words.push_back(static_cast<std::uint32_t>(number));
  words.push_back(static_cast<std::uint32_t>(static_cast<std::uint64_t>(number) >> 32U));
}

/// low, and high if there is one: of all channels.
void append_sum(const RadianceSum& sum, bool has_high, std::vector<std::uint32_t>& words) {
  for (const Int128 color : sum) append_halves(limbs_of(color).low, words);
  if (has_high)
    for (const Int128 color : sum) append_halves(limbs_of(color).high, words);
}

/// As append_sum() wrote it. take_halves(): the next number.
template <class TakeHalves>
RadianceSum take_sum(bool has_high, const TakeHalves& take_halves) {
  std::array<Limbs, 3> limbs;
  for (Limbs& color : limbs) color.low = take_halves();
  if (has_high)
    for (Limbs& color : limbs) color.high = take_halves();
  RadianceSum sum;
  std::transform(limbs.begin(), limbs.end(), sum.begin(), from_limbs);
  return sum;
}

void append_aovs(const AovFilm& aovs, const SumLayout& layout, int x, int y, std::vector<std::uint32_t>& words) {
  if (layout.aovs.nearest_values > 0) {
    const AovFilm::Nearest nearest = aovs.nearest(x, y);
    const bool any = nearest.values != nullptr;
    words.insert(words.end(), {any ? nearest.sample + 1 : 0, std::bit_cast<std::uint32_t>(nearest.depth)});
    for (std::size_t i = 0; i < layout.aovs.nearest_values; ++i) words.push_back(any ? nearest.values[i] : 0);
  }
  for (std::size_t i = 0; i < layout.aovs.mean_units.size(); ++i) append_halves(aovs.sum(x, y, i), words);
  for (std::size_t coverage = 0; coverage < layout.aovs.coverages; ++coverage) {
    std::vector<IdCount> ranked = aovs.ranked(x, y, coverage);
    ranked.resize(layout.ids[coverage]);
    for (const auto& [id, count] : ranked) words.insert(words.end(), {id, count});
  }
}

void append_words(const Film& film, const SumLayout& layout, int x, int y, std::vector<std::uint32_t>& words) {
  const PixelSum& sum = film.sum(x, y);
  for (const std::int64_t color : {sum.red, sum.green, sum.blue}) append_halves(color, words);
  words.insert(words.end(), {sum.hits, sum.samples});
  if (layout.has_high) {
    const PixelSumHigh high = film.high(x, y);
    for (const std::int64_t color : {high.red, high.green, high.blue}) append_halves(color, words);
  }
  if (layout.has_splats) append_sum(film.splats()->sum(x, y), layout.has_splat_high, words);
  if (film.aovs() != nullptr) append_aovs(*film.aovs(), layout, x, y, words);
  auto light = layout.lights.begin();
  for (const LightLayer& layer : film.lights()) {
    append_sum(layer.samples->sum(x, y), light->has_high, words);
    if (layer.splats) append_sum(layer.splats->sum(x, y), light->has_splat_high, words);
    ++light;
  }
}

std::int64_t halves(const std::uint32_t* words) {
  return static_cast<std::int64_t>(words[0] | std::uint64_t{words[1]} << 32U);
}

/// Adds what AOVs gather, but parts of the light. False as add_words(). next: their words; goes on to what comes after
/// them.
bool add_aov_words(const std::uint32_t*& next, const SumLayout& layout, const SampleRange& range, std::uint32_t samples,
                   AovFilm& aovs, int x, int y) {
  bool sound = true;
  if (layout.aovs.nearest_values > 0) {
    if (next[0] != 0) {
      const std::uint32_t index = next[0] - 1;
      sound = index >= range.first && index - range.first < range.count && samples > 0;
      aovs.add_nearest(x, y, std::bit_cast<float>(next[1]), index, next + 2);
    }
    next += 2 + layout.aovs.nearest_values;
  }
  for (std::size_t i = 0; i < layout.aovs.mean_units.size(); ++i) {
    sound = aovs.add_mean(x, y, i, halves(next)) && sound;
    next += 2;
  }
  for (std::size_t coverage = 0; coverage < layout.aovs.coverages; ++coverage) {
    std::uint32_t left = samples;  // that no id has yet
    for (std::size_t i = 0; i < layout.ids[coverage]; ++i, next += 2) {
      const IdCount one{next[0], next[1]};
      if (one.count == 0) continue;
      if (one.count > left) {
        sound = false;
        continue;
      }
      left -= one.count;
      aovs.add_coverage(x, y, coverage, one);
    }
  }
  return sound;
}

/// Adds the sums to the pixel's. False, with some of them added, if they cannot be of samples of the range.
bool add_words(const std::vector<std::uint32_t>& words, const SumLayout& layout, const SampleRange& range, Film& film,
               int x, int y) {
  const std::uint32_t* next = words.data();
  const auto take_halves = [&] {
    next += 2;
    return halves(next - 2);
  };
  PixelSum sum;
  for (std::int64_t* const color : {&sum.red, &sum.green, &sum.blue}) *color = take_halves();
  sum.hits = *next++;
  sum.samples = *next++;
  PixelSumHigh high;
  if (layout.has_high)
    for (std::int64_t* const color : {&high.red, &high.green, &high.blue}) *color = take_halves();
  if (sum.samples > range.count || sum.hits > sum.samples) return false;
  const auto fits = [&](std::int64_t low, std::int64_t high_limb) {
    const double most = sum.samples * largest_units;  // rounded, both of them
    return std::abs(std::ldexp(static_cast<double>(high_limb), 64) + static_cast<double>(low)) <= most;
  };
  if (!fits(sum.red, high.red) || !fits(sum.green, high.green) || !fits(sum.blue, high.blue)) return false;
  film.add(x, y, sum, high);
  if (layout.has_splats) {
    film.splats()->add(x, y, take_sum(layout.has_splat_high, take_halves));
    film.splats()->add_paths(sum.samples * film.splats()->paths_per_sample(x, y));
  }
  const bool sound = film.aovs() == nullptr || add_aov_words(next, layout, range, sum.samples, *film.aovs(), x, y);
  bool lights_fit = true;
  const auto take_into = [&](RadianceLayer& layer, bool has_high) {
    const RadianceSum more = take_sum(has_high, take_halves);
    constexpr double most = 0x1p120;  // beyond all that is rendered
    for (const Int128 color : more) lights_fit = lights_fit && std::abs(static_cast<double>(color)) <= most;
    if (lights_fit) layer.add(x, y, more);
  };
  auto light = layout.lights.begin();
  for (const LightLayer& layer : film.lights()) {
    take_into(*layer.samples, light->has_high);
    if (layer.splats) take_into(*layer.splats, light->has_splat_high);
    ++light;
  }
  return sound && lights_fit;
}

}  // namespace

std::vector<Channel> color_channels(bool full_float) {
  const ChannelType type = full_float ? ChannelType::float32 : ChannelType::half;
  return {{"R", type}, {"G", type}, {"B", type}, {"A", type}};
}

void make_planes(ImageBand& band, std::size_t first_plane, const std::vector<Channel>& channels) {
  const std::size_t pixels = band.region.pixels();
  band.planes.resize(std::max(band.planes.size(), first_plane + channels.size()));
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (channels[i].type == ChannelType::uint32) {
      band.planes[first_plane + i] = std::vector<std::uint32_t>(pixels);
    } else {
      band.planes[first_plane + i] = std::vector<float>(pixels);
    }
  }
}

int band_rows(int width, std::size_t channels) {
  constexpr std::size_t most_values = 4U << 20U;
  constexpr std::size_t block_rows = 16, most_blocks = 16;
  const std::size_t block_values = channels * static_cast<std::size_t>(width) * block_rows;
  return static_cast<int>(std::clamp<std::size_t>(most_values / block_values, 1, most_blocks) * block_rows);
}

void fill_color(ImageBand& band, const Film& film, int y0, int y1, int threads) {
  band.region = {film.region().x0, y0, film.region().x1, y1};
  band.planes.resize(std::max(band.planes.size(), ImageBand::colors));
  band.half_colors = film.content() == FilmContent::half_means ? film.half_mean(band.region.x0, y0).data() : nullptr;
  if (band.half_colors != nullptr) return;
  const auto width = static_cast<std::size_t>(band.region.width());
  std::array<float*, ImageBand::colors> planes;
  for (std::size_t i = 0; i < ImageBand::colors; ++i) {
    if (!std::holds_alternative<std::vector<float>>(band.planes[i])) band.planes[i] = std::vector<float>();
    auto& plane = std::get<std::vector<float>>(band.planes[i]);
    plane.resize(band.region.pixels());
    planes[i] = plane.data();
  }
  for_each_index(band.region.height(), threads, [&](int row) {
    std::size_t at = static_cast<std::size_t>(row) * width;
    for (int x = band.region.x0; x < band.region.x1; ++x, ++at) {
      const Pixel pixel = film.pixel(x, y0 + row);
      planes[0][at] = pixel.red;
      planes[1][at] = pixel.green;
      planes[2][at] = pixel.blue;
      planes[3][at] = pixel.alpha;
    }
  });
}

std::vector<Channel> sum_channels() { return channels_of({}); }

std::vector<Channel> all_sum_channels() { return channels_of({{}, true}); }

bool is_sum(const Channel& channel) { return channel.name.starts_with("sums."); }

std::vector<Channel> sum_channels(const Film& film) {
  const SplatLayer* const splats = film.splats();
  SumLayout layout{film.settings().aovs, film.has_high(), splats != nullptr, splats != nullptr && splats->has_high(),
                   std::vector<std::size_t>(film.settings().aovs.coverages)};
  for (const LightLayer& light : film.lights())
    layout.lights.push_back({light.samples->has_high(), light.splats && light.splats->has_high()});
  for_each_pixel(film.region(), [&](std::size_t, int x, int y) {
    for (std::size_t coverage = 0; coverage < layout.ids.size(); ++coverage)
      layout.ids[coverage] = std::max(layout.ids[coverage], film.aovs()->ranked(x, y, coverage).size());
  });
  return channels_of(layout);
}

std::vector<Channel> sum_channels(const FilmSettings& settings, const std::vector<Channel>& channels) {
  return channels_of(layout_of(settings, channels));
}

void append_sums(ImageBand& band, const std::vector<Channel>& sums, const Film& film) {
  const SumLayout layout = layout_of(film.settings(), sums);
  const std::size_t first = band.planes.size();
  make_planes(band, first, sums);
  std::vector<std::uint32_t*> planes;
  for (std::size_t i = 0; i < sums.size(); ++i)
    planes.push_back(std::get<std::vector<std::uint32_t>>(band.planes[first + i]).data());
  std::vector<std::uint32_t> words;
  for_each_pixel(band.region, [&](std::size_t pixel, int x, int y) {
    words.clear();
    append_words(film, layout, x, y, words);
    for (std::size_t i = 0; i < words.size(); ++i) planes[i][pixel] = words[i];
  });
}

bool add_sums(const ImageBand& band, const std::vector<Channel>& sums, const SampleRange& range, Film& film) {
  const SumLayout layout = layout_of(film.settings(), sums);
  std::vector<const std::uint32_t*> planes;
  for (std::size_t i = 0; i < sums.size(); ++i)
    planes.push_back(std::get<std::vector<std::uint32_t>>(band.planes[i]).data());
  bool sound = true;
  std::vector<std::uint32_t> words(sums.size());
  for_each_pixel(band.region, [&](std::size_t pixel, int x, int y) {
    for (std::size_t i = 0; i < words.size(); ++i) words[i] = planes[i][pixel];
    sound = add_words(words, layout, range, film, x, y) && sound;
  });
  return sound;
}

}  // namespace raytrace
