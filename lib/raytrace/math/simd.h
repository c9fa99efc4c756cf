// SIMD types of the instruction set being compiled: one lane a ray.
//
// A thin layer over xsimd (which carries the arithmetic, comparisons, select, sqrt, pow...) that adds what its 8.x
// and 13.x series spell differently or lack: masks as bits, lane counts of other sizes, and double precision at float's
// lane count. The only header of the project in which intrinsics may stand.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>
#include <xsimd/xsimd.hpp>

#include "raytrace/math/inline.h"
#include "raytrace/math/twin_batch.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

/// Floats of a register: 4 lanes with x86-64-v2 and NEON, 8 with v3, 16 with v4.
using RegisterFloats = xsimd::batch<float>;
inline constexpr int register_lanes = static_cast<int>(RegisterFloats::size);

/// Floats of a packet: 16 lanes, or as many as two registers have.
using FloatN = std::conditional_t < register_lanes<16, TwinBatch<float, RegisterFloats::arch_type>, RegisterFloats>;
inline constexpr int packet_lanes = static_cast<int>(FloatN::size);

namespace detail {
template <class F, class T>
struct LikeOf {
  using type = xsimd::batch<T, typename F::arch_type>;
};
template <class Arch, class T>
struct LikeOf<TwinBatch<float, Arch>, T> {
  using type = TwinBatch<T, Arch>;
};
}  // namespace detail

template <class F>
using Mask = typename F::batch_bool_type;
template <class F>
using Ints = typename detail::LikeOf<F, std::int32_t>::type;
template <class F>
using Uints = typename detail::LikeOf<F, std::uint32_t>::type;

using MaskN = Mask<FloatN>;
using IntN = Ints<FloatN>;
using UintN = Uints<FloatN>;

template <class F>
inline constexpr int lane_count = static_cast<int>(F::size);

namespace detail {
template <class T, std::size_t lanes>
struct CompilerVectorOf {
  typedef T type __attribute__((vector_size(lanes * sizeof(T))));
};
}  // namespace detail

/// Vector types of the compiler: it converts them where there is no instruction that xsimd knows of.
template <class T, std::size_t lanes>
using CompilerVector = typename detail::CompilerVectorOf<T, lanes>::type;

namespace detail {
template <int lanes>
struct FloatLanesOf {
  using type = std::conditional_t<std::is_void_v<xsimd::make_sized_batch_t<float, static_cast<std::size_t>(lanes)>>,
                                  RegisterFloats, xsimd::make_sized_batch_t<float, static_cast<std::size_t>(lanes)>>;
};
}  // namespace detail

/// Floats of the given number of lanes where the instruction set has such registers, else a register's.
template <int lanes>
using FloatLanes = typename detail::FloatLanesOf<lanes>::type;

template <class F>
RAYTRACE_INLINE F infinity() {
  return F(std::numeric_limits<float>::infinity());
}

template <class F>
inline constexpr bool is_twin = requires(F floats) { floats.lower(); };

namespace detail {
template <class F>
RAYTRACE_INLINE std::uint32_t register_bits(const Mask<F>& mask) {
  using Register = typename Mask<F>::register_type;
  const Register value = mask;
  if constexpr (sizeof(Register) <= 2) {
    return static_cast<std::uint32_t>(value);
#if defined(__AVX__)
  } else if constexpr (sizeof(Register) == 32) {
    return static_cast<std::uint32_t>(_mm256_movemask_ps(value));
#endif
#if defined(__SSE__)
  } else if constexpr (sizeof(Register) == 16) {
    return static_cast<std::uint32_t>(_mm_movemask_ps(value));
#endif
  } else {
    alignas(64) std::array<bool, F::size> lanes{};
    mask.store_unaligned(lanes.data());
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < F::size; ++i) bits |= static_cast<std::uint32_t>(lanes[i]) << i;
    return bits;
  }
}
}  // namespace detail

