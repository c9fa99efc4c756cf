// SIMD types of the instruction set being compiled: one lane a ray.
//
// A thin layer over xsimd (which carries the arithmetic, comparisons, select, sqrt, pow...) that adds what its 8.x
// and 13.x series spell differently or lack: masks as bits, lane counts of other sizes, a fused multiply-add.
// Intrinsics stand nowhere but here and in doubles.h.
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

#include "raytrace/math/compiler_vector.h"
#include "raytrace/math/inline.h"
#include "raytrace/math/twin_batch.h"
#include "raytrace/math/vec3.h"

namespace raytrace {

/// Floats of a register: 4 lanes with x86-64-v2 and NEON, 8 with v3, 16 with v4.
using RegisterFloats = xsimd::batch<float>;
inline constexpr int register_lanes = static_cast<int>(RegisterFloats::size);

/// Floats of a packet: as many as two registers have.
using FloatN = TwinBatch<float, RegisterFloats::arch_type>;
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

/// How many of the lanes there are.
inline std::uint64_t count_lanes(const MaskN& lanes) {
  return static_cast<std::uint64_t>(std::popcount(bits_of<FloatN>(lanes)));
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

/// 0, 1, 2... in the lanes of a batch of any numbers.
template <class Batch>
RAYTRACE_INLINE Batch lane_numbers() {
  using Number = typename Batch::value_type;
  alignas(64) static constexpr auto numbers = [] {
    std::array<Number, Batch::size> result{};
    for (std::size_t i = 0; i < Batch::size; ++i) result[i] = static_cast<Number>(i);
    return result;
  }();
  return Batch::load_aligned(numbers.data());
}

/// `even` in lanes 0, 2, 4..., `odd` in the others.
inline UintN alternate(std::uint32_t even, std::uint32_t odd) {
  const xsimd::batch<std::uint64_t, UintN::arch_type> pairs(std::bit_cast<std::uint64_t>(std::array{even, odd}));
  const auto lanes = std::bit_cast<UintN::Part>(pairs);
  return {lanes, lanes};
}

/// The mask that is true in lanes [0, count).
template <class F>
Mask<F> first_lanes(int count) {
  return lane_numbers<F>() < F(static_cast<float>(count));
}

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

/// The same of one number, with the same roundings.
RAYTRACE_INLINE float multiply_add(float a, float b, float c) {
#if defined(__FMA__) || defined(__ARM_FEATURE_FMA)
  return __builtin_fmaf(a, b, c);
#else
  return a * b + c;
#endif
}

/// A power of 2 that brings positive numbers to [1, 2): a product with it rounds nothing.
template <class F>
RAYTRACE_INLINE F inverse_power_of_2(const F& numbers) {
  constexpr std::uint32_t exponent = 0x7f800000U, twice_the_bias = 254U << 23U;
  return same_bits<F>(Uints<F>(twice_the_bias) - (same_bits<Uints<F>>(numbers) & Uints<F>(exponent)));
}

/// dot() with as few roundings as the instruction set allows.
template <class F>
RAYTRACE_INLINE F fused_dot(const Vec3<F>& a, const Vec3<F>& b) {
  return multiply_add(a.x, b.x, multiply_add(a.y, b.y, a.z * b.z));
}

}  // namespace raytrace
