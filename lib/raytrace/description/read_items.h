// Reads the items of a group from the pieces that it was cut into, on several threads.
#pragma once

#include <tbb/task_arena.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string_view>

#include "raytrace/description/diagnostics.h"
#include "raytrace/description/document.h"
#include "raytrace/description/item_list.h"
#include "raytrace/description/scene_text.h"
#include "raytrace/description/variables.h"

namespace raytrace {

struct ItemGroup {
  const SceneText& text;
  const Variables& variables;
  Element element;             ///< the group's
  std::string_view item_name;  ///< of its items' elements
};

/// For each piece, in their order: take(the piece's index, the items that were read from it). Several threads read at
/// once, each into a list that make() made for it; take is called by one at a time. Findings do not depend on the
/// threads.
void read_items(const ItemGroup& group, tbb::task_arena& arena, Diagnostics& diagnostics,
                const std::function<std::unique_ptr<ItemList>()>& make,
                const std::function<void(std::size_t piece, ItemList& items)>& take);

/// Reports an element that stands where none of its name belongs.
void refuse_misplaced(Element element, std::string_view parent, Diagnostics& diagnostics);

}  // namespace raytrace
