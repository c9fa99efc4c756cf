// What light paths bring to a film is summed exactly, by however many threads.
#include "raytrace/film/splat_layer.h"

#include <random>
#include <thread>
#include <vector>

#include "support/catch.h"

namespace raytrace::test {

TEST_CASE("sums of splats are exact whoever adds them") {
  // Large ones of both signs: the lower 64 bits overflow again and again, and the sum is far from all of them.
  std::mt19937_64 bits(7);
  std::vector<RadianceSum> terms;
  RadianceSum total{};
  for (int i = 0; i < 4000; ++i) {
    RadianceSum term;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const auto value = static_cast<std::int64_t>(bits());
      term[channel] = Int128{value} * static_cast<std::int64_t>(bits() % (std::uint64_t{1} << (bits() % 18)) + 1);
      total[channel] += term[channel];
    }
    terms.push_back(term);
  }
  SplatLayer layer({3, 4, 10, 9}, 35);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (std::size_t i = t; i < terms.size(); i += 4) layer.add(9, 8, terms[i]);
    });
  for (std::thread& thread : threads) thread.join();
  CHECK(layer.sum(9, 8) == total);
  CHECK(layer.has_high());
  CHECK(layer.sum(9, 7) == RadianceSum{});
}

TEST_CASE("pixels of a part share all light paths of the picture") {
  // A picture of 7 x 5, and parts of it; the last reaches beyond it.
  for (const Region& region : {Region{0, 0, 7, 5}, Region{2, 1, 4, 4}, Region{6, 4, 7, 5}, Region{-3, -2, 9, 8}}) {
    const SplatLayer layer(region, 35);
    std::vector<int> seen(35);
    for (int y = region.y0; y < region.y1; ++y)
      for (int x = region.x0; x < region.x1; ++x)
        for (std::uint64_t i = 0; i < layer.paths_per_sample(x, y); ++i) ++seen.at(layer.path_pixel(x, y, i));
    CHECK(seen == std::vector<int>(35, 1));
  }
}

}  // namespace raytrace::test
