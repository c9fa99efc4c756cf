// Sums that do not depend on the order of their terms.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "raytrace/math/doubles.h"

namespace raytrace {

/// Sums of floats in fixed point, lane for lane beside the floats F. Each term is rounded to a whole number of units,
/// and whole numbers add exactly: the same terms give the same sum in whatever order and groups.
template <class F>
class FixedPointSums {
 public:
  /// The most units that a term may stand for, either sign.
  static constexpr double largest_term = 0x1p51;

  /// units: one over the unit, a power of two, in every lane.
  RAYTRACE_INLINE void add(const F& terms, const Doubles<F>& units) {
    // In [2^52, 2^53) a double's unit in the last place is 1, so this addition rounds the term to a whole number and
    // leaves it in the low bits of the double, over those of the constant.
    const Doubles<F> rounded = multiply_add(Doubles<F>(terms), units, Doubles<F>(offset));
    lower_ = lower_ + std::bit_cast<Counts>(rounded.lower());
    upper_ = upper_ + std::bit_cast<Counts>(rounded.upper());
    ++terms_;
  }

  /// The sums of all terms so far, one a lane. They wrap where they leave the range of 64 bits.
  std::array<std::int64_t, F::size> sums() const { return sums_of_every<F::size>(); }

  /// The same of lanes i, i + step, i + 2 step, ... together, for each i below step, a power of two.
  template <std::size_t step>
  RAYTRACE_INLINE std::array<std::int64_t, step> sums_of_every() const {
    constexpr bool joined = step <= Counts::size;
    constexpr std::size_t left = joined ? Counts::size : F::size;
    alignas(64) std::array<std::uint64_t, left> totals;
    if constexpr (joined) {
      (lower_ + upper_).store_aligned(totals.data());
    } else {
      lower_.store_aligned(totals.data());
      upper_.store_aligned(totals.data() + Counts::size);
    }
    std::array<std::int64_t, step> sums;
    for (std::size_t i = 0; i < step; ++i) {
      std::uint64_t total = 0;
      for (std::size_t lane = i; lane < left; lane += step) total += totals[lane];
      sums[i] = static_cast<std::int64_t>(total - (F::size / step) * terms_ * std::bit_cast<std::uint64_t>(offset));
    }
    return sums;
  }

  /// The same, each rounded to the nearest double.
  template <std::size_t step>
  RAYTRACE_INLINE std::array<double, step> rounded_sums_of_every() const {
    std::array<double, step> rounded;
    if constexpr (step < Counts::size) {
      const auto sums = sums_of_every<step>();
      std::transform(sums.begin(), sums.end(), rounded.begin(), [](std::int64_t sum) { return double(sum); });
    } else if constexpr (step == Counts::size) {
      to_doubles(lower_ + upper_, 2 * terms_).store_unaligned(rounded.data());
    } else {
      to_doubles(lower_, terms_).store_unaligned(rounded.data());
      to_doubles(upper_, terms_).store_unaligned(rounded.data() + Counts::size);
    }
    return rounded;
  }

  /// Lane by lane.
  friend RAYTRACE_INLINE FixedPointSums operator+(const FixedPointSums& a, const FixedPointSums& b) {
    FixedPointSums both;
    both.lower_ = a.lower_ + b.lower_;
    both.upper_ = a.upper_ + b.upper_;
    both.terms_ = a.terms_ + b.terms_;
    return both;
  }

 private:
  using Counts = xsimd::batch<std::uint64_t, typename F::arch_type>;
  static constexpr double offset = 0x1.8p52;  // the middle of its range, for terms of both signs

  static RAYTRACE_INLINE auto to_doubles(const Counts& totals, std::uint64_t terms) {
    using Sums = xsimd::batch<std::int64_t, typename F::arch_type>;
    return xsimd::to_float(std::bit_cast<Sums>(totals - Counts(terms * std::bit_cast<std::uint64_t>(offset))));
  }

  Counts lower_ = Counts(std::uint64_t{0}),
         upper_ = Counts(std::uint64_t{0});  // in braces, xsimd 8 takes it for a list
  std::uint64_t terms_ = 0;
};

/// Of two registers of floats.
template <class Arch>
class FixedPointSums<TwinBatch<float, Arch>> {
 public:
  using Floats = TwinBatch<float, Arch>;
  using Part = FixedPointSums<typename Floats::Part>;
  static constexpr double largest_term = Part::largest_term;

  RAYTRACE_INLINE void add(const Floats& terms, const Doubles<Floats>& units) {
    lower_.add(terms.lower(), units.lower());
    upper_.add(terms.upper(), units.upper());
  }

  std::array<std::int64_t, Floats::size> sums() const { return sums_of_every<Floats::size>(); }

  template <std::size_t step>
  RAYTRACE_INLINE std::array<std::int64_t, step> sums_of_every() const {
    constexpr std::size_t part_size = Floats::Part::size;
    if constexpr (step <= part_size) {
      return (lower_ + upper_).template sums_of_every<step>();
    } else {
      const auto lower = lower_.sums(), upper = upper_.sums();
      std::array<std::int64_t, step> sums;
      std::copy(lower.begin(), lower.end(), sums.begin());
      std::copy(upper.begin(), upper.end(), sums.begin() + part_size);
      return sums;
    }
  }

  template <std::size_t step>
  RAYTRACE_INLINE std::array<double, step> rounded_sums_of_every() const {
    constexpr std::size_t part_size = Floats::Part::size;
    if constexpr (step <= part_size) {
      return (lower_ + upper_).template rounded_sums_of_every<step>();
    } else {
      const auto lower = lower_.template rounded_sums_of_every<part_size>(),
                 upper = upper_.template rounded_sums_of_every<part_size>();
      std::array<double, step> sums;
      std::copy(lower.begin(), lower.end(), sums.begin());
      std::copy(upper.begin(), upper.end(), sums.begin() + part_size);
      return sums;
    }
  }

 private:
  Part lower_, upper_;
};

}  // namespace raytrace
