// Memory in large pages, where the system has such: a fraction of the requests for it, and what is read here and there
// is found with fewer detours.
#pragma once

#include <cstddef>

namespace raytrace {

/// Zeros; from the system page by page if they are many, when they are first written to. To be freed by std::free.
/// Throws std::bad_alloc.
void* zeroed_memory(std::size_t bytes);

/// The same without values.
void* unset_memory(std::size_t bytes);

/// Asks for large pages where memory has not been written to yet. Nothing happens to small pieces.
void prefer_large_pages(void* memory, std::size_t bytes);

/// Room for `count` items in an empty vector or string, in large pages.
template <class Items>
void reserve_large(Items& items, std::size_t count) {
  items.reserve(count);
  prefer_large_pages(items.data(), items.capacity() * sizeof(items[0]));
}

}  // namespace raytrace