/// The mask's lanes as bits, lane 0 lowest.
template <class F>
RAYTRACE_INLINE std::uint32_t bits_of(const Mask<F>& mask) {
  if constexpr (is_twin<F>) {
    using Part = typename F::Part;
    return detail::register_bits<Part>(mask.lower()) | detail::register_bits<Part>(mask.upper()) << Part::size;
  } else {
    return detail::register_bits<F>(mask);
  }
}

/// std::bit_cast between batches, or masks, of one size: register by register, so that they need not go through memory.
template <class To, class From>
RAYTRACE_INLINE To same_bits(const From& from) {
  if constexpr (is_twin<From>) {
    return {std::bit_cast<typename To::Part>(from.lower()), std::bit_cast<typename To::Part>(from.upper())};
  } else {
    return std::bit_cast<To>(from);
  }
}

#if defined(__F16C__)
/// Four floats as IEEE 754 binary16, rounded to the nearest, infinite beyond its range: there where the instruction set
/// has this.
#define RAYTRACE_CONVERTS_HALVES
RAYTRACE_INLINE std::array<std::uint16_t, 4> to_halves(const std::array<float, 4>& floats) {
  return std::bit_cast<std::array<std::uint16_t, 4>>(
      _mm_cvtsi128_si64(_mm_cvtps_ph(_mm_loadu_ps(floats.data()), _MM_FROUND_TO_NEAREST_INT)));
}
#endif

/// A mask of float lanes from a comparison of integers of the same lane count.
template <class F>
RAYTRACE_INLINE Mask<F> float_mask(const typename Ints<F>::batch_bool_type& mask) {
  return same_bits<Mask<F>>(mask);
}
template <class F>
RAYTRACE_INLINE Mask<F> float_mask(const typename Uints<F>::batch_bool_type& mask) {
  return same_bits<Mask<F>>(mask);
}

/// Lane by lane: a where the mask of float lanes is true, else b.
template <class Integers>
RAYTRACE_INLINE Integers select_lanes(const MaskN& mask, const Integers& a, const Integers& b) {
  return same_bits<Integers>(select(mask, same_bits<FloatN>(a), same_bits<FloatN>(b)));
}

/// The mask that is true in lanes [0, count).
template <class F>
Mask<F> first_lanes(int count) {
  alignas(64) static constexpr auto numbers = [] {
    std::array<float, F::size> result{};
    for (std::size_t i = 0; i < F::size; ++i) result[i] = static_cast<float>(i);
    return result;
  }();
  return F::load_aligned(numbers.data()) < F(static_cast<float>(count));
}

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

/// a * b + c of a batch of floats or doubles, with a single rounding where the instruction set can. Not xsimd::fma:
/// that of xsimd 8 multiplies, rounds and adds for AVX-512, and for the narrower registers beside it.
template <class Batch>
RAYTRACE_INLINE Batch multiply_add(const Batch& a, const Batch& b, const Batch& c) {
  [[maybe_unused]] constexpr bool floats = std::is_same_v<typename Batch::value_type, float>;
#if defined(__AVX512F__)
  if constexpr (sizeof(Batch) == 64) {
    if constexpr (floats) {
      return _mm512_fmadd_ps(a, b, c);
    } else {
      return _mm512_fmadd_pd(a, b, c);
    }
  }
#endif
#if defined(__FMA__)
  if constexpr (sizeof(Batch) == 32) {
    if constexpr (floats) {
      return _mm256_fmadd_ps(a, b, c);
    } else {
      return _mm256_fmadd_pd(a, b, c);
    }
  }
  if constexpr (sizeof(Batch) == 16) {
    if constexpr (floats) {
      return _mm_fmadd_ps(a, b, c);
    } else {
      return _mm_fmadd_pd(a, b, c);
    }
  }
#endif
  return xsimd::fma(a, b, c);
}

template <class T, class Arch>
RAYTRACE_INLINE TwinBatch<T, Arch> multiply_add(const TwinBatch<T, Arch>& a, const TwinBatch<T, Arch>& b,
                                                const TwinBatch<T, Arch>& c) {
  return {multiply_add(a.lower(), b.lower(), c.lower()), multiply_add(a.upper(), b.upper(), c.upper())};
}

