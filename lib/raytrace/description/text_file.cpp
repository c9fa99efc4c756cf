#include "raytrace/description/text_file.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "raytrace/memory/large_pages.h"

namespace raytrace {
namespace {

constexpr std::size_t largest_file = std::size_t(1) << 31;

struct Close {
  void operator()(std::FILE* file) const {
    if (file != stdin) std::fclose(file);
  }
};

}  // namespace

std::optional<std::string> read_text_file(const std::string& file, Diagnostics& diagnostics) {
  const auto refuse = [&](const std::string& reason) {
    diagnostics.error({}, "cannot read the scene: " + reason);
    return std::nullopt;
  };
  const auto reason = [](int error) { return std::generic_category().message(error); };

  const std::unique_ptr<std::FILE, Close> input(file == "-" ? stdin : std::fopen(file.c_str(), "rb"));
  if (!input) return refuse(reason(errno));

  // A pipe or a device has no size beforehand, and a file may grow: the string is doubled while there is more.
  std::error_code unknown_size;
  const std::uintmax_t size = std::filesystem::file_size(file, unknown_size);
  std::string text;
  const std::size_t expected =
      unknown_size ? std::size_t(1) << 16 : static_cast<std::size_t>(std::min<std::uintmax_t>(size, largest_file)) + 1;
  reserve_large(text, expected);
  text.resize(expected);
  std::size_t length = 0;
  while (true) {
    errno = 0;
    length += std::fread(text.data() + length, 1, text.size() - length, input.get());
    if (std::ferror(input.get())) return refuse(reason(errno));
    if (length > largest_file) return refuse("it is larger than 2 GiB");
    if (length < text.size()) break;
    text.resize(2 * length);
  }
  text.resize(length);
  return text;
}

}  // namespace raytrace
