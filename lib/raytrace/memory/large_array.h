// Large arrays, whose memory is taken where it is first written to.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <type_traits>

#include "raytrace/memory/large_pages.h"

namespace raytrace {

/// A large one comes from the system page by page, when it is first written to: by the threads that fill it, not by the
/// one that makes it.
template <class T>
class LargeArray {
 public:
  static_assert(std::is_trivially_copyable_v<T>);

  LargeArray() = default;

  static LargeArray zeros(std::size_t count) { return LargeArray(zeroed_memory(count * sizeof(T))); }

  /// Of values that are to be written before they are read.
  static LargeArray unset(std::size_t count) { return LargeArray(unset_memory(count * sizeof(T))); }

  T* data() { return values_.get(); }
  const T* data() const { return values_.get(); }
  T& operator[](std::size_t i) { return values_[i]; }
  const T& operator[](std::size_t i) const { return values_[i]; }

 private:
  struct Free {
    void operator()(T* values) const { std::free(values); }
  };
  explicit LargeArray(void* memory) : values_(static_cast<T*>(memory)) {}

  std::unique_ptr<T[], Free> values_;
};

}  // namespace raytrace
