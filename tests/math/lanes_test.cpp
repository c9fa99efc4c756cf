// Masks, selections and gathers.
#include "support/lanes.h"

#include <numeric>
#include <vector>

#include "raytrace/math/doubles.h"
#include "raytrace/math/gather.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

template <class T>
struct Record {
  T a, b, c;
};

template <class Scalar>
std::vector<Record<Scalar>> table() {
  std::vector<Record<Scalar>> result;
  for (int i = 0; i < 1000; ++i)
    result.push_back({static_cast<Scalar>(i), static_cast<Scalar>(i * 3 + 1), static_cast<Scalar>(-i * i)});
  return result;
}

/// Indices of the table's records that differ, that are equal, and that reach its end.
std::vector<IntN> index_packets() {
  const auto packet = [](auto f) { return batch_of<IntN>(f); };
  return {packet([](std::size_t i) { return 37 * i; }),
          packet([](std::size_t) { return 500; }),
          packet([](std::size_t) { return 999; }),
          packet([](std::size_t i) { return 999 - i; }),
          packet([](std::size_t i) { return i == lanes - 1 ? 3 : 4; }),
          IntN(0)};
}

}  // namespace

TEST_CASE("a mask's bits are its lanes, lane 0 lowest") {
  const FloatN numbers = batch_of<FloatN>([](std::size_t i) { return i; });
  for (std::uint32_t bits = 0; bits < 1u << lanes; bits += lanes > 8 ? 37 : 1) {
    const MaskN mask = batch_of<FloatN>([&](std::size_t i) { return bits >> i & 1; }) > FloatN(0);
    if (bits_of<FloatN>(mask) != bits) FAIL("bits " << bits);
  }
  for (int count = 0; count <= packet_lanes; ++count)
    CHECK(bits_of<FloatN>(first_lanes<FloatN>(count)) == (1u << count) - 1);
  constexpr std::uint32_t all = (1U << lanes) - 1;
  CHECK(bits_of<FloatN>(numbers == FloatN(2)) == 4);
  CHECK(bits_of<FloatN>(numbers != FloatN(2)) == (all ^ 4U));
  CHECK(bits_of<FloatN>(!(numbers == FloatN(2))) == (all ^ 4U));
  CHECK(bits_of<FloatN>(!MaskN(false)) == all);
  CHECK(bits_of<FloatN>(!MaskN(true)) == 0);
}

TEST_CASE("a comparison of integers is a mask of floats, and selects integers") {
  const IntN numbers = batch_of<IntN>([](std::size_t i) { return static_cast<int>(i) - 1; });
  const MaskN mask = float_mask<FloatN>(numbers == IntN(1));
  CHECK(bits_of<FloatN>(mask) == 4);
  CHECK(bits_of<FloatN>(float_mask<FloatN>(numbers != IntN(1))) == (((1U << lanes) - 1) ^ 4U));
  // Numbers whose bits are NaNs and denormals of float must come through as they are.
  const IntN chosen = select_lanes(mask, IntN(-1), IntN(1));
  for (std::size_t lane = 0; lane < lanes; ++lane) CHECK(chosen.get(lane) == (lane == 2 ? -1 : 1));
}

TEST_CASE("records are gathered by each lane's index") {
  const auto floats = table<float>();
  const auto doubles = table<double>();
  const auto ints = table<std::int32_t>();
  for (const IntN& index : index_packets()) {
    const auto float_records = gather_records<Record, FloatN>(floats.data(), index);
    const auto double_records = gather_records<Record, Doubles<FloatN>>(doubles.data(), index);
    const auto int_records = gather_records<Record, IntN>(ints.data(), index);
    const FloatN from_double[3] = {double_records.a.to_float(), double_records.b.to_float(),
                                   double_records.c.to_float()};
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const auto i = static_cast<std::size_t>(index.get(lane));
      CHECK(float_records.a.get(lane) == floats[i].a);
      CHECK(float_records.b.get(lane) == floats[i].b);
      CHECK(float_records.c.get(lane) == floats[i].c);
      CHECK(from_double[0].get(lane) == floats[i].a);
      CHECK(from_double[1].get(lane) == floats[i].b);
      CHECK(from_double[2].get(lane) == floats[i].c);
      CHECK(int_records.a.get(lane) == ints[i].a);
      CHECK(int_records.b.get(lane) == ints[i].b);
      CHECK(int_records.c.get(lane) == ints[i].c);
    }
  }
}

TEST_CASE("double records keep their precision") {
  const std::vector<Record<double>> records{{1 + 0x1p-50, 0, 0}, {2 + 0x1p-49, 0, 0}};
  const IntN index = batch_of<IntN>([](std::size_t i) { return i % 2; });
  const auto gathered = gather_records<Record, Doubles<FloatN>>(records.data(), index);
  const FloatN rest =
      (gathered.a - Doubles<FloatN>(batch_of<FloatN>([](std::size_t i) { return 1 + i % 2; }))).to_float();
  for (std::size_t lane = 0; lane < lanes; ++lane) CHECK(rest.get(lane) == (lane % 2 == 0 ? 0x1p-50f : 0x1p-49f));
}

}  // namespace raytrace::test
