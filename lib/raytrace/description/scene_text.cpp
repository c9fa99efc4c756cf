#include "raytrace/description/scene_text.h"

#include <algorithm>
#include <utility>

#include "raytrace/description/file_kind.h"
#include "raytrace/description/scene_layout.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace {

SceneText::SceneText(TextBuffer text, int threads, Diagnostics& diagnostics) : text_(std::move(text)) {
  if (const auto problem = find_xml_problem(text_.text(), group_elements(), pieces_, threads)) {
    if (const auto kind = explain_file_kind(text_.text()))
      diagnostics.error({1, 1}, *kind);
    else
      diagnostics.error(locate(problem->offset), problem->message);
    pieces_.clear();
    return;
  }
  measure(threads);
}

void SceneText::measure(int threads) {
  const std::string_view text = text_.text();
  const auto line_ends = [&](std::size_t begin, std::size_t end) {
    const std::string_view part = text.substr(begin, end - begin);
    std::uint32_t count = 0;
    for (std::size_t at = part.find('\n'); at != std::string_view::npos; at = part.find('\n', at + 1)) ++count;
    return count;
  };
  piece_lines_.resize(pieces_.size());
  for_each_index(static_cast<int>(pieces_.size()), threads, [&](int i) {
    const auto piece = static_cast<std::size_t>(i);
    piece_lines_[piece] = line_ends(pieces_[piece].begin, pieces_[piece].end);
  });
  // From how many lines each has to its first.
  Span rest{0, 0, 1};  // what of the frame stands before the piece at hand
  std::uint32_t line = 1;
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Piece& piece = pieces_[i];
    if (rest.begin != piece.begin) {
      line += line_ends(rest.begin, piece.begin);
      frame_.push_back({rest.begin, piece.begin, rest.line});
    }
    const std::uint32_t lines = piece_lines_[i];
    piece_lines_[i] = line;
    line += lines;
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
