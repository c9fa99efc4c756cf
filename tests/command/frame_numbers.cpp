// The texts of --frames.
#include "raytrace/batch/frames.h"
#include "raytrace/batch/settings_error.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

using Frames = std::vector<int>;

std::string refusal(const std::string& text) {
  try {
    frame_numbers(text);
  } catch (const SettingsError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("frames are numbers, ranges and ranges with a step") {
  CHECK(frame_numbers("7") == Frames{7});
  CHECK(frame_numbers("-7") == Frames{-7});
  CHECK(frame_numbers("1-5") == Frames{1, 2, 3, 4, 5});
  CHECK(frame_numbers("5-5") == Frames{5});
  CHECK(frame_numbers("1-10:4") == Frames{1, 5, 9});
  CHECK(frame_numbers("1-10:2,15") == Frames{1, 3, 5, 7, 9, 15});
  CHECK(frame_numbers("1-2:100") == Frames{1});
  CHECK(frame_numbers("-3--1") == Frames{-3, -2, -1});
  CHECK(frame_numbers("-1-1") == Frames{-1, 0, 1});
  CHECK(frame_numbers("\t1 - 3 : 2 , - 5 ") == Frames{-5, 1, 3});
  CHECK(frame_numbers("2147483646-2147483647") == Frames{2147483646, 2147483647});
  CHECK(frame_numbers("-2147483647-2147483647:2147483647") == Frames{-2147483647, 0, 2147483647});
  CHECK(frame_numbers("007") == Frames{7});
}

TEST_CASE("frames are in increasing order, however they are given") {
  CHECK(frame_numbers("10-15:2,1-5") == Frames{1, 2, 3, 4, 5, 10, 12, 14});
  CHECK(frame_numbers("5-1:-1") == Frames{1, 2, 3, 4, 5});
  CHECK(frame_numbers("10-1:-4") == Frames{2, 6, 10});
  CHECK(frame_numbers("10-2:-4,1") == Frames{1, 2, 6, 10});
  CHECK(frame_numbers("1--1:-2") == Frames{-1, 1});
}

TEST_CASE("the short text of frames") {
  for (const char* const text : {"7", "1-5", "-3--1", "1-2", "1-9:4", "1-9:2,20", "1-3,7-10,20", "5,9", "1-3,9,20-22",
                                 "-2147483647-2147483647:2147483647"}) {
    INFO(text);
    CHECK(frames_text(frame_numbers(text)) == text);
  }
  CHECK(frames_text({}) == "");
  CHECK(frames_text({1, 2, 4, 5, 6}) == "1-2,4-6");
}

TEST_CASE("frames that overlap are refused") {
  CHECK(refusal("1-10:4,10-15") == "'1-10:4' and '10-15' overlap; each frame is rendered once");
  CHECK(refusal("3,3") == "'3' and '3' overlap; each frame is rendered once");
  CHECK(refusal("1-9:2,4") == "'1-9:2' and '4' overlap; each frame is rendered once");
  CHECK(refusal("5-1:-2, 4-9") == "'5-1:-2' and '4-9' overlap; each frame is rendered once");
}

TEST_CASE("what is no list of frames is refused with what would be one") {
  for (const char* const text :
       {"",    " ",   "a",  "1-",  "-",     "1,",    ",1",  "1,,2", "1..5",  "1-5:",  "1-5:2:2",
        "1:2", "1.5", "+1", "--1", "1---1", "1-5-9", "1 2", "0x10", "1-5x2", "1-5:+2"}) {
    INFO(text);
    CHECK(refusal(text).find("is no list of frames; use") != std::string::npos);
  }
  CHECK(refusal("10-1") == "'10-1' goes down; write 1-10");
  CHECK(refusal("10-1:3") == "'10-1:3' goes down; write 1-10:3");
  CHECK(refusal("1--1") == "'1--1' goes down; write -1-1");
  CHECK(refusal("1-10:-3") == "'1-10:-3' goes up, its step down; write 1-10:3");
  CHECK(refusal("1-10:0") == "'1-10:0' has the step 0; leave it out for all frames");
  CHECK(refusal("2147483648") == "'2147483648' has a number beyond 2147483647");
  CHECK(refusal("1-2000000000").find("more than 100000 frames") != std::string::npos);
  CHECK(refusal("1-60000,100001-160000").find("more than 100000 frames") != std::string::npos);
  CHECK(frame_numbers("1-100000").size() == 100000);
}

}  // namespace raytrace::test
