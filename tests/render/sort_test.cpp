#include "raytrace/parallel/sort.h"

#include <functional>
#include <random>

#include "support/catch.h"

namespace raytrace::test {

TEST_CASE("items are sorted as by std::sort, by any number of threads") {
  std::mt19937 bits(3);
  for (const std::size_t count : {0U, 1U, 1000U, 100'003U}) {
    std::vector<unsigned> items(count);
    for (unsigned& item : items) item = static_cast<unsigned>(bits() % 50'000);  // some of them the same
    std::vector<unsigned> wanted = items;
    std::sort(wanted.begin(), wanted.end(), std::greater<>());
    for (const int threads : {1, 2, 3, 8}) {
      std::vector<unsigned> sorted = items;
      sort(sorted, threads, std::greater<>());
      INFO(count << " items, " << threads << " threads");
      CHECK(sorted == wanted);
    }
  }
}

}  // namespace raytrace::test
