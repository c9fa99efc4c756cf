// A scene's text as a whole, and the parts of it that are parsed by themselves.
//
// Most of a large scene are the items of a few groups. They are cut into pieces, each parsed, read and forgotten by
// itself: several threads share the work, and the tree of the whole, eight times as large as the text, is never built.
// What is left when the pieces are taken out, the frame, is parsed as one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "raytrace/description/diagnostics.h"
#include "raytrace/description/line_index.h"
#include "raytrace/description/text_buffer.h"
#include "raytrace/description/xml_scanner.h"

namespace raytrace {

/// A part of the text; `line` is that of its first character.
struct Span {
  std::size_t begin, end;
  std::uint32_t line;
};

class SceneText {
 public:
  /// Checks the text. If it is not well-formed XML, the reason goes to `diagnostics`, and there are no parts.
  /// threads: how many may share the work on a large one; 0: all processors.
  SceneText(TextBuffer text, int threads, Diagnostics& diagnostics);

  bool well_formed() const { return !frame_.empty(); }

  /// The text of a part.
  std::string_view of(const Span& span) const { return text_.text().substr(span.begin, span.end - span.begin); }

  /// In the order of the text.
  std::span<const Span> frame() const { return frame_; }
  Span piece(std::size_t index) const { return {pieces_[index].begin, pieces_[index].end, piece_lines_[index]}; }

  struct PieceRange {
    std::size_t first, count;
    std::size_t items;  ///< how many elements they hold
  };
  /// The pieces of the group whose start tag begins at an offset.
  PieceRange pieces_of(std::size_t group) const;

  /// For messages; not to be called by two threads at once.
  SourceLocation locate(std::size_t offset) const;

 private:
  void measure(int threads);

  TextBuffer text_;
  std::vector<Piece> pieces_;
  std::vector<std::uint32_t> piece_lines_;
  std::vector<Span> frame_;
  mutable std::optional<LineIndex> lines_;  // made for the first message
};

}  // namespace raytrace
