// Regions as text, and which ones may be rendered.
#include "raytrace/film/region.h"

#include "support/catch.h"

namespace raytrace::test {

TEST_CASE("a region's text is read as that region, and no other text is") {
  for (const Region& region : {Region{0, 0, 1, 1}, Region{-640, -400, 1280, 800}, Region{7, -3, 2147483647, 5}})
    CHECK(region_of(text_of(region)) == region);
  for (const char* const text :
       {"", "1", "1,2,3", "1,2,3,", "1,2,3,4,", "1,2,3,4,5", "+1,2,3,4", " 1,2,3,4", "1,2,3,4 ", "01,2,3,4", "-0,0,1,1",
        "1;2;3;4", "1,,3,4", "0x1,2,3,4", "1.0,2,3,4", "1,2,3,2147483648", "a,b,c,d"})
    CHECK(!region_of(text));
}

TEST_CASE("multiples below a number, which may be negative") {
  CHECK(round_down(0, 8) == 0);
  CHECK(round_down(7, 8) == 0);
  CHECK(round_down(8, 8) == 8);
  CHECK(round_down(-1, 8) == -8);
  CHECK(round_down(-8, 8) == -8);
  CHECK(round_down(-9, 8) == -16);
  CHECK(round_down(-5, 1) == -5);
}

TEST_CASE("a crop may reach beyond the picture by the picture's size on each side") {
  CHECK(!crop_error({0, 0, 640, 400}, 640, 400));
  CHECK(!crop_error({-640, -400, 1280, 800}, 640, 400));
  CHECK(!crop_error({640, 0, 700, 10}, 640, 400));
  CHECK(crop_error({-641, 0, 1, 1}, 640, 400));
  CHECK(crop_error({0, -401, 1, 1}, 640, 400));
  CHECK(crop_error({0, 0, 1281, 1}, 640, 400));
  CHECK(crop_error({0, 0, 1, 801}, 640, 400));
  CHECK(crop_error({5, 0, 5, 1}, 640, 400));
  CHECK(crop_error({0, 1, 5, 1}, 640, 400));
  CHECK(crop_error({-2147483647 - 1, 0, 2147483647, 1}, 640, 400));
  CHECK(crop_error({0, 0, 2147483647, 2147483647}, 65536, 4096));
  CHECK(!crop_error({0, 0, 65536, 4096}, 65536, 4096));
  CHECK(crop_error({-1, 0, 65536, 1}, 65536, 4096));
  CHECK(crop_error({0, -1, 65536, 4096}, 65536, 4096));
}

}  // namespace raytrace::test
