// Large groups of a text, scanned by several threads ahead of the one that scans it from its beginning.
//
// A group is scanned in chunks, each from what looks like the start of an item, which it may not be: it may stand in a
// comment, in another item or behind the group. The scanner that comes from the beginning knows. Where it finds itself
// at an item with which a chunk starts, it would go through the chunk as that thread did, and need not. Chunks that it
// does not come to like that, or with a mistake, it scans itself.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "raytrace/description/piece_cutter.h"

namespace raytrace {

class ItemsAhead {
 public:
  /// Items of one group and what is between them.
  struct Chunk {
    const char* begin = nullptr;  ///< the '<' of an item's start tag; null if nothing is known
    const char* end = nullptr;    ///< of another's, or of the group's end tag
    std::vector<Piece> pieces;
  };

  /// Goes through items of the group that from() was called for, if there is one at `from`: to the first that is not
  /// before `to`, or to the group's end tag, and gives that place; null if it finds no such place before `limit`.
  /// pieces: receives theirs. Called by several threads at once.
  using Scan =
      std::function<const char*(const char* from, const char* to, const char* limit, std::vector<Piece>& pieces)>;

  /// end: of the text. threads: how many may look ahead.
  ItemsAhead(const char* end, int threads, Scan scan) : end_(end), threads_(threads), scan_(std::move(scan)) {}

  /// The chunk that starts with this item of the group, if any; valid until the next call. To be called for all items
  /// that are not in such chunks, in their order.
  const Chunk* from(const char* group, const char* item);

 private:
  void make_chunks(const char* item);
  Chunk make_chunk(std::string_view item_start, const char* from, const char* to) const;

  static constexpr std::ptrdiff_t chunk_size = 1 << 18;
  static constexpr std::ptrdiff_t least_chunks = 8, most_chunks = 128;  ///< more while they are of use

  const char* end_;
  int threads_;
  Scan scan_;
  std::vector<Chunk> chunks_;
  std::size_t next_chunk_ = 0, taken_ = 0;
  std::ptrdiff_t wanted_chunks_ = least_chunks;
  const char *chunks_end_ = nullptr, *group_ = nullptr;
  int chances_ = 64;  ///< so often may most chunks be made in vain: a text could be written for that
};

}  // namespace raytrace
