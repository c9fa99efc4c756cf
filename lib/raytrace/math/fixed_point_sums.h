// Sums that do not depend on the order of their terms.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "raytrace/math/doubles.h"

namespace raytrace {

/// Sums of floats in fixed point. Each term is rounded to a whole number of units, and whole numbers add exactly: the
/// same terms give the same sum in whatever order and groups.
/// F: a batch of terms. count: of the sums, a power of two; lane i of a batch is a term of sum i % count.
template <class F, std::size_t count = F::size>
class FixedPointSums {
 public:
  /// The most units that a term may stand for, either sign. What is larger goes by whole_units().
  static constexpr double largest_term = 0x1p51;

  /// units: one over the unit, a power of two.
  RAYTRACE_INLINE void add(const F& terms, double units) {
    // In [2^52, 2^53) a double's unit in the last place is 1, so this addition rounds the term to a whole number and
    // leaves it in the low bits of the double, over those of the constant.
    const Doubles<F> rounded = multiply_add(Doubles<F>(terms), Doubles<F>(units), Doubles<F>(offset));
    const auto more = joined(registers_of(rounded));
    for (std::size_t i = 0; i < registers; ++i) totals_[i] = totals_[i] + more[i];
    ++batches_;
  }

  /// The sums of all terms so far. They wrap where they leave the range of 64 bits: with terms as large as may be, 4096
  /// of one sum do.
  RAYTRACE_INLINE std::array<std::int64_t, count> sums() const {
    alignas(64) std::array<std::uint64_t, registers * Counts::size> totals;
    for (std::size_t i = 0; i < registers; ++i) totals_[i].store_aligned(totals.data() + i * Counts::size);
    std::array<std::int64_t, count> sums;
    for (std::size_t i = 0; i < count; ++i) {
      std::uint64_t total = 0;
      for (std::size_t lane = i; lane < totals.size(); lane += count) total += totals[lane];
      sums[i] = static_cast<std::int64_t>(total - all_offsets());
    }
    return sums;
  }

  /// The same, each rounded to the nearest double.
  RAYTRACE_INLINE std::array<double, count> rounded_sums() const {
    std::array<double, count> rounded;
    if constexpr (count < Counts::size) {
      const auto sums = this->sums();
      std::transform(sums.begin(), sums.end(), rounded.begin(), [](std::int64_t sum) { return double(sum); });
    } else {
      using Sums = xsimd::batch<std::int64_t, typename F::arch_type>;
      for (std::size_t i = 0; i < registers; ++i)
        xsimd::to_float(std::bit_cast<Sums>(totals_[i] - Counts(all_offsets())))
            .store_unaligned(rounded.data() + i * Counts::size);
    }
    return rounded;
  }

 private:
  using Counts = xsimd::batch<std::uint64_t, typename F::arch_type>;
  static constexpr std::size_t registers = std::max<std::size_t>(1, count / Counts::size);
  static constexpr double offset = 0x1.8p52;  // the middle of its range, for terms of both signs

  /// What the terms' offsets make of a sum.
  std::uint64_t all_offsets() const { return F::size / count * batches_ * std::bit_cast<std::uint64_t>(offset); }

  template <class D>
  static RAYTRACE_INLINE auto registers_of(const D& doubles) {
    if constexpr (D::size == Counts::size) {
      return std::array{std::bit_cast<Counts>(doubles)};
    } else {
      const auto lower = registers_of(doubles.lower()), upper = registers_of(doubles.upper());
      std::array<Counts, D::size / Counts::size> both;
      std::copy(upper.begin(), upper.end(), std::copy(lower.begin(), lower.end(), both.begin()));
      return both;
    }
  }

  /// By halves: they do not wait for each other as in a chain.
  template <std::size_t size>
  static RAYTRACE_INLINE std::array<Counts, registers> joined(const std::array<Counts, size>& counts) {
    if constexpr (size == registers) {
      return counts;
    } else {
      std::array<Counts, size / 2> halves;
      for (std::size_t i = 0; i < halves.size(); ++i) halves[i] = counts[i] + counts[i + halves.size()];
      return joined(halves);
    }
  }

  std::array<Counts, registers> totals_ = [] {
    std::array<Counts, registers> zeros;
    zeros.fill(Counts(std::uint64_t{0}));
    return zeros;
  }();
  std::uint64_t batches_ = 0;
};

}  // namespace raytrace
