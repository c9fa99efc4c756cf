// Two registers as one: batches with twice the lanes that the instruction set has.
//
// A packet costs more than its arithmetic: it looks cells and materials up, branches, and waits for square roots and
// quotients. Of rays that are as close together as samples of one pixel, twice as many share all that (docs/design.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <xsimd/xsimd.hpp>

#include "raytrace/math/inline.h"

namespace raytrace {

/// What a comparison of TwinBatches gives.
template <class T, class Arch>
class TwinMask {
 public:
  using Part = xsimd::batch_bool<T, Arch>;
  static constexpr std::size_t size = 2 * Part::size;

  TwinMask() = default;
  RAYTRACE_INLINE explicit TwinMask(bool value) : lower_(value), upper_(value) {}
  RAYTRACE_INLINE TwinMask(const Part& lower, const Part& upper) : lower_(lower), upper_(upper) {}

  RAYTRACE_INLINE const Part& lower() const { return lower_; }
  RAYTRACE_INLINE const Part& upper() const { return upper_; }

  friend RAYTRACE_INLINE TwinMask operator&(const TwinMask& a, const TwinMask& b) {
    return {a.lower_ & b.lower_, a.upper_ & b.upper_};
  }
  friend RAYTRACE_INLINE TwinMask operator|(const TwinMask& a, const TwinMask& b) {
    return {a.lower_ | b.lower_, a.upper_ | b.upper_};
  }
  friend RAYTRACE_INLINE TwinMask operator!(const TwinMask& a) {
    return {~a.lower_, ~a.upper_};  // not !, which xsimd 8 makes comparisons of, in halves of AVX's registers
  }
  friend RAYTRACE_INLINE bool any(const TwinMask& a) { return xsimd::any(a.lower_ | a.upper_); }
  friend RAYTRACE_INLINE bool all(const TwinMask& a) { return xsimd::all(a.lower_ & a.upper_); }
  friend RAYTRACE_INLINE bool none(const TwinMask& a) { return !any(a); }

 private:
  Part lower_, upper_;
};

/// The part of xsimd::batch that the renderer uses, under the same names.
template <class T, class Arch>
class TwinBatch {
 public:
  using Part = xsimd::batch<T, Arch>;
  using value_type = T;
  using arch_type = Arch;
  using batch_bool_type = TwinMask<T, Arch>;
  static constexpr std::size_t size = 2 * Part::size;

  TwinBatch() = default;
  /// The same value in every lane.
  RAYTRACE_INLINE explicit TwinBatch(T value) : lower_(value), upper_(value) {}
  RAYTRACE_INLINE TwinBatch(const Part& lower, const Part& upper) : lower_(lower), upper_(upper) {}

  RAYTRACE_INLINE const Part& lower() const { return lower_; }
  RAYTRACE_INLINE const Part& upper() const { return upper_; }

  static RAYTRACE_INLINE TwinBatch load_aligned(const T* lanes) {
    return {Part::load_aligned(lanes), Part::load_aligned(lanes + Part::size)};
  }
  static RAYTRACE_INLINE TwinBatch load_unaligned(const T* lanes) {
    return {Part::load_unaligned(lanes), Part::load_unaligned(lanes + Part::size)};
  }
  RAYTRACE_INLINE void store_aligned(T* lanes) const {
    lower_.store_aligned(lanes);
    upper_.store_aligned(lanes + Part::size);
  }
  RAYTRACE_INLINE void store_unaligned(T* lanes) const {
    lower_.store_unaligned(lanes);
    upper_.store_unaligned(lanes + Part::size);
  }
  RAYTRACE_INLINE T get(std::size_t lane) const {
    T value;  // where it stands in memory already, read from there
    std::memcpy(&value, reinterpret_cast<const char*>(this) + lane * sizeof value, sizeof value);
    return value;
  }

  friend RAYTRACE_INLINE TwinBatch operator+(const TwinBatch& a, const TwinBatch& b) {
    return {a.lower_ + b.lower_, a.upper_ + b.upper_};
  }
  friend RAYTRACE_INLINE TwinBatch operator-(const TwinBatch& a, const TwinBatch& b) {
    return {a.lower_ - b.lower_, a.upper_ - b.upper_};
  }
  friend RAYTRACE_INLINE TwinBatch operator*(const TwinBatch& a, const TwinBatch& b) {
    return {a.lower_ * b.lower_, a.upper_ * b.upper_};
  }
  friend RAYTRACE_INLINE TwinBatch operator/(const TwinBatch& a, const TwinBatch& b) {
    return {a.lower_ / b.lower_, a.upper_ / b.upper_};
  }
  friend RAYTRACE_INLINE TwinBatch operator-(const TwinBatch& a) { return {-a.lower_, -a.upper_}; }
  RAYTRACE_INLINE TwinBatch& operator+=(const TwinBatch& b) { return *this = *this + b; }

