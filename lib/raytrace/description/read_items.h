// Reads the items of a group from the chunks that it was cut into, on several threads.
#pragma once

#include <tbb/task_arena.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string_view>

#include "raytrace/description/item_list.h"
#include "raytrace/description/variables.h"
#include "raytrace/xml/diagnostics.h"
#include "raytrace/xml/document.h"
#include "raytrace/xml/scene_text.h"

namespace raytrace {

struct ItemGroup {
  const SceneText& text;
  const Variables& variables;
  Element element;             ///< the group's
  std::string_view item_name;  ///< of its items' elements
};

/// For each chunk, in their order: take(the chunk's index, the items that were read from it). Several threads read at
/// once, each into a list that make() made for it; take is called by one at a time. Findings do not depend on the
/// threads.
void read_items(const ItemGroup& group, tbb::task_arena& arena, Diagnostics& diagnostics,
                const std::function<std::unique_ptr<ItemList>()>& make,
                const std::function<void(std::size_t chunk, ItemList& items)>& take);

/// Reports an element that stands where none of its name belongs.
void refuse_misplaced(Element element, std::string_view parent, Diagnostics& diagnostics);

}  // namespace raytrace
