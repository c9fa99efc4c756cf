// What a picture depends on: not on threads, nor on how it is cut, hardly on the instruction set; on the seed only in
// its noise.
#include <cmath>
#include <random>

#include "render/scenes.h"
#include "support/catch.h"
#include "support/usable_isas.h"

namespace raytrace::test {

TEST_CASE("a picture's bytes are the same from any number of threads") {
  const SceneDescription description = parsed_scene(busy_scene(150, 110, 3));
  const FloatPicture wanted = rendered(description, 1);
  for (const int threads : {2, 3, 8}) {
    INFO(threads << " threads");
    CHECK(identical(rendered(description, threads), wanted));
  }
}

TEST_CASE("a crop's bytes are those of the whole picture") {
  const SceneDescription description = parsed_scene(busy_scene(101, 77, 2));
  for (const std::string& isa : usable_isas()) {
    const auto scene = build_scene(description, {1, isa});
    RayCounts rays;
    const FloatPicture all = render(*scene, description, {1, 5, whole(description)}, rays);
    std::mt19937 bits(9);
    const auto below = [&](int n) { return static_cast<int>(bits() % static_cast<unsigned>(n)); };
    for (int i = 0; i < 20; ++i) {
      Region crop;
      crop.x0 = below(101);
      crop.y0 = below(77);
      crop.x1 = i % 5 == 0 ? crop.x0 + 1 : crop.x0 + 1 + below(101 - crop.x0);
      crop.y1 = i % 7 == 0 ? crop.y0 + 1 : crop.y0 + 1 + below(77 - crop.y0);
      const FloatPicture part = render(*scene, description, {1, 5, crop}, rays);
      CHECK(part.extent().full_width == 101);
      CHECK(part.region() == crop);
      int wrong = 0;
      for (int y = crop.y0; y < crop.y1; ++y)
        for (int x = crop.x0; x < crop.x1; ++x) wrong += !identical(part.at(x, y), all.at(x, y));
      INFO(isa << ": " << crop.x0 << "," << crop.y0 << "," << crop.x1 << "," << crop.y1);
      CHECK(wrong == 0);
    }
  }
}

TEST_CASE("pixels beyond the picture do not depend on what else is rendered, nor those of the picture on them") {
  for (const int samples : {1, 3, 4, 8, 16}) {  // packets of several shapes
    const SceneDescription description = parsed_scene(busy_scene(50, 38, samples));
    for (const std::string& isa : usable_isas()) {
      const auto scene = build_scene(description, {1, isa});
      RayCounts rays;
      const auto all = render(*scene, description, {3, 5, {-50, -38, 100, 76}}, rays);
      for (const Region& crop :
           {whole(description), Region{-50, -38, 0, 0}, Region{-1, -1, 1, 1}, Region{-9, 3, 57, 41},
            Region{-17, -11, -4, 20}, Region{49, 37, 100, 76}, Region{60, -30, 90, -5}}) {
        const Film part = render(*scene, description, {1, 5, crop}, rays);
        int wrong = 0;
        for (int y = crop.y0; y < crop.y1; ++y)
          for (int x = crop.x0; x < crop.x1; ++x) wrong += !identical(part.pixel(x, y), all.pixel(x, y));
        INFO(isa << ", " << samples << " samples: " << text_of(crop));
        CHECK(wrong == 0);
      }
    }
  }
}

TEST_CASE("another seed gives another picture of the same thing, the same seed the same picture") {
  const SceneDescription description = parsed_scene(busy_scene(64, 48, 64));
  const FloatPicture first = rendered(description, 1, {}, 1), second = rendered(description, 1, {}, 2);
  CHECK(identical(rendered(description, 1, {}, 1), first));
  CHECK(!identical(rendered(description, 1, {}, 1ull << 32), rendered(description, 1, {}, 0)));

  double sum = 0, sum_of_squares = 0;
  int different = 0;
  for (std::size_t i = 0; i < first.pixels().size(); ++i) {
    const double d = static_cast<double>(first.pixels()[i].green) - static_cast<double>(second.pixels()[i].green);
    different += d != 0;
    sum += d;
    sum_of_squares += d * d;
  }
  const auto count = static_cast<double>(first.pixels().size());
  CHECK(different > 0.9 * count);
  CHECK(std::sqrt(sum_of_squares / count) < 0.05);
  CHECK(std::abs(sum) < 4 * std::sqrt(sum_of_squares));  // no bias: four standard deviations of the sum
}

TEST_CASE("one sample a pixel leaves nothing to the seed") {
  const SceneDescription description = parsed_scene(busy_scene(64, 48, 1));
  CHECK(identical(rendered(description, 1, {}, 1), rendered(description, 1, {}, 2)));
}

TEST_CASE("instruction sets agree but for silhouettes") {
  const SceneDescription description = parsed_scene(busy_scene(160, 120, 1));
  const std::vector<std::string> isas = usable_isas();
  const FloatPicture wanted = rendered(description, 1, isas.front());
  for (const std::string& isa : isas) {
    const FloatPicture film = rendered(description, 1, isa);
    int differing = 0;
    for (std::size_t i = 0; i < film.pixels().size(); ++i)
      differing += difference(film.pixels()[i], wanted.pixels()[i]) > 1e-4;
    INFO(isa << ": " << differing << " pixels differ");
    CHECK(differing <= 160 * 120 / 200);
  }
}

TEST_CASE("a scene knows the instruction set it was built for, and refuses ones that there are not") {
  const SceneDescription description = parsed_scene(busy_scene(8, 8, 1));
  for (const std::string& isa : usable_isas()) CHECK(build_scene(description, {1, isa})->statistics().isa == isa);
  CHECK(build_scene(description, {1, {}})->statistics().isa == best_isa());
  CHECK(build_scene(description, {1, {}})->statistics().primitives == 1004);
  CHECK_THROWS_AS(build_scene(description, {1, "x86-64-v9"}), RenderError);
  CHECK(!isa_supported("x86-64-v9"));
}

}  // namespace raytrace::test