  friend RAYTRACE_INLINE TwinBatch operator&(const TwinBatch& a, const TwinBatch& b) {
    return {a.lower_ & b.lower_, a.upper_ & b.upper_};
  }
  friend RAYTRACE_INLINE TwinBatch operator|(const TwinBatch& a, const TwinBatch& b) {
    return {a.lower_ | b.lower_, a.upper_ | b.upper_};
  }
  friend RAYTRACE_INLINE TwinBatch operator^(const TwinBatch& a, const TwinBatch& b) {
    return {a.lower_ ^ b.lower_, a.upper_ ^ b.upper_};
  }
  friend RAYTRACE_INLINE TwinBatch operator>>(const TwinBatch& a, int bits) {
    return {a.lower_ >> bits, a.upper_ >> bits};
  }
  friend RAYTRACE_INLINE TwinBatch operator<<(const TwinBatch& a, int bits) {
    return {a.lower_ << bits, a.upper_ << bits};
  }

  friend RAYTRACE_INLINE batch_bool_type operator<(const TwinBatch& a, const TwinBatch& b) {
    return {a.lower_ < b.lower_, a.upper_ < b.upper_};
  }
  friend RAYTRACE_INLINE batch_bool_type operator<=(const TwinBatch& a, const TwinBatch& b) {
    return {a.lower_ <= b.lower_, a.upper_ <= b.upper_};
  }
  friend RAYTRACE_INLINE batch_bool_type operator>(const TwinBatch& a, const TwinBatch& b) {
    return {a.lower_ > b.lower_, a.upper_ > b.upper_};
  }
  friend RAYTRACE_INLINE batch_bool_type operator>=(const TwinBatch& a, const TwinBatch& b) {
    return {a.lower_ >= b.lower_, a.upper_ >= b.upper_};
  }
  friend RAYTRACE_INLINE batch_bool_type operator==(const TwinBatch& a, const TwinBatch& b) {
    return {a.lower_ == b.lower_, a.upper_ == b.upper_};
  }
  friend RAYTRACE_INLINE batch_bool_type operator!=(const TwinBatch& a, const TwinBatch& b) {
    return !(a == b);  // xsimd 8 has no != of AVX2's integers, and takes those of SSE twice
  }

  friend RAYTRACE_INLINE TwinBatch select(const batch_bool_type& mask, const TwinBatch& a, const TwinBatch& b) {
    return {xsimd::select(mask.lower(), a.lower_, b.lower_), xsimd::select(mask.upper(), a.upper_, b.upper_)};
  }
  friend RAYTRACE_INLINE TwinBatch min(const TwinBatch& a, const TwinBatch& b) {
    return {xsimd::min(a.lower_, b.lower_), xsimd::min(a.upper_, b.upper_)};
  }
  friend RAYTRACE_INLINE TwinBatch max(const TwinBatch& a, const TwinBatch& b) {
    return {xsimd::max(a.lower_, b.lower_), xsimd::max(a.upper_, b.upper_)};
  }
  friend RAYTRACE_INLINE TwinBatch abs(const TwinBatch& a) { return {xsimd::abs(a.lower_), xsimd::abs(a.upper_)}; }
  friend RAYTRACE_INLINE TwinBatch floor(const TwinBatch& a) {
    return {xsimd::floor(a.lower_), xsimd::floor(a.upper_)};
  }
  friend RAYTRACE_INLINE TwinBatch sqrt(const TwinBatch& a) { return {xsimd::sqrt(a.lower_), xsimd::sqrt(a.upper_)}; }
  friend RAYTRACE_INLINE TwinBatch exp(const TwinBatch& a) { return {xsimd::exp(a.lower_), xsimd::exp(a.upper_)}; }
  friend RAYTRACE_INLINE TwinBatch expm1(const TwinBatch& a) {
    return {xsimd::expm1(a.lower_), xsimd::expm1(a.upper_)};
  }
  friend RAYTRACE_INLINE TwinBatch log(const TwinBatch& a) { return {xsimd::log(a.lower_), xsimd::log(a.upper_)}; }
  friend RAYTRACE_INLINE TwinBatch atan2(const TwinBatch& y, const TwinBatch& x) {
    return {xsimd::atan2(y.lower_, x.lower_), xsimd::atan2(y.upper_, x.upper_)};
  }
  friend RAYTRACE_INLINE TwinBatch pow(const TwinBatch& a, const TwinBatch& b) {
    return {xsimd::pow(a.lower_, b.lower_), xsimd::pow(a.upper_, b.upper_)};
  }

 private:
  Part lower_, upper_;
};

template <class Arch>
RAYTRACE_INLINE TwinBatch<float, Arch> to_float(const TwinBatch<std::int32_t, Arch>& a) {
  return {xsimd::to_float(a.lower()), xsimd::to_float(a.upper())};
}
template <class Arch>
RAYTRACE_INLINE TwinBatch<std::int32_t, Arch> to_int(const TwinBatch<float, Arch>& a) {
  return {xsimd::to_int(a.lower()), xsimd::to_int(a.upper())};
}

}  // namespace raytrace
