#include "raytrace/xml/text_file.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>

#include "raytrace/parallel/for_each_index.h"

namespace raytrace {
namespace {

constexpr std::size_t largest_file = std::size_t(1) << 31;

struct Close {
  void operator()(std::FILE* file) const {
    if (file != stdin) std::fclose(file);
  }
};

/// The bytes of the file from an offset on, as many as there are up to `count`.
std::size_t read_at(int file, char* bytes, std::size_t count, std::size_t offset) {
  std::size_t done = 0;
  while (done < count) {
    const ssize_t more = pread(file, bytes + done, count - done, static_cast<off_t>(offset + done));
    if (more < 0 && errno == EINTR) continue;
    if (more <= 0) break;
    done += static_cast<std::size_t>(more);
  }
  return done;
}

/// A file of known size, by several threads: memory that is fresh from the system takes longer to get than the bytes to
/// copy. No value if the file does not have that size, or cannot be read from an offset on.
std::optional<TextBuffer> read_in_parallel(int file, std::size_t size, int threads) {
  constexpr std::size_t block = std::size_t(1) << 21;
  TextBuffer text(size);
  std::atomic<bool> complete{true};
  for_each_index(static_cast<int>((size + block - 1) / block), threads, [&](int index) {
    const std::size_t offset = static_cast<std::size_t>(index) * block, count = std::min(block, size - offset);
    if (read_at(file, text.data() + offset, count, offset) != count) complete = false;
  });
  char next = 0;
  if (!complete || read_at(file, &next, 1, size) != 0) return std::nullopt;
  text.lengthen_to(size);
  return text;
}

}  // namespace

std::optional<TextBuffer> read_text_file(const std::string& file, int threads, Diagnostics& diagnostics) {
  const auto refuse = [&](const std::string& reason) {
    diagnostics.error({}, "cannot read the scene: " + reason);
    return std::nullopt;
  };
  const auto reason = [](int error) { return std::generic_category().message(error); };

  const std::unique_ptr<std::FILE, Close> input(file == "-" ? stdin : std::fopen(file.c_str(), "rb"));
  if (!input) return refuse(reason(errno));

  std::error_code unknown_size;
  const std::uintmax_t size = std::filesystem::file_size(file, unknown_size);
  constexpr std::size_t large_file = std::size_t(1) << 22;
  if (!unknown_size && size >= large_file && size <= largest_file) {
    if (std::optional<TextBuffer> text = read_in_parallel(fileno(input.get()), static_cast<std::size_t>(size), threads))
      return text;
  }

  // A pipe or a device has no size beforehand, and a file may grow: the room is doubled while there is more.
  TextBuffer text(unknown_size ? std::size_t(1) << 16
                               : static_cast<std::size_t>(std::min<std::uintmax_t>(size, largest_file)) + 1);
  std::size_t length = 0;
  while (true) {
    errno = 0;
    length += std::fread(text.data() + length, 1, text.room() - length, input.get());
    if (std::ferror(input.get())) return refuse(reason(errno));
    if (length > largest_file) return refuse("it is larger than 2 GiB");
    text.lengthen_to(length);
    if (length < text.room()) return text;
    TextBuffer larger(2 * length);
    larger.append(text.text());
    text = std::move(larger);
  }
}

}  // namespace raytrace
