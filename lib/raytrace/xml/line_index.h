// Turns places in a text into lines and columns.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "raytrace/xml/diagnostics.h"

namespace raytrace {

/// What some editors put at the start of a UTF-8 file. None of them shows it, so columns do not count it.
inline constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

class LineIndex {
 public:
  explicit LineIndex(std::string_view text);
  SourceLocation locate(std::size_t offset) const;

 private:
  std::vector<std::size_t> line_starts_;
};

}  // namespace raytrace
