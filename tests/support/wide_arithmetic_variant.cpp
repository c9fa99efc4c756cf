#include <algorithm>

#include "raytrace/math/doubles.h"
#include "raytrace/math/fixed_point_sums.h"
#include "support/wide_arithmetic.h"

namespace raytrace::test {

namespace {

template <int lanes, class Operation>
WideLanes in_registers(const WideLanes& a, const WideLanes& b, const WideLanes& c, Operation operation) {
  using F = FloatLanes<lanes>;
  WideLanes result;
  for (std::size_t first = 0; first < result.size(); first += F::size) {
    const auto load = [&](const WideLanes& values) { return F::load_unaligned(values.data() + first); };
    operation(load(a), load(b), load(c)).store_unaligned(result.data() + first);
  }
  return result;
}

template <class Operation>
WideLanes apply(int lanes, const WideLanes& a, const WideLanes& b, const WideLanes& c, Operation operation) {
  switch (lanes) {
    case 4:
      return in_registers<4>(a, b, c, operation);
    case 8:
      return in_registers<8>(a, b, c, operation);
    default:
      return in_registers<16>(a, b, c, operation);
  }
}

WideLanes fused(int lanes, const WideLanes& a, const WideLanes& b, const WideLanes& c) {
  return apply(lanes, a, b, c, []<class F>(const F& x, const F& y, const F& z) { return exact_fma(x, y, z); });
}

WideLanes double_sum(int lanes, const WideLanes& a, const WideLanes& b, const WideLanes& c) {
  return apply(lanes, a, b, c, []<class F>(const F& x, const F& y, const F& z) {
    return multiply_add(Doubles<F>(x), Doubles<F>(y), Doubles<F>(z)).to_float();
  });
}

WideLanes below(int lanes, const WideLanes& a, const WideLanes& b, const WideLanes& c) {
  return apply(lanes, a, b, c, []<class F>(const F& x, const F& y, const F& z) {
    return select(Doubles<F>::float_mask(Doubles<F>(x) * Doubles<F>(y) < Doubles<F>(z)), F(1), F(0));
  });
}

/// of(sums): an array of the sums of as many lanes as F has.
template <class Result, class F, class Of>
Result sums_of(std::span<const WideLanes> terms, double units, const Of& of) {
  Result result;
  for (std::size_t first = 0; first < result.size(); first += F::size) {
    FixedPointSums<F> sums;
    for (const WideLanes& values : terms) sums.add(F::load_unaligned(values.data() + first), units);
    std::ranges::copy(of(sums), result.begin() + static_cast<std::ptrdiff_t>(first));
  }
  return result;
}

template <class Result, class Of>
Result sums_of(int lanes, std::span<const WideLanes> terms, double units, const Of& of) {
  switch (lanes) {
    case 4:
      return sums_of<Result, FloatLanes<4>>(terms, units, of);
    case 8:
      return sums_of<Result, FloatLanes<8>>(terms, units, of);
    default:
      return sums_of<Result, FloatLanes<16>>(terms, units, of);
  }
}

WideSums fixed_point_sums(int lanes, std::span<const WideLanes> terms, double units) {
  return sums_of<WideSums>(lanes, terms, units, [](const auto& sums) { return sums.sums(); });
}

WideDoubles rounded_sums(int lanes, std::span<const WideLanes> terms, double units) {
  return sums_of<WideDoubles>(lanes, terms, units, [](const auto& sums) { return sums.rounded_sums(); });
}

template <std::size_t count>
PacketSums sums_of_packets(std::span<const float> terms, double units) {
  FixedPointSums<FloatN, count> sums;
  for (std::size_t i = 0; i < terms.size(); i += packet_lanes) sums.add(FloatN::load_unaligned(&terms[i]), units);
  const auto exact = sums.sums();
  const auto rounded = sums.rounded_sums();
  return {{exact.begin(), exact.end()}, {rounded.begin(), rounded.end()}};
}

PacketSums packet_sums(int count, std::span<const float> terms, double units) {
  switch (count) {
    case 1:
      return sums_of_packets<1>(terms, units);
    case 2:
      return sums_of_packets<2>(terms, units);
    case 4:
      return sums_of_packets<4>(terms, units);
    default:
      return sums_of_packets<8>(terms, units);
  }
}

}  // namespace

}  // namespace raytrace::test

#define RAYTRACE_JOIN_NAMES(a, b) a##b
#define RAYTRACE_JOIN(a, b) RAYTRACE_JOIN_NAMES(a, b)

extern "C" const raytrace::test::WideArithmetic* RAYTRACE_JOIN(raytrace_arithmetic_, RAYTRACE_VARIANT)() {
  static constexpr raytrace::test::WideArithmetic arithmetic{
      &raytrace::test::fused,        &raytrace::test::double_sum,
      &raytrace::test::below,        &raytrace::test::fixed_point_sums,
      &raytrace::test::rounded_sums, &raytrace::test::packet_sums};
  return &arithmetic;
}
