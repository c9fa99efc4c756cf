// The names of a scene's materials or objects: finds names given twice, and the place of a name.
//
// A sorted array: with a million names it takes a third of the time of a hash table, and no input makes it slow.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "raytrace/description/document.h"

namespace raytrace {

class NameTable {
 public:
  /// Adds the name of an element; both must outlive the table.
  void add(std::string_view name, Element element);

  /// To be called once all names are there: reports each element whose name another, its first bearer, has already.
  void finish(const std::function<void(std::string_view name, Element first, Element other)>& report_taken);

  /// Which call of add brought the name; after finish.
  std::optional<std::size_t> find(std::string_view name) const;

  /// In the order of add.
  std::vector<std::string_view> names() const;

 private:
  struct Bearer {
    std::string_view name;
    Element element;
  };
  struct Key {
    std::size_t hash;
    std::size_t position;  // in bearers_
  };

  bool less(const Key& a, const Key& b) const;

  std::vector<Bearer> bearers_;  // in the order of add
  std::vector<Key> keys_;        // sorted by finish
};

}  // namespace raytrace
