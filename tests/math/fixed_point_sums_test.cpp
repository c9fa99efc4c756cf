// Sums that are exact, whatever the order, the groups and the instruction set.
#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <vector>

#include "support/catch.h"
#include "support/usable_isas.h"
#include "support/wide_arithmetic.h"

namespace raytrace::test {

namespace {

constexpr double units = 0x1p20;

/// Calls check(sum) for every instruction set and width: sum(terms, units) are the sums by it.
template <class Check>
void for_each_way(Check check) {
  for (const std::string& isa : usable_isas())
    for (const int lanes : {4, 8, 16}) {
      INFO(isa << " in registers of " << lanes);
      check([&](std::span<const WideLanes> terms, double scale) {
        return wide_arithmetic(isa).fixed_point_sums(lanes, terms, scale);
      });
    }
}

/// Of both signs, from far below the unit to far above it.
std::vector<WideLanes> random_terms(std::size_t count) {
  std::mt19937 bits(6);
  std::vector<WideLanes> terms(count);
  for (WideLanes& values : terms)
    for (float& value : values) {
      const float mantissa = static_cast<float>((bits() >> 8) | (1u << 23));
      value = std::ldexp((bits() & 1) != 0 ? mantissa : -mantissa, static_cast<int>(bits() % 50) - 50);
    }
  return terms;
}

/// Each term rounded to a whole number, halves to the even one; added as integers.
WideSums wanted_sums(std::span<const WideLanes> terms) {
  WideSums sums{};
  for (const WideLanes& values : terms)
    for (std::size_t lane = 0; lane < sums.size(); ++lane) sums[lane] += std::llrint(double{values[lane]} * units);
  return sums;
}

WideLanes everywhere(float value) {
  WideLanes values;
  values.fill(value);
  return values;
}

}  // namespace

TEST_CASE("fixed-point sums are those of the rounded terms, in any order and in any groups") {
  std::vector<WideLanes> terms = random_terms(1000);
  const WideSums wanted = wanted_sums(terms);
  for_each_way([&](const auto& sum) {
    std::mt19937 random(7);
    for (int i = 0; i < 5; ++i) {
      CHECK(sum(terms, units) == wanted);
      const std::size_t middle = random() % terms.size();
      WideSums parts = sum(std::span(terms).first(middle), units);
      const WideSums rest = sum(std::span(terms).subspan(middle), units);
      for (std::size_t lane = 0; lane < parts.size(); ++lane) parts[lane] += rest[lane];
      CHECK(parts == wanted);
      std::shuffle(terms.begin(), terms.end(), random);
    }
  });
}

TEST_CASE("each term of a fixed-point sum is rounded to the nearest unit, halves to the even one") {
  for_each_way([](const auto& sum) {
    const auto rounded = [&](float term) { return sum(std::vector{everywhere(term)}, 1)[0]; };
    CHECK(rounded(0.49999997f) == 0);
    CHECK(rounded(0.5f) == 0);
    CHECK(rounded(0.50000006f) == 1);
    CHECK(rounded(1.5f) == 2);
    CHECK(rounded(2.5f) == 2);
    CHECK(rounded(-0.5f) == 0);
    CHECK(rounded(-1.5f) == -2);
    CHECK(rounded(-2.5f) == -2);
    CHECK(rounded(-2.6f) == -3);
    CHECK(rounded(0x1p-149f) == 0);
  });
}

TEST_CASE("fixed-point sums of the largest terms keep every unit") {
  for_each_way([](const auto& sum) {
    const WideLanes largest = everywhere(0x1p51f), one = everywhere(1);
    std::vector<WideLanes> terms(100, largest);
    terms.push_back(one);
    CHECK(sum(terms, 1)[3] == 100 * (std::int64_t{1} << 51) + 1);
    terms.insert(terms.end(), 101, everywhere(-0x1p51f));
    CHECK(sum(terms, 1)[3] == 1 - (std::int64_t{1} << 51));
    CHECK(sum({}, 1) == WideSums{});
  });
}

TEST_CASE("fixed-point sums become the nearest doubles") {
  std::vector<WideLanes> terms = random_terms(20);
  terms.insert(terms.end(), 40, everywhere(0x1.fffffep30f));  // so that sums have more digits than doubles
  for (const std::string& isa : usable_isas())
    for (const int lanes : {4, 8, 16})
      for (std::size_t count = 0; count <= terms.size(); ++count) {
        INFO(count << " terms, " << isa << " in registers of " << lanes);
        const auto some = std::span(terms).first(count);
        const WideSums sums = wide_arithmetic(isa).fixed_point_sums(lanes, some, units);
        WideDoubles wanted;
        std::ranges::transform(sums, wanted.begin(), [](std::int64_t sum) { return static_cast<double>(sum); });
        CHECK(wide_arithmetic(isa).rounded_sums(lanes, some, units) == wanted);
      }
}

TEST_CASE("several lanes' terms meet in one fixed-point sum") {
  std::vector<float> terms;
  for (const WideLanes& values : random_terms(8)) terms.insert(terms.end(), values.begin(), values.end());
  for (const std::string& isa : usable_isas())
    for (const std::size_t count : {1U, 2U, 4U, 8U}) {
      INFO(count << " sums, " << isa);
      std::vector<std::int64_t> wanted(count);
      for (std::size_t i = 0; i < terms.size(); ++i) wanted[i % count] += std::llrint(double{terms[i]} * units);
      const PacketSums sums = wide_arithmetic(isa).packet_sums(static_cast<int>(count), terms, units);
      CHECK(sums.exact == wanted);
      CHECK(sums.rounded == std::vector<double>(wanted.begin(), wanted.end()));
    }
}

}  // namespace raytrace::test