/// Double precision, lane for lane beside the floats F: for what cancels in float. Two registers of half the lanes.
template <class F>
class Doubles {
 public:
  using Part = xsimd::batch<double, typename F::arch_type>;
  static_assert(2 * Part::size == F::size);

  struct MaskType {
    typename Part::batch_bool_type lower, upper;
    friend RAYTRACE_INLINE MaskType operator&(const MaskType& a, const MaskType& b) {
      return {a.lower & b.lower, a.upper & b.upper};
    }
    friend RAYTRACE_INLINE MaskType operator|(const MaskType& a, const MaskType& b) {
      return {a.lower | b.lower, a.upper | b.upper};
    }
    friend RAYTRACE_INLINE bool any(const MaskType& a) { return xsimd::any(a.lower | a.upper); }
  };

  Doubles() = default;
  RAYTRACE_INLINE Doubles(const Part& lower, const Part& upper) : lower_(lower), upper_(upper) {}
  /// The same value in every lane.
  RAYTRACE_INLINE explicit Doubles(double value) : lower_(value), upper_(value) {}
  RAYTRACE_INLINE Doubles(const F& floats) { detail::widen(floats, lower_, upper_); }  // implicit: no value changes

  RAYTRACE_INLINE const Part& lower() const { return lower_; }
  RAYTRACE_INLINE const Part& upper() const { return upper_; }

  /// Rounds to float; values beyond float's range become infinite.
  RAYTRACE_INLINE F to_float() const { return detail::narrow<F>(lower_, upper_); }

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
  friend RAYTRACE_INLINE Doubles sqrt(const Doubles& a) { return {xsimd::sqrt(a.lower_), xsimd::sqrt(a.upper_)}; }
  friend RAYTRACE_INLINE Doubles cbrt(const Doubles& a) { return {xsimd::cbrt(a.lower_), xsimd::cbrt(a.upper_)}; }
  friend RAYTRACE_INLINE Doubles abs(const Doubles& a) { return {xsimd::abs(a.lower_), xsimd::abs(a.upper_)}; }
  friend RAYTRACE_INLINE Doubles min(const Doubles& a, const Doubles& b) {
    return {xsimd::min(a.lower_, b.lower_), xsimd::min(a.upper_, b.upper_)};
  }
  friend RAYTRACE_INLINE Doubles max(const Doubles& a, const Doubles& b) {
    return {xsimd::max(a.lower_, b.lower_), xsimd::max(a.upper_, b.upper_)};
  }
  /// a * b + c; fused where the instruction set can.
  friend RAYTRACE_INLINE Doubles fma(const Doubles& a, const Doubles& b, const Doubles& c) {
    return {multiply_add(a.lower_, b.lower_, c.lower_), multiply_add(a.upper_, b.upper_, c.upper_)};
  }
  friend RAYTRACE_INLINE MaskType operator<(const Doubles& a, const Doubles& b) {
    return {a.lower_ < b.lower_, a.upper_ < b.upper_};
  }
  friend RAYTRACE_INLINE MaskType operator>(const Doubles& a, const Doubles& b) {
    return {a.lower_ > b.lower_, a.upper_ > b.upper_};
  }
  friend RAYTRACE_INLINE MaskType operator<=(const Doubles& a, const Doubles& b) {
    return {a.lower_ <= b.lower_, a.upper_ <= b.upper_};
  }
  friend RAYTRACE_INLINE MaskType operator>=(const Doubles& a, const Doubles& b) {
    return {a.lower_ >= b.lower_, a.upper_ >= b.upper_};
  }

  friend RAYTRACE_INLINE Doubles select(const MaskType& mask, const Doubles& a, const Doubles& b) {
    return {xsimd::select(mask.lower, a.lower_, b.lower_), xsimd::select(mask.upper, a.upper_, b.upper_)};
  }

  /// The same lanes of floats.
  static RAYTRACE_INLINE Mask<F> float_mask(const MaskType& doubles) {
    using Register = typename Mask<F>::register_type;
    if constexpr (sizeof(Register) <= 2) {  // AVX-512: a bit a lane
      return static_cast<Register>(bits(doubles.lower) | bits(doubles.upper) << Part::size);
    } else {
      return select(doubles, Doubles(1.0), Doubles(0.0)).to_float() > F(0);
    }
  }

