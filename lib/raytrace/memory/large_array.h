// Large arrays, whose memory is taken where it is first written to, and in large pages, where the system has such: a
// fraction of the requests for it, and what is read here and there is found with fewer detours.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <type_traits>

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

/// For arrays that most of those who could write to them never do. Takes no memory before make(), which threads may
/// call at the same time.
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
