#include "raytrace/aovs/aov_selection.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <unordered_map>
#include <unordered_set>

#include "raytrace/aovs/cryptomatte.h"
#include "raytrace/description/parse_value.h"
#include "raytrace/film/aov_film.h"
#include "raytrace/film/light_layer.h"
#include "raytrace/parameters/light_group.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

const std::string light_prefix(light_aov_prefix);

std::vector<Aov> selected(const AovSet& aovs) {
  std::vector<Aov> list;
  for (std::size_t i = 0; i < std::size(aov_table); ++i)
    if (aovs.has(i)) list.push_back(aov_table[i]);
  return list;
}

/// value: the first of the AOV's among those of the nearest samples.
template <class Value>
void fill_nearest(Value* plane, const Region& rows, std::size_t value, Value without_hit, const AovFilm& film) {
  for_each_pixel(rows, [&](std::size_t pixel, int x, int y) {
    const std::uint32_t* const values = film.nearest(x, y).values;
    plane[pixel] = values == nullptr ? without_hit : std::bit_cast<Value>(values[value]);
  });
}

void fill_mean(float* plane, const Region& rows, std::size_t mean, const Film& film) {
  const double unit = std::ldexp(1.0, film.settings().aovs.mean_units[mean]);
  for_each_pixel(rows, [&](std::size_t pixel, int x, int y) {
    const std::uint32_t samples = film.sum(x, y).samples;
    if (samples == 0) return;
    plane[pixel] = static_cast<float>(static_cast<double>(film.aovs()->sum(x, y, mean)) / samples * unit);
  });
}

/// planes: the id of each pair, and its share.
void fill_coverage(ChannelValues* planes, const Region& rows, std::size_t coverage, const Film& film) {
  for_each_pixel(rows, [&](std::size_t pixel, int x, int y) {
    const std::vector<IdCount> ranked = film.aovs()->ranked(x, y, coverage);
    const auto samples = static_cast<double>(film.sum(x, y).samples);
    for (std::size_t i = 0; i < std::min(ranked.size(), cryptomatte::pairs); ++i) {
      std::get<std::vector<float>>(planes[2 * i])[pixel] = std::bit_cast<float>(ranked[i].id);
      std::get<std::vector<float>>(planes[2 * i + 1])[pixel] = static_cast<float>(ranked[i].count / samples);
    }
  });
}

std::vector<Channel> file_channels(const Aov& aov) {
  if (aov.rule == AovRule::coverage) return cryptomatte::channels(aov.name);
  std::vector<Channel> channels;
  for (std::size_t i = 0; i < aov.values(); ++i) channels.push_back({aov.channel_names[i], aov.type});
  return channels;
}

}  // namespace

std::vector<std::string> aov_names() {
  std::vector<std::string> names;
  for (const Aov& aov : aov_table) names.emplace_back(aov.name);
  return names;
}

std::vector<std::string> aov_names(const AovSet& aovs) {
  std::vector<std::string> names;
  for (const Aov& aov : selected(aovs)) names.emplace_back(aov.name);
  for (const std::string& group : aovs.light_groups()) names.push_back(light_prefix + group);
  return names;
}

AovSet aov_set(const std::vector<std::string>& names) {
  AovSet set;
  for (std::size_t i = 0; i < std::size(aov_table); ++i)
    if (std::find(names.begin(), names.end(), aov_table[i].name) != names.end()) set.add(i);
  for (const std::string& name : names) {
    const auto is_of_table = [&](const Aov& aov) { return aov.name == name; };
    if (const auto group = light_group_of(name))
      set.add_light_group(*group);
    else if (std::none_of(std::begin(aov_table), std::end(aov_table), is_of_table))
      throw std::invalid_argument("there is no AOV " + in_quotes(name) + "; there are " + joined(aov_names(), ", ") +
                                  ", and light_NAME");
  }
  return set;
}

std::optional<std::string> light_group_of(std::string_view aov) {
  if (!aov.starts_with(light_prefix) || aov.size() == light_prefix.size()) return std::nullopt;
  aov.remove_prefix(light_prefix.size());
  if (check_value(Reference{std::string(aov)}, Range::identifier)) return std::nullopt;
  return std::string(aov);
}

AovSet with_light_groups(AovSet aovs, const std::vector<std::string>& groups) {
  if (aovs.wants_all_light_groups && groups.size() > 1)
    for (const std::string& group : groups) aovs.add_light_group(group);
  aovs.wants_all_light_groups = false;
  for (const std::string& group : aovs.light_groups()) {
    if (std::find(groups.begin(), groups.end(), group) != groups.end()) continue;
    std::vector<std::string> names;
    for (const std::string& name : groups) names.push_back(light_prefix + name);
    throw std::invalid_argument("no light of the scene is in the group " + in_quotes(group) + "; there are " +
                                joined(names, ", "));
  }
  return aovs;
}

AovSettings aov_settings(const AovSet& aovs) {
  AovSettings settings;
  settings.wanted = aovs;
  for (const Aov& aov : selected(aovs)) {
    if (aov.rule == AovRule::nearest) settings.nearest_values += aov.values();
    if (aov.rule == AovRule::mean) settings.mean_units.resize(settings.mean_units.size() + aov.values());
    if (aov.rule == AovRule::coverage) ++settings.coverages;
    if (aov.rule == AovRule::light) settings.layers.emplace_back(aov.name);
  }
  for (const std::string& group : aovs.light_groups()) settings.layers.push_back(light_prefix + group);
  return settings;
}

