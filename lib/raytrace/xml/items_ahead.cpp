#include "raytrace/xml/items_ahead.h"

#include <algorithm>

#include "raytrace/parallel/for_each_index.h"
#include "raytrace/xml/xml_characters.h"

namespace raytrace {
namespace {

/// The first in [from, to); null if there is none.
const char* find_item(std::string_view item_start, const char* from, const char* to) {
  while (true) {
    const std::size_t found = std::string_view(from, static_cast<std::size_t>(to - from)).find(item_start);
    if (found == std::string_view::npos) return nullptr;
    from += found;
    if (!xml::is(from[item_start.size()], xml::name_part)) return from;
    ++from;
  }
}

}  // namespace

const ItemsAhead::ScannedRange* ItemsAhead::from(const char* group, const char* item) {
  if (item >= ranges_end_ || group != group_) {
    const bool useful = 2 * taken_ > ranges_.size();
    if (!useful && !ranges_.empty()) --chances_;
    wanted_ranges_ = useful && group == group_ ? std::min(2 * wanted_ranges_, most_ranges) : least_ranges;
    group_ = group;
    make_ranges(item);
  }
  for (; next_range_ < ranges_.size(); ++next_range_) {
    const ScannedRange& range = ranges_[next_range_];
    if (range.begin == nullptr || range.begin < item) continue;
    if (range.begin > item) break;
    ++taken_;
    return &range;
  }
  return nullptr;
}

void ItemsAhead::make_ranges(const char* item) {
  ranges_.clear();
  next_range_ = taken_ = 0;
  const std::ptrdiff_t count = std::min((end_ - item) / range_size, wanted_ranges_);
  ranges_end_ = count == wanted_ranges_ ? item + count * range_size : end_;
  if (count < 2 || chances_ == 0) return;
  const char* name_end = item + 1;
  while (xml::is(*name_end, xml::name_part)) ++name_end;
  const std::string_view item_start(item, static_cast<std::size_t>(name_end - item));
  ranges_.resize(static_cast<std::size_t>(count));
  for_each_index(static_cast<int>(count), threads_, [&](int i) {
    const char* const from = item + i * range_size;
    ranges_[static_cast<std::size_t>(i)] = make_range(item_start, from, from + range_size);
  });
}

ItemsAhead::ScannedRange ItemsAhead::make_range(std::string_view item_start, const char* from, const char* to) const {
  ScannedRange range;
  const char* const begin = find_item(item_start, from, to);
  if (begin == nullptr) return range;
  // What is no item may seem to go on for very long, as an open comment does.
  const char* const limit = to + std::min(end_ - to, range_size);
  range.end = scan_(begin, to, limit, range.chunks);
  if (range.end != nullptr) range.begin = begin;
  return range;
}

}  // namespace raytrace
