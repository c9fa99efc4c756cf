// A table's records for each lane, by the lane's own place in it.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

#include "raytrace/math/doubles.h"
#include "raytrace/math/inline.h"

namespace raytrace {

/// base[index], lane for lane. Flattened: that of xsimd 8 is a function a lane, none of which may stay one.
[[gnu::flatten]] inline RegisterFloats gather(const float* base, const Ints<RegisterFloats>& index) {
  return RegisterFloats::gather(base, index);
}
template <class Arch>
RAYTRACE_INLINE TwinBatch<float, Arch> gather(const float* base, const TwinBatch<std::int32_t, Arch>& index) {
  return {gather(base, index.lower()), gather(base, index.upper())};
}
/// Through float's: xsimd 8 has no instruction for that of integers.
inline IntN gather(const std::int32_t* base, const IntN& index) {
  return same_bits<IntN>(gather(reinterpret_cast<const float*>(base), index));
}

inline Doubles<FloatN> gather(const double* base, const IntN& index) {
  alignas(64) std::array<std::int32_t, packet_lanes> indices;
  index.store_aligned(indices.data());
  alignas(64) std::array<double, packet_lanes> values;
  for (std::size_t lane = 0; lane < packet_lanes; ++lane) values[lane] = base[indices[lane]];
  return Doubles<FloatN>::load_aligned(values.data());
}

namespace detail {

template <std::size_t lanes>
using CompilerFloats = CompilerVector<float, lanes>;

/// Four floats beside each other from each of base + offsets[0], base + offsets[4], base + offsets[8]...
template <std::size_t lanes>
RAYTRACE_INLINE CompilerFloats<lanes> load_rows(const float* base, const std::int32_t* offsets) {
  if constexpr (lanes == 4) {
    CompilerFloats<4> row;
    std::memcpy(&row, base + *offsets, sizeof row);
    return row;
  } else {
    return join(load_rows<lanes / 2>(base, offsets), load_rows<lanes / 2>(base, offsets + lanes / 2));
  }
}

/// The way back: four floats to each of base + offsets[0], base + offsets[4]...
template <std::size_t lanes>
RAYTRACE_INLINE void store_rows(const CompilerFloats<lanes>& rows, float* base, const std::int32_t* offsets) {
  for (std::size_t i = 0; i < lanes; i += 4)
    std::memcpy(base + offsets[i], reinterpret_cast<const float*>(&rows) + i, 4 * sizeof(float));
}

/// In each four lanes those of a (0 to 3) and b (4 to 7) that are named: what one instruction does.
template <int first, int second, int third, int fourth, class Vector, std::size_t... lane>
RAYTRACE_INLINE Vector shuffle_fours(const Vector& a, const Vector& b, std::index_sequence<lane...>) {
  constexpr std::array from = {first, second, third, fourth};
  constexpr int lanes = sizeof...(lane);
  return __builtin_shufflevector(a, b,
                                 (static_cast<int>(lane / 4 * 4) + from[lane % 4] % 4 + from[lane % 4] / 4 * lanes)...);
}

/// result[i] = base[i + offset of that lane], of four floats beside each other: loaded as they lie, and transposed, in
/// a fraction of the time of four gathers.
RAYTRACE_INLINE std::array<RegisterFloats, 4> gather_four(const float* base, const std::int32_t* offsets) {
  constexpr auto lanes = std::make_index_sequence<register_lanes>();
  const auto row = [&](int i) { return load_rows<register_lanes>(base, offsets + i); };
  const auto a = row(0), b = row(1), c = row(2), d = row(3);
  const auto low_ab = shuffle_fours<0, 4, 1, 5>(a, b, lanes), high_ab = shuffle_fours<2, 6, 3, 7>(a, b, lanes);
  const auto low_cd = shuffle_fours<0, 4, 1, 5>(c, d, lanes), high_cd = shuffle_fours<2, 6, 3, 7>(c, d, lanes);
  return {std::bit_cast<RegisterFloats>(shuffle_fours<0, 1, 4, 5>(low_ab, low_cd, lanes)),
          std::bit_cast<RegisterFloats>(shuffle_fours<2, 3, 6, 7>(low_ab, low_cd, lanes)),
          std::bit_cast<RegisterFloats>(shuffle_fours<0, 1, 4, 5>(high_ab, high_cd, lanes)),
          std::bit_cast<RegisterFloats>(shuffle_fours<2, 3, 6, 7>(high_ab, high_cd, lanes))};
}

RAYTRACE_INLINE void gather_four(const float* base, const std::int32_t* offsets, RegisterFloats* result) {
  const auto four = gather_four(base, offsets);
  for (std::size_t i = 0; i < 4; ++i) result[i] = four[i];
}
template <class Arch>
RAYTRACE_INLINE void gather_four(const float* base, const std::int32_t* offsets, TwinBatch<float, Arch>* result) {
  const auto lower = gather_four(base, offsets), upper = gather_four(base, offsets + register_lanes);
  for (std::size_t i = 0; i < 4; ++i) result[i] = {lower[i], upper[i]};
}

/// The way back: base[i + offset of that lane] = numbers[i].
RAYTRACE_INLINE void scatter_four(const std::array<RegisterFloats, 4>& numbers, float* base,
                                  const std::int32_t* offsets) {
  using Floats = CompilerFloats<register_lanes>;
  constexpr auto lanes = std::make_index_sequence<register_lanes>();
  const auto a = std::bit_cast<Floats>(numbers[0]), b = std::bit_cast<Floats>(numbers[1]);
  const auto c = std::bit_cast<Floats>(numbers[2]), d = std::bit_cast<Floats>(numbers[3]);
  const auto low_ab = shuffle_fours<0, 4, 1, 5>(a, b, lanes), high_ab = shuffle_fours<2, 6, 3, 7>(a, b, lanes);
  const auto low_cd = shuffle_fours<0, 4, 1, 5>(c, d, lanes), high_cd = shuffle_fours<2, 6, 3, 7>(c, d, lanes);
  store_rows<register_lanes>(shuffle_fours<0, 1, 4, 5>(low_ab, low_cd, lanes), base, offsets);
  store_rows<register_lanes>(shuffle_fours<2, 3, 6, 7>(low_ab, low_cd, lanes), base, offsets + 1);
  store_rows<register_lanes>(shuffle_fours<0, 1, 4, 5>(high_ab, high_cd, lanes), base, offsets + 2);
  store_rows<register_lanes>(shuffle_fours<2, 3, 6, 7>(high_ab, high_cd, lanes), base, offsets + 3);
}
template <class Arch>
RAYTRACE_INLINE void scatter_four(const TwinBatch<float, Arch>* numbers, float* base, const std::int32_t* offsets) {
  scatter_four({numbers[0].lower(), numbers[1].lower(), numbers[2].lower(), numbers[3].lower()}, base, offsets);
  scatter_four({numbers[0].upper(), numbers[1].upper(), numbers[2].upper(), numbers[3].upper()}, base,
               offsets + register_lanes);
}

}  // namespace detail

/// The lanes' records of so many floats, at least four, from base + offsets[lane] on, field by field; and the way back.
RAYTRACE_INLINE void gather_fields(const float* base, const std::int32_t* offsets, std::size_t fields, FloatN* result) {
  // The last four overlap with those before where their number is not a multiple of four.
  for (std::size_t field = 0; field + 4 < fields; field += 4)
    detail::gather_four(base + field, offsets, result + field);
  detail::gather_four(base + fields - 4, offsets, result + fields - 4);
}
RAYTRACE_INLINE void scatter_fields(const FloatN* numbers, std::size_t fields, float* base,
                                    const std::int32_t* offsets) {
  for (std::size_t field = 0; field + 4 < fields; field += 4)
    detail::scatter_four(numbers + field, base + field, offsets);
  detail::scatter_four(numbers + fields - 4, base + fields - 4, offsets);
}

/// A place in a table for each lane. It knows where all are the same: neighbours mostly hit the same thing.
class LaneIndices {
 public:
  LaneIndices(const IntN& lanes)  // implicit: it is the same
      : lanes_(lanes), first_(lanes.get(0)), all_same_(all(lanes == IntN(first_))) {}
  explicit LaneIndices(std::int32_t all) : lanes_(all), first_(all), all_same_(true) {}