AovSettings aov_settings(const AovSet& aovs, const AovBounds& bounds, const SceneDescription& description,
                         std::uint64_t samples) {
  AovSettings settings = aov_settings(aovs);
  AovSettings::CoverageIds coverage_ids;
  auto next_unit = settings.mean_units.begin();
  for (const Aov& aov : selected(aovs)) {
    if (aov.rule == AovRule::mean)
      next_unit = std::fill_n(next_unit, aov.values(), unit_exponent(aov.bound(bounds), samples));
    if (aov.rule == AovRule::coverage) {
      std::vector<std::uint32_t>& ids = coverage_ids.emplace_back();
      for (const std::string& name : aov.names(description)) ids.push_back(cryptomatte::id_of(name));
    }
  }
  settings.coverage_ids = std::make_shared<const AovSettings::CoverageIds>(std::move(coverage_ids));
  return settings;
}

std::vector<Channel> aov_channels(const AovSet& aovs) {
  std::vector<Channel> channels;
  for (const Aov& aov : selected(aovs))
    for (Channel& channel : file_channels(aov)) channels.push_back(std::move(channel));
  for (const std::string& group : aovs.light_groups())
    for (const char* const color : {".R", ".G", ".B"})
      channels.push_back({light_prefix + group + color, ChannelType::float32});
  return channels;
}

std::vector<ImageAttribute> aov_attributes(const AovSet& aovs, const SceneDescription& description) {
  std::vector<ImageAttribute> attributes;
  for (const Aov& aov : selected(aovs)) {
    if (aov.names == nullptr) continue;
    const std::vector<std::string> names = aov.names(description);
    if (aov.rule == AovRule::coverage) {
      for (ImageAttribute& attribute : cryptomatte::attributes(aov.name, names))
        attributes.push_back(std::move(attribute));
    } else {
      attributes.push_back(id_manifest(aov.channel_names[0], names));
    }
  }
  return attributes;
}

void fill_aovs(ImageBand& band, std::size_t first_plane, const Film& film) {
  const Region& rows = band.region;
  const AovSet& wanted = film.settings().aovs.wanted;
  make_planes(band, first_plane, aov_channels(wanted));
  ChannelValues* plane = band.planes.data() + first_plane;
  std::size_t next_nearest = 0, next_mean = 0, next_coverage = 0;
  for (const Aov& aov : selected(wanted)) {
    if (aov.rule == AovRule::light) break;  // the table's last, which follow as layers
    if (aov.rule == AovRule::coverage) {
      fill_coverage(plane, rows, next_coverage++, film);
      plane += 2 * cryptomatte::pairs;
      continue;
    }
    for (std::size_t i = 0; i < aov.values(); ++i, ++plane) {
      auto* const floats = std::get_if<std::vector<float>>(plane);
      auto* const integers = std::get_if<std::vector<std::uint32_t>>(plane);
      if (aov.rule == AovRule::mean) {
        fill_mean(floats->data(), rows, next_mean++, film);
      } else if (aov.rule == AovRule::samples) {
        for_each_pixel(rows, [&](std::size_t pixel, int x, int y) { (*integers)[pixel] = film.sum(x, y).samples; });
      } else if (integers != nullptr) {
        fill_nearest(integers->data(), rows, next_nearest++, std::uint32_t{0}, *film.aovs());
      } else {
        fill_nearest(floats->data(), rows, next_nearest++, aov.without_hit, *film.aovs());
      }
    }
  }
  for (const LightLayer& light : film.lights()) {
    std::array<float*, 3> colors;
    for (float*& color : colors) color = std::get<std::vector<float>>(*plane++).data();
    for_each_pixel(rows, [&](std::size_t pixel, int x, int y) {
      const Pixel mean = film.light_pixel(light, x, y);
      colors[0][pixel] = mean.red;
      colors[1][pixel] = mean.green;
      colors[2][pixel] = mean.blue;
    });
  }
}

std::vector<std::string> object_names(const SceneDescription& description) {
  std::vector<std::string> names;
  for_each_type(Objects{}, [&]<class Object>(std::type_identity<Object>) {
    for (const auto& item : std::get<ObjectItems<Object>>(description.objects)) names.push_back(item.name);
  });
  std::unordered_set<std::uint32_t> taken;
  taken.reserve(names.size());
  for (const std::string& name : names)
    if (!name.empty()) taken.insert(cryptomatte::id_of(name));

  std::unordered_map<std::string, int> next_numbers;  // of names that many have
  const auto free_name = [&](const std::string& usual) {
    if (taken.insert(cryptomatte::id_of(usual)).second) return usual;
    int& next = next_numbers.try_emplace(usual, 2).first->second;
    std::string name;
    do name = usual + '#' + std::to_string(next++);
    while (!taken.insert(cryptomatte::id_of(name)).second);
    return name;
  };
  auto name = names.begin();
  for_each_type(Objects{}, [&]<class Object>(std::type_identity<Object>) {
    const std::size_t count = std::get<ObjectItems<Object>>(description.objects).size();
    for (std::size_t number = 1; number <= count; ++number, ++name)
      if (name->empty()) *name = free_name(std::string(Object::element) + '#' + std::to_string(number));
  });
  for (const auto& mesh : std::get<ObjectItems<Mesh>>(description.objects)) {
    if (mesh.data == nullptr) continue;
    for (const MeshPart& part : mesh.data->parts)
      names.push_back(free_name(mesh.name.empty() ? part.name : mesh.name + '/' + part.name));
  }
  return names;
}

std::vector<std::string> material_names(const SceneDescription& description) {
  std::vector<std::string> names;
  for_each_type(Materials{}, [&](auto type) {
    using Material = typename decltype(type)::type;
    for (const auto& item : std::get<MaterialItems<Material>>(description.materials)) names.push_back(item.name);
  });
  return names;
}

ImageAttribute id_manifest(std::string_view channel, const std::vector<std::string>& names) {
  return {"raytrace:manifest/" + std::string(channel),
          nlohmann::json(names).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)};
}

}  // namespace raytrace
