#include "raytrace/description/scene_text.h"

#include <algorithm>
#include <utility>

#include "raytrace/description/scene_layout.h"

namespace raytrace {

SceneText::SceneText(TextBuffer text, Diagnostics& diagnostics) : text_(std::move(text)) {
  if (const auto problem = find_xml_problem(text_.text(), group_elements(), pieces_)) {
    diagnostics.error(locate(problem->offset), problem->message);
    pieces_.clear();
    return;
  }
  measure();
}

void SceneText::measure() {
  Span rest{0, 0, 1};  // what of the frame stands before the piece at hand
  const std::string_view text = text_.text();
  std::uint32_t line = 1;
  const auto count_lines = [&](std::size_t begin, std::size_t end) {
    line += static_cast<std::uint32_t>(std::count(text.data() + begin, text.data() + end, '\n'));
  };
  piece_lines_.reserve(pieces_.size());
  for (const Piece& piece : pieces_) {
    if (rest.begin != piece.begin) {
      count_lines(rest.begin, piece.begin);
      frame_.push_back({rest.begin, piece.begin, rest.line});
    }
    piece_lines_.push_back(line);
    count_lines(piece.begin, piece.end);
    rest = {piece.end, piece.end, line};
  }
  frame_.push_back({rest.begin, text.size(), rest.line});
}

SceneText::PieceRange SceneText::pieces_of(std::size_t group) const {
  const auto [first, last] = std::equal_range(pieces_.begin(), pieces_.end(), Piece{group, 0, 0},
                                              [](const Piece& a, const Piece& b) { return a.group < b.group; });
  std::size_t items = 0;
  for (auto piece = first; piece != last; ++piece) items += piece->items;
  return {static_cast<std::size_t>(first - pieces_.begin()), static_cast<std::size_t>(last - first), items};
}

SourceLocation SceneText::locate(std::size_t offset) const {
  if (!lines_) lines_.emplace(text_.text());
  return lines_->locate(offset);
}

}  // namespace raytrace