 private:
  static RAYTRACE_INLINE std::uint32_t bits(typename Part::batch_bool_type::register_type mask) {
    std::uint32_t result = 0;
    std::memcpy(&result, &mask, std::min(sizeof mask, sizeof result));
    return result;
  }

  Part lower_, upper_;
};

/// Of two registers of floats.
template <class Arch>
class Doubles<TwinBatch<float, Arch>> {
 public:
  using Floats = TwinBatch<float, Arch>;
  using Part = Doubles<typename Floats::Part>;

  struct MaskType {
    typename Part::MaskType lower, upper;
    friend RAYTRACE_INLINE MaskType operator&(const MaskType& a, const MaskType& b) {
      return {a.lower & b.lower, a.upper & b.upper};
    }
    friend RAYTRACE_INLINE MaskType operator|(const MaskType& a, const MaskType& b) {
      return {a.lower | b.lower, a.upper | b.upper};
    }
    friend RAYTRACE_INLINE bool any(const MaskType& a) { return any(a.lower | a.upper); }
  };

  Doubles() = default;
  RAYTRACE_INLINE Doubles(const Part& lower, const Part& upper) : lower_(lower), upper_(upper) {}
  RAYTRACE_INLINE explicit Doubles(double value) : lower_(value), upper_(value) {}
  RAYTRACE_INLINE Doubles(const Floats& floats) : lower_(floats.lower()), upper_(floats.upper()) {}

  RAYTRACE_INLINE const Part& lower() const { return lower_; }
  RAYTRACE_INLINE const Part& upper() const { return upper_; }

  RAYTRACE_INLINE Floats to_float() const { return {lower_.to_float(), upper_.to_float()}; }

  static RAYTRACE_INLINE Doubles load_aligned(const double* lanes) {
    return {Part::load_aligned(lanes), Part::load_aligned(lanes + Floats::Part::size)};
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
  friend RAYTRACE_INLINE Doubles cbrt(const Doubles& a) { return {cbrt(a.lower_), cbrt(a.upper_)}; }
  friend RAYTRACE_INLINE Doubles abs(const Doubles& a) { return {abs(a.lower_), abs(a.upper_)}; }
  friend RAYTRACE_INLINE Doubles min(const Doubles& a, const Doubles& b) {
    return {min(a.lower_, b.lower_), min(a.upper_, b.upper_)};
  }
  friend RAYTRACE_INLINE Doubles max(const Doubles& a, const Doubles& b) {
    return {max(a.lower_, b.lower_), max(a.upper_, b.upper_)};
  }
  friend RAYTRACE_INLINE Doubles fma(const Doubles& a, const Doubles& b, const Doubles& c) {
    return {fma(a.lower_, b.lower_, c.lower_), fma(a.upper_, b.upper_, c.upper_)};
  }
  friend RAYTRACE_INLINE MaskType operator<(const Doubles& a, const Doubles& b) {
    return {a.lower_ < b.lower_, a.upper_ < b.upper_};
  }
  friend RAYTRACE_INLINE MaskType operator>(const Doubles& a, const Doubles& b) {
    return {a.lower_ > b.lower_, a.upper_ > b.upper_};
  }
  friend RAYTRACE_INLINE MaskType operator<=(const Doubles& a, const Doubles& b) {
    return {a.lower_ <= b.lower_, a.upper_ <= b.upper_};
  }
  friend RAYTRACE_INLINE MaskType operator>=(const Doubles& a, const Doubles& b) {
    return {a.lower_ >= b.lower_, a.upper_ >= b.upper_};
  }

  friend RAYTRACE_INLINE Doubles select(const MaskType& mask, const Doubles& a, const Doubles& b) {
    return {select(mask.lower, a.lower_, b.lower_), select(mask.upper, a.upper_, b.upper_)};
  }

  static RAYTRACE_INLINE Mask<Floats> float_mask(const MaskType& doubles) {
    return {Part::float_mask(doubles.lower), Part::float_mask(doubles.upper)};
  }

 private:
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
