#include "raytrace/description/name_table.h"

#include <algorithm>
#include <utility>

#include "raytrace/parallel/radix_sort.h"

namespace raytrace {
namespace {

std::uint32_t short_hash(std::string_view name) {
  return static_cast<std::uint32_t>(std::hash<std::string_view>{}(name));
}

}  // namespace

std::string_view NameTable::name(std::size_t index) const {
  const std::size_t begin = index == 0 ? 0 : bearers_[index - 1].name_end;
  return std::string_view(characters_).substr(begin, bearers_[index].name_end - begin);
}

void NameTable::add(std::string_view name, ItemPosition position) {
  keys_.push_back({short_hash(name), static_cast<std::uint32_t>(bearers_.size())});
  characters_ += name;
  bearers_.push_back({characters_.size(), position});
}

void NameTable::finish(
    int threads,
    const std::function<void(std::string_view name, ItemPosition first, ItemPosition other)>& report_taken) {
  radix_sort(keys_, threads);
  std::vector<std::pair<std::size_t, std::size_t>> taken;  // a name's second and further bearers, each with the first
  for (auto begin = keys_.begin(), end = begin; begin != keys_.end(); begin = end) {
    while (end != keys_.end() && end->key == begin->key) ++end;
    if (end - begin == 1) continue;
    // Of one hash. They may be many, if somebody wants them to be.
    std::sort(begin, end, [this](const Key& a, const Key& b) {
      const int order = name(a.index).compare(name(b.index));
      return order != 0 ? order < 0 : a.index < b.index;
    });
    for (auto first = begin, key = begin + 1; key != end; ++key) {
      if (name(first->index) == name(key->index))
        taken.emplace_back(key->index, first->index);
      else
        first = key;
    }
  }
  std::sort(taken.begin(), taken.end());
  for (const auto& [other, bearer] : taken) {
    report_taken(name(other), bearers_[bearer].position, bearers_[other].position);
  }
}

std::optional<std::size_t> NameTable::find(std::string_view name) const {
  const std::uint32_t wanted = short_hash(name);
  auto key =
      std::lower_bound(keys_.begin(), keys_.end(), wanted, [](const Key& k, std::uint32_t h) { return k.key < h; });
  for (; key != keys_.end() && key->key == wanted; ++key) {
    if (this->name(key->index) == name) return key->index;
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
