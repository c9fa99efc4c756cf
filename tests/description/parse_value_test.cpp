#include "raytrace/description/parse_value.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <random>

#include "reported.h"
#include "support/catch.h"

namespace raytrace::test {
namespace {

double number(std::string_view text, Range range = Range::any) {
  double value = -77;
  const OptionalMessage message = parse_number(text, range, value);
  if (message) FAIL(text << " " << *message);
  return value;
}

std::string refusal(std::string_view text, Range range = Range::any) {
  double value = -77;
  const OptionalMessage message = parse_number(text, range, value);
  CHECK(value == -77);
  return message.value_or("");
}

std::string integer_refusal(std::string_view text, Range range = Range::any) {
  int value = -77;
  const OptionalMessage message = parse_integer(text, range, value);
  CHECK(value == -77);
  return message.value_or("");
}

}  // namespace

TEST_CASE("numbers are read whole, with white space and a plus sign around them") {
  CHECK(number("1") == 1);
  CHECK(number("-0.5") == -0.5);
  CHECK(number("+2.5") == 2.5);
  CHECK(number(" \t\r\n 3 \n") == 3);
  CHECK(number(".5") == 0.5);
  CHECK(number("5.") == 5);
  CHECK(number("1e-3") == 1e-3);
  CHECK(number("1E+3") == 1000);
  CHECK(number("0.1") == 0.1);
  CHECK(number("000012") == 12);
  CHECK(number("1e17") == largest_number);
  CHECK(number("-1e17") == -largest_number);
  CHECK(std::signbit(number("-0")));
}

TEST_CASE("what is not wholly a number is refused") {
  for (const char* text : {"",  " ", "x", "1 2",   "0x10",  "--1",   "+-1",      "-+1",  "++1", "1e",  "e1",
                           ".", "+", "-", "1_000", "1.2.3", "1e5.5", "\xd9\xa1", "1rad", "$1",  "true"}) {
    CHECK(refusal(text) == "is not a number; write one such as 1.5");
  }
  for (const char* text : {"1x", "1 m", "1f", "1\xc2\xb0", "1\xc2\xb5m"})
    CHECK(refusal(text) == "is not a number; write it without a unit: 1");
  CHECK(refusal("-40.5deg") == "is not a number; write it without a unit: -40.5");
  CHECK(refusal("80%") == "is not a number; write it as 0.8");
  CHECK(refusal("12.5 %") == "is not a number; write it as 0.125");
  CHECK(integer_refusal("400px") == "is not a whole number; write it without a unit: 400");
  CHECK(refusal("1,5") == "is not a number; write it with a point: 1.5");
  CHECK(refusal("1,000,000") == "is not a number; write one such as 1.5");
  for (const char* text : {"nan", "NaN", "-nan", "inf", "-inf", "Infinity", "+INF"}) {
    CHECK(refusal(text) == "is not a finite number; write one such as 1.5");
  }
}

TEST_CASE("numbers beyond the limits of scenes are refused") {
  for (const char* text : {"1.0000001e17", "-2e17", "1e308", "1e309", "-1e99999", "1e+999999999999999999999"}) {
    CHECK(refusal(text) == "is beyond the largest number that a scene may have, 1e+17");
  }
  CHECK(refusal(std::string(400, '9')) == "is beyond the largest number that a scene may have, 1e+17");
  for (const char* text : {"1e-400", "-1e-999999999999999999999"}) {
    CHECK(refusal(text) == "is too small to differ from 0; write 0");
  }
  CHECK(refusal("0." + std::string(400, '0') + "1") == "is too small to differ from 0; write 0");
}

TEST_CASE("numbers keep their ranges") {
  CHECK(number("0", Range::not_negative) == 0);
  CHECK(refusal("-1e-9", Range::not_negative) == "must not be negative");
  CHECK(number("1e-17", Range::positive) == smallest_size);
  CHECK(refusal("0", Range::positive) == "must be greater than 0");
  CHECK(refusal("-3", Range::positive) == "must be greater than 0");
  CHECK(refusal("9e-18", Range::positive) == "is too small; the smallest size is 1e-17");
}

TEST_CASE("every double has a text that gives it back") {
  std::mt19937_64 random(20110801);
  for (int i = 0; i < 20000; ++i) {
    const std::uint64_t bits = random();
    double value = 0;
    std::memcpy(&value, &bits, sizeof value);
    if (!(std::abs(value) <= largest_number)) continue;
    const double again = number(number_text(value));
    REQUIRE(std::memcmp(&again, &value, sizeof value) == 0);
  }
}

TEST_CASE("integers are read whole") {
  int value = 0;
  CHECK_FALSE(parse_integer("10", Range::any, value));
  CHECK(value == 10);
  CHECK_FALSE(parse_integer(" +7\n", Range::positive, value));
  CHECK(value == 7);
  CHECK_FALSE(parse_integer("2147483647", Range::positive, value));
  CHECK(value == 2147483647);
  CHECK_FALSE(parse_integer("-2147483648", Range::any, value));
  CHECK(value == -2147483647 - 1);
}

TEST_CASE("what is not wholly an integer is refused") {
  CHECK(integer_refusal("10.5") == "is not a whole number; write one without point and exponent, such as 16");
  CHECK(integer_refusal("1e3") == "must be written as a whole number: 1000");
  CHECK(integer_refusal("16.") == "must be written as a whole number: 16");
  CHECK(integer_refusal("-2.0") == "must be written as a whole number: -2");
  CHECK(integer_refusal("1e300") == "is not a whole number; write one without point and exponent, such as 16");
  for (const char* text : {"", "ten", "0x10", "1 0", "+-3", "nan", "inf"}) {
    CHECK(integer_refusal(text) == "is not a whole number; write one such as 16");
  }
  for (const char* text : {"2147483648", "99999999999999999999999", "-99999999999999999999999"}) {
    CHECK(integer_refusal(text) == "is outside of the whole numbers from -2147483648 to 2147483647");
  }
  CHECK(integer_refusal("-1", Range::not_negative) == "must not be negative");
  CHECK(integer_refusal("0", Range::positive) == "must be at least 1");
}

TEST_CASE("booleans have two spellings each") {
  bool value = false;
  CHECK_FALSE(parse_boolean(" true ", value));
  CHECK(value);
  CHECK_FALSE(parse_boolean("0", value));
  CHECK_FALSE(value);
  CHECK_FALSE(parse_boolean("1", value));
  CHECK(value);
  CHECK_FALSE(parse_boolean("false", value));
  CHECK_FALSE(value);
  for (const char* text : {"", "True", "yes", "10", "truefalse", "on"}) {
    CHECK(parse_boolean(text, value) == "is neither true nor false; write one of them");
    CHECK_FALSE(value);
  }
}

}  // namespace raytrace::test
