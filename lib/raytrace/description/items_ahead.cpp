#include "raytrace/description/items_ahead.h"

#include <algorithm>

#include "raytrace/description/xml_characters.h"
#include "raytrace/parallel/for_each_index.h"

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

const ItemsAhead::Chunk* ItemsAhead::from(const char* group, const char* item) {
  if (item >= chunks_end_ || group != group_) {
    const bool useful = 2 * taken_ > chunks_.size();
    if (!useful && !chunks_.empty()) --chances_;
    wanted_chunks_ = useful && group == group_ ? std::min(2 * wanted_chunks_, most_chunks) : least_chunks;
    group_ = group;
    make_chunks(item);
  }
  for (; next_chunk_ < chunks_.size(); ++next_chunk_) {
    const Chunk& chunk = chunks_[next_chunk_];
    if (chunk.begin == nullptr || chunk.begin < item) continue;
    if (chunk.begin > item) break;
    ++taken_;
    return &chunk;
  }
  return nullptr;
}

void ItemsAhead::make_chunks(const char* item) {
  chunks_.clear();
  next_chunk_ = taken_ = 0;
  const std::ptrdiff_t count = std::min((end_ - item) / chunk_size, wanted_chunks_);
  chunks_end_ = count == wanted_chunks_ ? item + count * chunk_size : end_;
  if (count < 2 || chances_ == 0) return;
  const char* name_end = item + 1;
  while (xml::is(*name_end, xml::name_part)) ++name_end;
  const std::string_view item_start(item, static_cast<std::size_t>(name_end - item));
  chunks_.resize(static_cast<std::size_t>(count));
  for_each_index(static_cast<int>(count), threads_, [&](int i) {
    const char* const from = item + i * chunk_size;
    chunks_[static_cast<std::size_t>(i)] = make_chunk(item_start, from, from + chunk_size);
  });
}

ItemsAhead::Chunk ItemsAhead::make_chunk(std::string_view item_start, const char* from, const char* to) const {
  Chunk chunk;
  const char* const begin = find_item(item_start, from, to);
  if (begin == nullptr) return chunk;
  // What is no item may seem to go on for very long, as an open comment does.
  const char* const limit = to + std::min(end_ - to, chunk_size);
  chunk.end = scan_(begin, to, limit, chunk.pieces);
  if (chunk.end != nullptr) chunk.begin = begin;
  return chunk;
}

}  // namespace raytrace
