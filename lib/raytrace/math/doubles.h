// Double precision at float's lane count: for what cancels in float.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>

#include "raytrace/math/simd.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

namespace detail {

/// Two registers beside each other in one of twice the width.
#if defined(__AVX512F__)
RAYTRACE_INLINE __m512 join(const __m256& lower, const __m256& upper) {
  return _mm512_insertf32x8(_mm512_castps256_ps512(lower), upper, 1);
}
#endif
#if defined(__AVX__)
RAYTRACE_INLINE __m256 join(const __m128& lower, const __m128& upper) {
  return _mm256_insertf128_ps(_mm256_castps128_ps256(lower), upper, 1);
}
#endif

/// The lower and upper half of the floats as doubles, and back: in registers where the instruction set is known,
/// since memory that is written in halves and read whole stalls.
template <class F, class D>
RAYTRACE_INLINE void widen(const F& floats, D& lower, D& upper) {
#if defined(__AVX512F__)
  if constexpr (F::size == 16) {
    lower = _mm512_cvtps_pd(_mm512_castps512_ps256(floats));
    upper = _mm512_cvtps_pd(_mm512_extractf32x8_ps(floats, 1));
    return;
  }
#endif
#if defined(__AVX__)
  if constexpr (F::size == 8) {
    lower = _mm256_cvtps_pd(_mm256_castps256_ps128(floats));
    upper = _mm256_cvtps_pd(_mm256_extractf128_ps(floats, 1));
    return;
  }
#endif
#if defined(__SSE2__)
  if constexpr (F::size == 4) {
    lower = _mm_cvtps_pd(floats);
    upper = _mm_cvtps_pd(_mm_movehl_ps(floats, floats));
    return;
  }
#endif
  alignas(64) std::array<float, F::size> lanes;
  floats.store_aligned(lanes.data());
  CompilerVector<float, D::size> half;
  using Doubled = CompilerVector<double, D::size>;
  std::memcpy(&half, lanes.data(), sizeof half);
  lower = std::bit_cast<D>(__builtin_convertvector(half, Doubled));
  std::memcpy(&half, lanes.data() + D::size, sizeof half);
  upper = std::bit_cast<D>(__builtin_convertvector(half, Doubled));
}

template <class F, class D>
RAYTRACE_INLINE F narrow(const D& lower, const D& upper) {
#if defined(__AVX512F__)
  if constexpr (F::size == 16) return join(_mm512_cvtpd_ps(lower), _mm512_cvtpd_ps(upper));
#endif
#if defined(__AVX__)
  if constexpr (F::size == 8) return join(_mm256_cvtpd_ps(lower), _mm256_cvtpd_ps(upper));
#endif
#if defined(__SSE2__)
  if constexpr (F::size == 4) return _mm_movelh_ps(_mm_cvtpd_ps(lower), _mm_cvtpd_ps(upper));
#endif
  alignas(64) std::array<float, F::size> lanes;
  using Doubled = CompilerVector<double, D::size>;
  using Half = CompilerVector<float, D::size>;
  Half half = __builtin_convertvector(std::bit_cast<Doubled>(lower), Half);
  std::memcpy(lanes.data(), &half, sizeof half);
  half = __builtin_convertvector(std::bit_cast<Doubled>(upper), Half);
  std::memcpy(lanes.data() + D::size, &half, sizeof half);
  return F::load_aligned(lanes.data());
}

}  // namespace detail

template <class F>
class Doubles;

namespace detail {

template <class F>
struct HalfOfDoubles {
  using type = xsimd::batch<double, typename F::arch_type>;
};
template <class F>
  requires is_twin<F>
struct HalfOfDoubles<F> {
  using type = Doubles<typename F::Part>;
};

}  // namespace detail

/// Double precision, lane for lane beside the floats F: for what cancels in float. Two halves of half the lanes:
/// registers of doubles where F is one of floats, Doubles of its halves where F is two.
template <class F>
class Doubles {
 public:
  using Part = typename detail::HalfOfDoubles<F>::type;
  static constexpr std::size_t size = F::size;
  static_assert(2 * Part::size == size);

  struct batch_bool_type {
    typename Part::batch_bool_type lower, upper;
    friend RAYTRACE_INLINE batch_bool_type operator&(const batch_bool_type& a, const batch_bool_type& b) {
      return {a.lower & b.lower, a.upper & b.upper};
    }
    friend RAYTRACE_INLINE batch_bool_type operator|(const batch_bool_type& a, const batch_bool_type& b) {
      return {a.lower | b.lower, a.upper | b.upper};
    }
    friend RAYTRACE_INLINE bool any(const batch_bool_type& a) { return any(a.lower | a.upper); }
  };

  Doubles() = default;
  RAYTRACE_INLINE Doubles(const Part& lower, const Part& upper) : lower_(lower), upper_(upper) {}
  /// The same value in every lane.
  RAYTRACE_INLINE explicit Doubles(double value) : lower_(value), upper_(value) {}
  RAYTRACE_INLINE Doubles(const F& floats) {  // implicit: no value changes
    if constexpr (is_twin<F>) {
      lower_ = Part(floats.lower());
      upper_ = Part(floats.upper());
    } else {
      detail::widen(floats, lower_, upper_);
    }
  }

