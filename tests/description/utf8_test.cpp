#include "raytrace/text/utf8.h"

#include <cstddef>
#include <string>
#include <string_view>

#include "support/catch.h"

namespace raytrace::test {
namespace {

std::size_t find_invalid_one_by_one(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text.substr(i));
    if (length == 0) return i;
    i += length;
  }
  return std::string_view::npos;
}

void check_same(const std::string& text) {
  const std::size_t wanted = find_invalid_one_by_one(text);
  for (const int threads : {1, 3}) {
    CAPTURE(text.size(), threads);
    CHECK(find_invalid_utf8(text, threads) == wanted);
  }
}

// Large texts are looked through in chunks of a power of two.
constexpr std::size_t seam = std::size_t{1} << 20U;

TEST_CASE("characters across the seams of a large text's chunks are whole", "[description]") {
  for (const std::string_view character : {"\xc3\xa9", "\xe2\x82\xac", "\xf0\x9f\x8e\xa8"}) {
    for (std::size_t shift = 0; shift < character.size(); ++shift) {
      std::string text(shift, 'a');
      while (text.size() < 2 * seam + 100) text += character;
      check_same(text);
      CHECK(find_invalid_utf8(text, 3) == std::string_view::npos);
    }
  }
}

TEST_CASE("the first invalid byte of a large text is found at any seam", "[description]") {
  const std::string plain(2 * seam + 100, 'a');
  check_same(plain);
  for (const std::string_view wrong :
       {"\x80", "\xc3", "\xe2\x82", "\xf0\x9f\x8e", "\xed\xa0\x80", "\x80\x80\x80\x80\x80", "\x01"}) {
    for (std::size_t at = seam - 6; at <= seam + 2; ++at) {
      std::string text = plain;
      text.replace(at, wrong.size(), wrong);
      text.back() = '\xff';  // which is not the first
      check_same(text);
      CHECK(find_invalid_utf8(text, 3) == at);
    }
  }
}

TEST_CASE("a text that ends within a character is invalid where that starts", "[description]") {
  for (const std::size_t size : {std::size_t{0}, std::size_t{5}, seam - 2, seam - 1, seam, 2 * seam}) {
    const std::string text = std::string(size, 'a') + "\xe2\x82";
    check_same(text);
    CHECK(find_invalid_utf8(text, 3) == size);
  }
}

}  // namespace
}  // namespace raytrace::test
