// Where the groups of a large scene are cut, so that several threads can read them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace raytrace {

/// A part of a group's content that may be read apart from the rest: whole items, the first of which starts it, and
/// what stands behind them. A group's chunks follow each other, from its first item to its end tag.
struct TextChunk {
  std::size_t group;  ///< where the group's start tag begins
  std::size_t begin, end;
  std::size_t items = 0;  ///< how many elements
};

/// Is called for the elements right inside of what may be a group, in the order of the text. An element is known by
/// where its start tag begins.
class ChunkCutter {
 public:
  /// groups: the names of those that are cut. chunks: receives theirs. Both must outlive it.
  ChunkCutter(std::span<const std::string_view> groups, std::vector<TextChunk>& chunks)
      : groups_(groups), chunks_(chunks) {}

  /// Cuts as `other` does, from the start.
  ChunkCutter(const ChunkCutter& other, std::vector<TextChunk>& chunks) : ChunkCutter(other.groups_, chunks) {}

  /// An item that begins there, and the parent's end tag.
  void item(std::size_t parent, std::string_view parent_name, std::size_t begin);
  void end(std::size_t parent, std::size_t end_tag);

  /// Whether elements of that name are cut.
  bool cuts(std::string_view name) const;
  /// Instead of item() for each of the items in chunks of a group that another has cut, one or more.
  void add(std::size_t parent, std::string_view parent_name, std::span<const TextChunk> chunks);

 private:
  /// Whether it is the parent's first item.
  bool enter(std::size_t parent, std::string_view parent_name);

  std::span<const std::string_view> groups_;
  std::vector<TextChunk>& chunks_;
  std::size_t last_parent_ = static_cast<std::size_t>(-1);
  bool in_group_ = false;  ///< whether that is a group
};

/// Large groups of a text, scanned by several threads ahead of the one that scans it from its beginning.
///
/// A group is scanned in ranges, each from what looks like the start of an item, which it may not be: it may stand in a
/// comment, in another item or behind the group. The scanner that comes from the beginning knows. Where it finds itself
/// at an item with which a range starts, it would go through the range as that thread did, and need not. Chunks that it
/// does not come to like that, or with a mistake, it scans itself.
class ItemsAhead {
 public:
  /// Items of one group and what is between them.
  struct ScannedRange {
    const char* begin = nullptr;  ///< the '<' of an item's start tag; null if nothing is known
    const char* end = nullptr;    ///< of another's, or of the group's end tag
    std::vector<TextChunk> chunks;
  };

  /// Goes through items of the group that from() was called for, if there is one at `from`: to the first that is not
  /// before `to`, or to the group's end tag, and returns where that is; null if there is none before `limit`.
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
