// Large groups of a text, scanned by several threads ahead of the one that scans it from its beginning.
//
// A group is scanned in ranges, each from what looks like the start of an item, which it may not be: it may stand in a
// comment, in another item or behind the group. The scanner that comes from the beginning knows. Where it finds itself
// at an item with which a range starts, it would go through the range as that thread did, and need not. Chunks that it
// does not come to like that, or with a mistake, it scans itself.
#pragma once

#include <cstddef>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "raytrace/xml/chunk_cutter.h"

namespace raytrace {

class ItemsAhead {
 public:
  /// Items of one group and what is between them.
  struct ScannedRange {
    const char* begin = nullptr;  ///< the '<' of an item's start tag; null if nothing is known
    const char* end = nullptr;    ///< of another's, or of the group's end tag
    std::vector<TextChunk> chunks;
  };

  /// Goes through items of the group that from() was called for, if there is one at `from`: to the first that is not
  /// before `to`, or to the group's end tag, and gives that place; null if it finds no such place before `limit`.
  /// chunks: receives theirs. Called by several threads at once.
  using Scan =
      std::function<const char*(const char* from, const char* to, const char* limit, std::vector<TextChunk>& chunks)>;

  /// end: of the text. threads: how many may look ahead.
  ItemsAhead(const char* end, int threads, Scan scan) : end_(end), threads_(threads), scan_(std::move(scan)) {}

  /// The range that starts with this item of the group, if any; valid until the next call. To be called for all items
  /// that are not in such ranges, in their order.
  const ScannedRange* from(const char* group, const char* item);

 private:
  void make_ranges(const char* item);
  ScannedRange make_range(std::string_view item_start, const char* from, const char* to) const;

  static constexpr std::ptrdiff_t range_size = 1 << 18;
  static constexpr std::ptrdiff_t least_ranges = 8, most_ranges = 128;  ///< more while they are of use

  const char* end_;
  int threads_;
  Scan scan_;
  std::vector<ScannedRange> ranges_;
  std::size_t next_range_ = 0, taken_ = 0;
  std::ptrdiff_t wanted_ranges_ = least_ranges;
  const char *ranges_end_ = nullptr, *group_ = nullptr;
  int chances_ = 64;  ///< so often may most ranges be made in vain: a text could be written for that
};

}  // namespace raytrace
