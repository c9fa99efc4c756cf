// The names of a scene's materials or objects: finds names given twice, and the index of a name.
//
// A sorted array: with a million names it takes a third of the time of a hash table, and no input makes it slow.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace raytrace {

/// Where an item stands.
struct ItemPosition {
  std::uint32_t chunk;   ///< of all the scene's files
  std::uint32_t number;  ///< among the elements of the chunk, from 0
};

class NameTable {
 public:
  /// Adds the name of an item.
  void add(std::string_view name, ItemPosition position);

  /// To be called once all names are there: reports each item whose name another, its first bearer, has already.
  /// threads: how many may share the work.
  void finish(int threads,
              const std::function<void(std::string_view name, ItemPosition first, ItemPosition other)>& report_taken);

  /// Which call of add brought the name; after finish.
  std::optional<std::size_t> find(std::string_view name) const;

  /// In the order of add.
  std::vector<std::string_view> names() const;

 private:
  struct Bearer {
    std::size_t name_end;  // in characters_; the name starts where the one before ends
    ItemPosition position;
  };
  struct Key {
    std::uint32_t key;    // a hash of the name
    std::uint32_t index;  // in bearers_
  };

  std::string_view name(std::size_t index) const;

  std::string characters_;       // all names, one behind the other
  std::vector<Bearer> bearers_;  // in the order of add
  std::vector<Key> keys_;        // sorted by finish: by their hash, then by name, then by index
};

}  // namespace raytrace
