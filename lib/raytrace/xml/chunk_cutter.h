// Where the groups of a large scene are cut, so that several threads can read them.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace raytrace {

/// A part of a group's content that may be read apart from the rest: whole items, the first of which starts it, and
/// what stands behind them. A group's chunks follow each other, from its first item to its end tag.
struct TextChunk {
  std::size_t group;  ///< where the group's start tag begins
  std::size_t begin, end;
  std::size_t items = 0;  ///< how many elements
};

/// Is told of the elements right inside of what may be a group, in the order of the text. An element is known by where
/// its start tag begins.
class ChunkCutter {
 public:
  /// groups: the names of those that are cut. chunks: receives theirs. Both must outlive it.
  ChunkCutter(std::span<const std::string_view> groups, std::vector<TextChunk>& chunks)
      : groups_(groups), chunks_(chunks) {}

  /// Cuts as `other` does, from the start.
  ChunkCutter(const ChunkCutter& other, std::vector<TextChunk>& chunks) : ChunkCutter(other.groups_, chunks) {}

  void item(std::size_t parent, std::string_view parent_name, std::size_t begin);
  void end(std::size_t parent, std::size_t end_tag);

  /// Whether elements of that name are cut.
  bool cuts(std::string_view name) const;
  /// Instead of item() for each of the items in chunks of a group that another has cut, one or more.
  void add(std::size_t parent, std::string_view parent_name, std::span<const TextChunk> chunks);

 private:
  /// Whether it is the parent's first item.
  bool enter(std::size_t parent, std::string_view parent_name);

  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  std::span<const std::string_view> groups_;
  std::vector<TextChunk>& chunks_;
  std::size_t last_parent_ = none;
  bool in_group_ = false;  ///< whether that is a group
};

}  // namespace raytrace
