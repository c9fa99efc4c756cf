#include "raytrace/output/picture_date.h"

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <optional>

namespace raytrace {

namespace {

std::optional<std::time_t> source_date_epoch() {
  const char* const text = std::getenv("SOURCE_DATE_EPOCH");
  if (text == nullptr) return std::nullopt;
  const char* const end = text + std::strlen(text);
  constexpr std::time_t year_10000 = 253402300800;  // dates have four digits for the year
  std::time_t seconds = 0;
  const auto [stop, error] = std::from_chars(text, end, seconds);
  if (error != std::errc() || stop != end || seconds < 0 || seconds >= year_10000) {
    throw OutputError("the environment's SOURCE_DATE_EPOCH is '" + std::string(text) +
                      "': it must be a number of seconds since 1970");
  }
  return seconds;
}

}  // namespace

PictureDate picture_date() {
  const std::optional<std::time_t> fixed = source_date_epoch();
  const std::time_t time = fixed.value_or(std::time(nullptr));
  std::tm utc{};
  gmtime_r(&time, &utc);
  char text[sizeof "2026:01:31 23:59:59"];
  std::strftime(text, sizeof text, "%Y:%m:%d %H:%M:%S", &utc);
  return {text, utc, fixed.has_value()};
}

}  // namespace raytrace
