#include "raytrace/description/piece_cutter.h"

#include <algorithm>

namespace raytrace {

namespace {

/// In bytes. A piece's tree is some 8 times as large and should stay in the processor's second cache.
constexpr std::size_t usual_piece = std::size_t(1) << 16;

}  // namespace

bool PieceCutter::cuts(std::string_view name) const {
  return std::find(groups_.begin(), groups_.end(), name) != groups_.end();
}

bool PieceCutter::enter(std::size_t parent, std::string_view parent_name) {
  if (parent == last_parent_) return false;
  last_parent_ = parent;
  in_group_ = cuts(parent_name);
  return true;
}

void PieceCutter::item(std::size_t parent, std::string_view parent_name, std::size_t begin) {
  const bool first = enter(parent, parent_name);
  if (!in_group_) return;
  if (first || begin - pieces_.back().begin >= usual_piece) {
    if (!first) pieces_.back().end = begin;
    pieces_.push_back({parent, begin, begin});
  }
  ++pieces_.back().items;
}

void PieceCutter::add(std::size_t parent, std::string_view parent_name, std::span<const Piece> pieces) {
  if (!enter(parent, parent_name)) pieces_.back().end = pieces.front().begin;
  pieces_.insert(pieces_.end(), pieces.begin(), pieces.end());
}

void PieceCutter::end(std::size_t parent, std::size_t end_tag) {
  if (in_group_ && parent == last_parent_) pieces_.back().end = end_tag;
}

}  // namespace raytrace
