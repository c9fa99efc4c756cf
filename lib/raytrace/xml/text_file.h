// The text of a scene in memory: a whole file's, or standard input's.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "raytrace/memory/large_array.h"
#include "raytrace/xml/diagnostics.h"

namespace raytrace {

/// Bytes with a '\0' behind them. Their memory is taken where it is first written to, by the thread that writes.
class TextBuffer {
 public:
  /// Empty, with room for so many bytes. Throws std::bad_alloc.
  explicit TextBuffer(std::size_t room) : bytes_(LargeArray<char>::unset(room + 1)), room_(room) { lengthen_to(0); }
  explicit TextBuffer(std::string_view text) : TextBuffer(text.size()) { append(text); }

  std::string_view text() const { return {bytes_.data(), size_}; }

  /// As much as there is room for. What is written here belongs to the text once it is as long as that.
  char* data() { return bytes_.data(); }
  std::size_t room() const { return room_; }
  void lengthen_to(std::size_t size) {
    size_ = size;
    bytes_[size] = '\0';
  }

  void append(std::string_view more) {
    std::copy(more.begin(), more.end(), data() + size_);
    lengthen_to(size_ + more.size());
  }

 private:
  LargeArray<char> bytes_;
  std::size_t room_, size_ = 0;
};

/// The bytes of the file ("-": standard input). No value, and an error without a line, if it is missing, a directory,
/// unreadable, or larger than 2 GiB (as /dev/zero is). threads: so many at most read a large one; 0: all that the
/// machine has.
std::optional<TextBuffer> read_text_file(const std::string& file, int threads, Diagnostics& diagnostics);

}  // namespace raytrace
