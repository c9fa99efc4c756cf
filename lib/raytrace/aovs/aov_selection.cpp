#include "raytrace/aovs/aov_selection.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "raytrace/aovs/cryptomatte.h"
#include "raytrace/aovs/registry.h"
#include "raytrace/film/aov_film.h"

namespace raytrace {

namespace {

/// Calls f(type) for each wanted AOV, in the registry's order.
template <class Function>
void for_each_wanted(const AovSet& wanted, Function&& f) {
  for_each_type(Aovs{}, [&](auto type) {
    if (wanted.has(index_of<typename decltype(type)::type>(Aovs{}))) f(type);
  });
}

/// Where the planes of a band are filled, pixel by pixel.
class PlaneWriter {
 public:
  PlaneWriter(ImageBand& band, std::size_t first_plane, const std::vector<Channel>& channels) : band_(band) {
    const auto pixels = static_cast<std::size_t>(band.region.width()) * static_cast<std::size_t>(band.region.height());
    band.planes.resize(std::max(band.planes.size(), first_plane + channels.size()));
    for (std::size_t i = 0; i < channels.size(); ++i) {
      if (channels[i].type == ChannelType::uint32) {
        band.planes[first_plane + i] = std::vector<std::uint32_t>(pixels);
      } else {
        band.planes[first_plane + i] = std::vector<float>(pixels);
      }
    }
    next_plane_ = first_plane;
  }

  template <class Value>
  Value* next() {
    return std::get<std::vector<Value>>(band_.planes[next_plane_++]).data();
  }

  /// Calls f(pixel, x, y) for each pixel of the band; `pixel` counts them.
  template <class Function>
  void for_each_pixel(const Function& f) const {
    const Region& region = band_.region;
    std::size_t pixel = 0;
    for (int y = region.y0; y < region.y1; ++y)
      for (int x = region.x0; x < region.x1; ++x) f(pixel++, x, y);
  }

