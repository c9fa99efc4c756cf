#include "raytrace/description/piece_cutter.h"

#include <algorithm>

namespace raytrace {

namespace {

/// In bytes. A piece's tree is some 8 times as large and should stay in the processor's second cache.
constexpr std::size_t usual_piece = std::size_t(1) << 16;

}  // namespace

void PieceCutter::item(std::size_t parent, std::string_view parent_name, std::size_t begin) {
  const bool first = parent != last_parent_;
  if (first) {
    last_parent_ = parent;
    in_group_ = std::find(groups_.begin(), groups_.end(), parent_name) != groups_.end();
  }
  if (!in_group_) return;
  if (first || begin - pieces_.back().begin >= usual_piece) {
    if (!first) pieces_.back().end = begin;
    pieces_.push_back({parent, begin, begin});
  }
  ++pieces_.back().items;
}

void PieceCutter::end(std::size_t parent, std::size_t end_tag) {
  if (in_group_ && parent == last_parent_) pieces_.back().end = end_tag;
}

}  // namespace raytrace
