#include "raytrace/xml/chunk_cutter.h"

#include <algorithm>

namespace raytrace {

namespace {

/// In bytes. A chunk's tree is some 8 times as large and should stay in the processor's second cache.
constexpr std::size_t usual_piece = std::size_t(1) << 16;

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
  if (first || begin - chunks_.back().begin >= usual_piece) {
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

}  // namespace raytrace
