// Where the film keeps its pixels.
#include "raytrace/film/film.h"

#include "support/catch.h"

namespace raytrace::test {

TEST_CASE("a film holds the pixels of its region, row by row, under their places in the whole picture") {
  Film film(640, 480, {100, 50, 107, 53});
  CHECK(film.full_width() == 640);
  CHECK(film.full_height() == 480);
  CHECK(film.region() == Region{100, 50, 107, 53});
  REQUIRE(film.pixels().size() == 21);
  for (const Pixel& pixel : film.pixels()) {
    CHECK(pixel.red == 0.0f);
    CHECK(pixel.alpha == 0.0f);
  }

  for (int y = 50; y < 53; ++y)
    for (int x = 100; x < 107; ++x) film.at(x, y) = {static_cast<float>(x), static_cast<float>(y), 0, 1};
  for (std::size_t i = 0; i < 21; ++i) {
    CHECK(film.pixels()[i].red == static_cast<float>(100 + i % 7));
    CHECK(film.pixels()[i].green == static_cast<float>(50 + i / 7));
  }
}

}  // namespace raytrace::test
