#include "raytrace/xml/item_chunks.h"

#include <algorithm>

#include "raytrace/parallel/for_each_index.h"
#include "raytrace/xml/xml_characters.h"

namespace raytrace {
namespace {

/// In bytes. A chunk's tree is some 8 times as large and should stay in the processor's second cache.
constexpr std::size_t usual_chunk = std::size_t(1) << 16;

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

bool ChunkCutter::cuts(std::string_view name) const {
  return std::find(groups_.begin(), groups_.end(), name) != groups_.end();
}

bool ChunkCutter::enter(std::size_t parent, std::string_view parent_name) {
  if (parent == last_parent_) return false;
  last_parent_ = parent;
  in_group_ = cuts(parent_name);
  return true;
}

void ChunkCutter::item(std::size_t parent, std::string_view parent_name, std::size_t begin) {
  const bool first = enter(parent, parent_name);
  if (!in_group_) return;
  if (first || begin - chunks_.back().begin >= usual_chunk) {
    if (!first) chunks_.back().end = begin;
    chunks_.push_back({parent, begin, begin});
  }
  ++chunks_.back().items;
}

void ChunkCutter::add(std::size_t parent, std::string_view parent_name, std::span<const TextChunk> chunks) {
  if (!enter(parent, parent_name)) chunks_.back().end = chunks.front().begin;
  chunks_.insert(chunks_.end(), chunks.begin(), chunks.end());
}

void ChunkCutter::end(std::size_t parent, std::size_t end_tag) {
  if (in_group_ && parent == last_parent_) chunks_.back().end = end_tag;
}

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
