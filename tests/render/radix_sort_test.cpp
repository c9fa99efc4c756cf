#include "raytrace/parallel/radix_sort.h"

#include <algorithm>
#include <random>

#include "support/catch.h"

namespace raytrace::test {

namespace {

struct Numbered {
  std::uint32_t key, number;
  bool operator==(const Numbered&) const = default;
};

}  // namespace

TEST_CASE("items are sorted by their keys, those of one key in their order, by any number of threads") {
  std::mt19937 bits(3);
  for (const std::uint32_t keys : {1U, 50'000U, 0xffffffffU}) {
    for (const std::uint32_t count : {0U, 1U, 1000U, 100'003U}) {
      std::vector<Numbered> items(count);
      for (std::uint32_t i = 0; i < count; ++i) items[i] = {static_cast<std::uint32_t>(bits()) % keys, i};
      std::vector<Numbered> wanted = items;
      std::stable_sort(wanted.begin(), wanted.end(),
                       [](const Numbered& a, const Numbered& b) { return a.key < b.key; });
      for (const int threads : {1, 2, 3, 8}) {
        std::vector<Numbered> sorted = items;
        radix_sort(sorted, threads);
        INFO(count << " items of " << keys << " keys, " << threads << " threads");
        CHECK(sorted == wanted);
      }
    }
  }
}

}  // namespace raytrace::test
