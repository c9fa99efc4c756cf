#include "raytrace/xml/line_index.h"

#include <algorithm>
#include <cstdint>

namespace raytrace {

LineIndex::LineIndex(std::string_view text) {
  line_starts_.push_back(text.substr(0, byte_order_mark.size()) == byte_order_mark ? byte_order_mark.size() : 0);
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n', end + 1)) {
    line_starts_.push_back(end + 1);
  }
}

SourceLocation LineIndex::locate(std::size_t offset) const {
  auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  if (next == line_starts_.begin()) ++next;
  const std::size_t start = *(next - 1);
  return {static_cast<std::uint32_t>(next - line_starts_.begin()),
          static_cast<std::uint32_t>(offset > start ? offset - start + 1 : 1)};
}

}  // namespace raytrace