  RAYTRACE_INLINE const Part& lower() const { return lower_; }
  RAYTRACE_INLINE const Part& upper() const { return upper_; }

  /// Rounds to float; values beyond float's range become infinite.
  RAYTRACE_INLINE F to_float() const {
    if constexpr (is_twin<F>) {
      return {lower_.to_float(), upper_.to_float()};
    } else {
      return detail::narrow<F>(lower_, upper_);
    }
  }

  static RAYTRACE_INLINE Doubles load_aligned(const double* lanes) {
    return {Part::load_aligned(lanes), Part::load_aligned(lanes + Part::size)};
  }

  friend RAYTRACE_INLINE Doubles operator+(const Doubles& a, const Doubles& b) {
    return {a.lower_ + b.lower_, a.upper_ + b.upper_};
  }
  friend RAYTRACE_INLINE Doubles operator-(const Doubles& a, const Doubles& b) {
    return {a.lower_ - b.lower_, a.upper_ - b.upper_};
  }
  friend RAYTRACE_INLINE Doubles operator*(const Doubles& a, const Doubles& b) {
    return {a.lower_ * b.lower_, a.upper_ * b.upper_};
  }
  friend RAYTRACE_INLINE Doubles operator/(const Doubles& a, const Doubles& b) {
    return {a.lower_ / b.lower_, a.upper_ / b.upper_};
  }
  friend RAYTRACE_INLINE Doubles operator-(const Doubles& a) { return {-a.lower_, -a.upper_}; }
  RAYTRACE_INLINE Doubles& operator+=(const Doubles& b) { return *this = *this + b; }
  friend RAYTRACE_INLINE Doubles sqrt(const Doubles& a) { return {sqrt(a.lower_), sqrt(a.upper_)}; }
  friend RAYTRACE_INLINE Doubles abs(const Doubles& a) { return {abs(a.lower_), abs(a.upper_)}; }
  friend RAYTRACE_INLINE Doubles min(const Doubles& a, const Doubles& b) {
    return {min(a.lower_, b.lower_), min(a.upper_, b.upper_)};
  }
  friend RAYTRACE_INLINE Doubles max(const Doubles& a, const Doubles& b) {
    return {max(a.lower_, b.lower_), max(a.upper_, b.upper_)};
  }
  /// a * b + c; fused where the instruction set can.
  friend RAYTRACE_INLINE Doubles multiply_add(const Doubles& a, const Doubles& b, const Doubles& c) {
    return {multiply_add(a.lower_, b.lower_, c.lower_), multiply_add(a.upper_, b.upper_, c.upper_)};
  }
  friend RAYTRACE_INLINE batch_bool_type operator<(const Doubles& a, const Doubles& b) {
    return {a.lower_ < b.lower_, a.upper_ < b.upper_};
  }
  friend RAYTRACE_INLINE batch_bool_type operator>(const Doubles& a, const Doubles& b) {
    return {a.lower_ > b.lower_, a.upper_ > b.upper_};
  }
  friend RAYTRACE_INLINE batch_bool_type operator<=(const Doubles& a, const Doubles& b) {
    return {a.lower_ <= b.lower_, a.upper_ <= b.upper_};
  }
  friend RAYTRACE_INLINE batch_bool_type operator>=(const Doubles& a, const Doubles& b) {
    return {a.lower_ >= b.lower_, a.upper_ >= b.upper_};
  }

  friend RAYTRACE_INLINE Doubles select(const batch_bool_type& mask, const Doubles& a, const Doubles& b) {
    return {select(mask.lower, a.lower_, b.lower_), select(mask.upper, a.upper_, b.upper_)};
  }

  /// The same lanes of floats.
  static RAYTRACE_INLINE Mask<F> float_mask(const batch_bool_type& doubles) {
    if constexpr (is_twin<F>) {
      return {Part::float_mask(doubles.lower), Part::float_mask(doubles.upper)};
    } else if constexpr (sizeof(typename Mask<F>::register_type) <= 2) {  // AVX-512: a bit a lane
      return static_cast<typename Mask<F>::register_type>(bits(doubles.lower) | bits(doubles.upper) << Part::size);
    } else {
      return select(doubles, Doubles(1.0), Doubles(0.0)).to_float() > F(0);
    }
  }

 private:
  template <class HalfMask>
  static RAYTRACE_INLINE std::uint32_t bits(const HalfMask& half) {
    const typename HalfMask::register_type mask = half;
    std::uint32_t result = 0;
    std::memcpy(&result, &mask, std::min(sizeof mask, sizeof result));
    return result;
  }

  Part lower_, upper_;
};

template <class F>
RAYTRACE_INLINE Vec3<F> to_float(const Vec3<Doubles<F>>& v) {
  return {v.x.to_float(), v.y.to_float(), v.z.to_float()};
}

/// a * b + c with a single rounding (as good as: where there is no FMA, the product is exact in double).
template <class F>
RAYTRACE_INLINE F exact_fma(const F& a, const F& b, const F& c) {
#if defined(__FMA__) || defined(__aarch64__)
  return multiply_add(a, b, c);
#else
  return (Doubles<F>(a) * Doubles<F>(b) + Doubles<F>(c)).to_float();
#endif
}

}  // namespace raytrace
