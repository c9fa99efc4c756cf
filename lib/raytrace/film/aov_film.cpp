#include "raytrace/film/aov_film.h"

#include <algorithm>
#include <bit>

#include "raytrace/math/content_hash.h"

namespace raytrace {

AovFilm::AovFilm(const Region& region, const AovSettings& settings) : region_(region), settings_(settings) {
  const std::size_t pixels = region_.pixels();
  nearest_.resize(pixels * nearest_words(settings_));
  sums_.resize(pixels * means());
  coverages_.resize(pixels * settings_.coverages);
}

std::size_t AovFilm::pixel_bytes(const AovSettings& settings) {
  return nearest_words(settings) * sizeof(std::uint32_t) + settings.mean_units.size() * sizeof(std::int64_t) +
         settings.coverages * sizeof(Coverage);
}

void AovFilm::add_nearest(int x, int y, float depth, std::uint32_t sample, const std::uint32_t* values) {
  std::uint32_t* const words = nearest_.data() + region_.index(x, y) * nearest_words(settings_);
  const std::uint32_t index = sample + 1;
  if (words[index_word] != 0) {
    const float before = std::bit_cast<float>(words[depth_word]);
    if (before < depth || (before == depth && words[index_word] <= index)) return;
  }
  words[index_word] = index;
  words[depth_word] = std::bit_cast<std::uint32_t>(depth);
  std::copy_n(values, settings_.nearest_values, words + key_words);
}

AovFilm::Nearest AovFilm::nearest(int x, int y) const {
  const std::uint32_t* const words = nearest_.data() + region_.index(x, y) * nearest_words(settings_);
  if (words[index_word] == 0) return {};
  return {words[index_word] - 1, std::bit_cast<float>(words[depth_word]), words + key_words};
}

void AovFilm::add_coverage(int x, int y, std::size_t coverage, const IdCount& more) {
  Coverage& here = coverages_[region_.index(x, y) * settings_.coverages + coverage];
  if (here.first.count == 0) here.first.id = more.id;
  if (here.first.id == more.id) {
    here.first.count += more.count;
    return;
  }
  if (!here.others) here.others = std::make_unique<std::vector<IdCount>>();
  auto& others = *here.others;
  const auto same = std::find_if(others.begin(), others.end(), [&](const IdCount& one) { return one.id == more.id; });
  if (same != others.end()) {
    same->count += more.count;
  } else {
    others.push_back(more);
  }
}

std::vector<IdCount> AovFilm::ranked(int x, int y, std::size_t coverage) const {
  const Coverage& here = coverages_[region_.index(x, y) * settings_.coverages + coverage];
  std::vector<IdCount> all;
  if (here.first.count != 0) all.push_back(here.first);
  if (here.others) all.insert(all.end(), here.others->begin(), here.others->end());
  std::sort(all.begin(), all.end(),
            [](const IdCount& a, const IdCount& b) { return a.count != b.count ? a.count > b.count : a.id < b.id; });
  return all;
}

void AovFilm::add_to(ContentHash& hash) const {
  hash.add(nearest_.data(), nearest_.size() * sizeof nearest_[0]);
  hash.add(sums_.data(), sums_.size() * sizeof sums_[0]);
  for (std::size_t coverage = 0; coverage < settings_.coverages; ++coverage)
    for (int y = region_.y0; y < region_.y1; ++y)
      for (int x = region_.x0; x < region_.x1; ++x) {
        const std::vector<IdCount> ids = ranked(x, y, coverage);
        const std::size_t count = ids.size();
        hash.add(&count, sizeof count);
        hash.add(ids.data(), count * sizeof(IdCount));
      }
}

}  // namespace raytrace
