// Whole numbers of two limbs.
#include "raytrace/math/limbs.h"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "support/catch.h"
#include "support/usable_isas.h"
#include "support/wide_arithmetic.h"

namespace raytrace::test {

TEST_CASE("the high limb of a number is 0 where 64 bits can hold it") {
  constexpr std::int64_t least = std::numeric_limits<std::int64_t>::min(), most = -(least + 1);
  for (const std::int64_t number : {std::int64_t{0}, std::int64_t{1}, std::int64_t{-1}, most, least}) {
    CHECK(limbs_of(number).low == number);
    CHECK(limbs_of(number).high == 0);
  }
  CHECK(limbs_of(Int128{most} + 1).low == least);
  CHECK(limbs_of(Int128{most} + 1).high == 1);
  CHECK(limbs_of(Int128{least} - 1).low == most);
  CHECK(limbs_of(Int128{least} - 1).high == -1);
}

TEST_CASE("limbs make the number that they were of") {
  std::mt19937_64 bits(3);
  for (int i = 0; i < 1000; ++i) {
    const Int128 number = (Int128{static_cast<std::int64_t>(bits())} << (bits() % 60)) + static_cast<int>(bits());
    CHECK((from_limbs(limbs_of(number)) == number));
  }
}

TEST_CASE("a term's whole units are those that fixed-point sums count") {
  std::mt19937 bits(4);
  for (const std::string& isa : usable_isas())
    for (int i = 0; i < 200; ++i) {
      WideLanes terms;
      for (float& term : terms)
        term = std::ldexp(static_cast<float>(static_cast<std::int32_t>(bits())), static_cast<int>(bits() % 40) - 40);
      const WideSums sums = wide_arithmetic(isa).fixed_point_sums(16, std::vector{terms}, 0x1p20);
      for (std::size_t lane = 0; lane < terms.size(); ++lane)
        CHECK((whole_units(terms[lane], 0x1p20) == Int128{sums[lane]}));
    }
  CHECK((whole_units(0x1.8p83F, 0.5) == Int128{3} << 81));
  CHECK((whole_units(-0x1p-40F, 0x1p123) == -(Int128{1} << 83)));
}

}  // namespace raytrace::test
