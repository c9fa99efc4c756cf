#include "raytrace/description/name_table.h"

#include <algorithm>
#include <utility>

namespace raytrace {

// By hash first: most comparisons are then of two numbers, not of texts all over the memory.
bool NameTable::less(const Key& a, const Key& b) const {
  if (a.hash != b.hash) return a.hash < b.hash;
  const int order = bearers_[a.position].name.compare(bearers_[b.position].name);
  return order != 0 ? order < 0 : a.position < b.position;
}

void NameTable::add(std::string_view name, Element element) {
  keys_.push_back({std::hash<std::string_view>{}(name), bearers_.size()});
  bearers_.push_back({name, element});
}

void NameTable::finish(const std::function<void(std::string_view name, Element first, Element other)>& report_taken) {
  std::sort(keys_.begin(), keys_.end(), [this](const Key& a, const Key& b) { return less(a, b); });
  std::vector<std::pair<std::size_t, std::size_t>> taken;  // a name's second and further bearers, each with the first
  const Key* first = nullptr;
  for (const Key& key : keys_) {
    if (first && first->hash == key.hash && bearers_[first->position].name == bearers_[key.position].name) {
      taken.emplace_back(key.position, first->position);
    } else {
      first = &key;
    }
  }
  std::sort(taken.begin(), taken.end());
  for (const auto& [other, bearer] : taken) {
    report_taken(bearers_[other].name, bearers_[bearer].element, bearers_[other].element);
  }
}

std::optional<std::size_t> NameTable::find(std::string_view name) const {
  const std::size_t hash = std::hash<std::string_view>{}(name);
  auto key = std::lower_bound(keys_.begin(), keys_.end(), hash, [](const Key& k, std::size_t h) { return k.hash < h; });
  for (; key != keys_.end() && key->hash == hash; ++key) {
    if (bearers_[key->position].name == name) return key->position;
  }
  return std::nullopt;
}

std::vector<std::string_view> NameTable::names() const {
  std::vector<std::string_view> names;
  names.reserve(bearers_.size());
  for (const Bearer& bearer : bearers_) names.push_back(bearer.name);
  return names;
}

}  // namespace raytrace