 private:
  ImageBand& band_;
  std::size_t next_plane_;
};

/// How many values of each rule the AOVs before the current one have.
struct ValueCounts {
  std::size_t nearest = 0, means = 0, coverages = 0;
};

template <class Aov>
void fill_nearest(PlaneWriter& planes, std::size_t first_value, const AovFilm& film) {
  for (std::size_t i = 0; i < Aov::channels.size(); ++i) {
    const auto fill = [&](auto* const plane, auto nothing) {
      planes.for_each_pixel([&](std::size_t pixel, int x, int y) {
        const std::uint32_t* const values = film.nearest(x, y).values;
        plane[pixel] = values == nullptr ? nothing : std::bit_cast<decltype(nothing)>(values[first_value + i]);
      });
    };
    if constexpr (Aov::type == ChannelType::uint32) {
      fill(planes.next<std::uint32_t>(), std::uint32_t{0});
    } else {
      fill(planes.next<float>(), Aov::nothing);
    }
  }
}

template <class Aov>
void fill_mean(PlaneWriter& planes, std::size_t first_mean, const Film& film) {
  for (std::size_t i = 0; i < Aov::channels.size(); ++i) {
    float* const plane = planes.next<float>();
    const std::size_t mean = first_mean + i;
    const double unit = std::ldexp(1.0, film.settings().aovs.mean_units[mean]);
    planes.for_each_pixel([&](std::size_t pixel, int x, int y) {
      const std::uint32_t samples = film.sum(x, y).samples;
      if (samples == 0) return;
      plane[pixel] = static_cast<float>(static_cast<double>(film.aovs()->sum(x, y, mean)) / samples * unit);
    });
  }
}

void fill_coverage(PlaneWriter& planes, std::size_t coverage, const Film& film) {
  float* planes_of_pairs[cryptomatte::pairs][2];
  for (auto& pair : planes_of_pairs)
    for (float*& plane : pair) plane = planes.next<float>();
  planes.for_each_pixel([&](std::size_t pixel, int x, int y) {
    const std::vector<IdCount> ranked = film.aovs()->ranked(x, y, coverage);
    const auto samples = static_cast<double>(film.sum(x, y).samples);
    for (std::size_t i = 0; i < std::min(ranked.size(), cryptomatte::pairs); ++i) {
      planes_of_pairs[i][0][pixel] = std::bit_cast<float>(ranked[i].id);
      planes_of_pairs[i][1][pixel] = static_cast<float>(ranked[i].count / samples);
    }
  });
}

}  // namespace

std::vector<std::string> aov_names() {
  std::vector<std::string> names;
  for_each_type(Aovs{}, [&](auto type) { names.emplace_back(decltype(type)::type::name); });
  return names;
}

std::vector<std::string> aov_names(const AovSet& aovs) {
  std::vector<std::string> names;
  for_each_wanted(aovs, [&](auto type) { names.emplace_back(decltype(type)::type::name); });
  return names;
}

AovSet aov_set(const std::vector<std::string>& names) {
  const std::vector<std::string> all = aov_names();
  AovSet set;
  for (const std::string& name : names)
    set.add(static_cast<std::size_t>(std::find(all.begin(), all.end(), name) - all.begin()));
  return set;
}

AovSettings aov_settings(const AovSet& aovs) {
  AovSettings settings;
  settings.wanted = aovs;
  for_each_wanted(aovs, [&](auto type) {
    using Aov = typename decltype(type)::type;
    if constexpr (Aov::rule == AovRule::nearest) settings.nearest_values += Aov::channels.size();
    if constexpr (Aov::rule == AovRule::mean)
      settings.mean_units.insert(settings.mean_units.end(), Aov::channels.size(), 0);
    if constexpr (Aov::rule == AovRule::coverage) ++settings.coverages;
  });
  return settings;
}

AovSettings aov_settings(const AovSet& aovs, const Scene& scene, const SceneDescription& description,
                         std::uint64_t samples) {
  AovSettings settings = aov_settings(aovs);
  AovSettings::CoverageIds coverage_ids;
  auto next_unit = settings.mean_units.begin();
  for_each_wanted(aovs, [&](auto type) {
    using Aov = typename decltype(type)::type;
    if constexpr (Aov::rule == AovRule::mean)
      next_unit = std::fill_n(next_unit, Aov::channels.size(), unit_exponent(Aov::largest(scene), samples));
    if constexpr (Aov::rule == AovRule::coverage) {
      std::vector<std::uint32_t>& ids = coverage_ids.emplace_back();
      for (const std::string& name : Aov::names(description)) ids.push_back(cryptomatte::id_of(name));
    }
  });
  settings.coverage_ids = std::make_shared<const AovSettings::CoverageIds>(std::move(coverage_ids));
  return settings;
}

std::vector<Channel> aov_channels(const AovSet& aovs) {
  std::vector<Channel> channels;
  const auto add = [&](const auto& names, ChannelType channel_type) {
    for (const std::string_view name : names) channels.push_back({std::string(name), channel_type});
  };
  for_each_wanted(aovs, [&](auto type) {
    using Aov = typename decltype(type)::type;
    if constexpr (Aov::rule == AovRule::nearest) add(Aov::channels, Aov::type);
    if constexpr (Aov::rule == AovRule::mean) add(Aov::channels, ChannelType::float32);
    if constexpr (Aov::rule == AovRule::film) add(Aov::channels, ChannelType::uint32);
    if constexpr (Aov::rule == AovRule::coverage) {
      const std::vector<Channel> pairs = cryptomatte::channels(Aov::name);
      channels.insert(channels.end(), pairs.begin(), pairs.end());
    }
  });
  return channels;
}

std::vector<ImageAttribute> aov_attributes(const AovSet& aovs, const SceneDescription& description) {
  std::vector<ImageAttribute> attributes;
  const auto add = [&](std::vector<ImageAttribute> more) {
    for (ImageAttribute& attribute : more) attributes.push_back(std::move(attribute));
  };
  for_each_wanted(aovs, [&](auto type) {
    using Aov = typename decltype(type)::type;
    if constexpr (Aov::rule == AovRule::coverage) add(cryptomatte::attributes(Aov::name, Aov::names(description)));
    if constexpr (requires { Aov::attributes(description); }) add(Aov::attributes(description));
  });
  return attributes;
}

void fill_aovs(ImageBand& band, std::size_t first_plane, const Film& film) {
  const AovSet& wanted = film.settings().aovs.wanted;
  PlaneWriter planes(band, first_plane, aov_channels(wanted));
  ValueCounts before;
  for_each_wanted(wanted, [&](auto type) {
    using Aov = typename decltype(type)::type;
    if constexpr (Aov::rule == AovRule::nearest) {
      fill_nearest<Aov>(planes, before.nearest, *film.aovs());
      before.nearest += Aov::channels.size();
    } else if constexpr (Aov::rule == AovRule::mean) {
      fill_mean<Aov>(planes, before.means, film);
      before.means += Aov::channels.size();
    } else if constexpr (Aov::rule == AovRule::coverage) {
      fill_coverage(planes, before.coverages++, film);
    } else {
      std::uint32_t* const plane = planes.next<std::uint32_t>();
      planes.for_each_pixel([&](std::size_t pixel, int x, int y) { plane[pixel] = Aov::value(film.sum(x, y)); });
    }
  });
}

}  // namespace raytrace
