// Large arrays that most of those who could write to them never do.
#pragma once

#include <atomic>
#include <cstdlib>
#include <type_traits>
#include <utility>

#include "raytrace/memory/large_pages.h"

namespace raytrace {

/// Takes no memory before make(), which threads may call at the same time.
template <class T>
class LateArray {
 public:
  static_assert(std::is_trivially_copyable_v<T>);

  LateArray() = default;
  LateArray(LateArray&& other) noexcept : values_(other.values_.exchange(nullptr)) {}
  LateArray& operator=(LateArray&& other) noexcept {
    std::free(values_.exchange(other.values_.exchange(nullptr)));
    return *this;
  }
  ~LateArray() { std::free(values_.load()); }

  /// Null before make().
  T* data() const { return values_.load(std::memory_order_acquire); }

  /// The array, of `count` zeros at first: the same count each time. Throws std::bad_alloc.
  T* make(std::size_t count) {
    T* values = data();
    if (values != nullptr) return values;
    auto* const zeros = static_cast<T*>(zeroed_memory(count * sizeof(T)));
    if (values_.compare_exchange_strong(values, zeros, std::memory_order_acq_rel)) return zeros;
    std::free(zeros);  // another thread was first
    return values;
  }

 private:
  std::atomic<T*> values_{nullptr};
};

}  // namespace raytrace
