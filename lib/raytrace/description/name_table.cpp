#include "raytrace/description/name_table.h"

#include <algorithm>
#include <utility>

namespace raytrace {

std::string_view NameTable::name(std::size_t position) const {
  const std::size_t begin = position == 0 ? 0 : bearers_[position - 1].name_end;
  return std::string_view(characters_).substr(begin, bearers_[position].name_end - begin);
}

// By hash first: most comparisons are then of two numbers, not of texts all over the memory.
bool NameTable::less(const Key& a, const Key& b) const {
  if (a.hash != b.hash) return a.hash < b.hash;
  const int order = name(a.position).compare(name(b.position));
  return order != 0 ? order < 0 : a.position < b.position;
}

void NameTable::add(std::string_view name, ItemPlace place) {
  keys_.push_back({std::hash<std::string_view>{}(name), bearers_.size()});
  characters_ += name;
  bearers_.push_back({characters_.size(), place});
}

void NameTable::finish(
    const std::function<void(std::string_view name, ItemPlace first, ItemPlace other)>& report_taken) {
  std::sort(keys_.begin(), keys_.end(), [this](const Key& a, const Key& b) { return less(a, b); });
  std::vector<std::pair<std::size_t, std::size_t>> taken;  // a name's second and further bearers, each with the first
  const Key* first = nullptr;
  for (const Key& key : keys_) {
    if (first && first->hash == key.hash && name(first->position) == name(key.position)) {
      taken.emplace_back(key.position, first->position);
    } else {
      first = &key;
    }
  }
  std::sort(taken.begin(), taken.end());
  for (const auto& [other, bearer] : taken) {
    report_taken(name(other), bearers_[bearer].place, bearers_[other].place);
  }
}

std::optional<std::size_t> NameTable::find(std::string_view name) const {
  const std::size_t hash = std::hash<std::string_view>{}(name);
  auto key = std::lower_bound(keys_.begin(), keys_.end(), hash, [](const Key& k, std::size_t h) { return k.hash < h; });
  for (; key != keys_.end() && key->hash == hash; ++key) {
    if (this->name(key->position) == name) return key->position;
  }
  return std::nullopt;
}

std::vector<std::string_view> NameTable::names() const {
  std::vector<std::string_view> names;
  names.reserve(bearers_.size());
  for (std::size_t i = 0; i < bearers_.size(); ++i) names.push_back(name(i));
  return names;
}

}  // namespace raytrace