  const IntN& lanes() const { return lanes_; }
  bool all_same() const { return all_same_; }
  std::size_t first() const { return static_cast<std::size_t>(first_); }

 private:
  IntN lanes_;
  std::int32_t first_;
  bool all_same_;
};

/// The lanes' records, gathered from a table: Record<T> is a struct template of T members only, and the result holds in
/// each lane the fields of table[place of that lane]. Wide is FloatN-like for float tables, Doubles for double ones.
template <template <class> class Record, class Wide, class Scalar>
Record<Wide> gather_records(const Record<Scalar>* table, const LaneIndices& places) {
  constexpr std::size_t fields = sizeof(Record<Scalar>) / sizeof(Scalar);
  static_assert(sizeof(Record<Scalar>) == fields * sizeof(Scalar) && sizeof(Record<Wide>) == fields * sizeof(Wide),
                "a record has members of its template argument's type only");
  const Scalar* base = reinterpret_cast<const Scalar*>(table);
  Record<Wide> result;
  Wide* const gathered = reinterpret_cast<Wide*>(&result);
  if (places.all_same()) {
    for (std::size_t field = 0; field < fields; ++field) gathered[field] = Wide(base[places.first() * fields + field]);
  } else {
    const IntN first_field = places.lanes() * IntN(static_cast<std::int32_t>(fields));
    if constexpr (fields >= 4 && std::is_same_v<Wide, FloatN>) {
      alignas(64) std::array<std::int32_t, packet_lanes> offsets;
      first_field.store_aligned(offsets.data());
      gather_fields(base, offsets.data(), fields, gathered);
    } else
      for (std::size_t field = 0; field < fields; ++field) gathered[field] = gather(base + field, first_field);
  }
  return result;
}

}  // namespace raytrace
