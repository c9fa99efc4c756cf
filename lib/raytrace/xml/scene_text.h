// A scene's text as a whole, and the parts of it that are parsed by themselves.
//
// Most of a large scene are the items of a few groups. They are cut into chunks, each parsed, read and forgotten by
// itself: several threads share the work, and the tree of the whole, eight times as large as the text, is never built.
// What is left when the chunks are taken out, the skeleton, is parsed as one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "raytrace/xml/diagnostics.h"
#include "raytrace/xml/item_chunks.h"
#include "raytrace/xml/text_file.h"

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
  SceneText(TextBuffer text, std::span<const std::string_view> groups, int threads, Diagnostics& diagnostics);

  bool well_formed() const { return !skeleton_.empty(); }

  /// The text of a part.
  std::string_view of(const Span& span) const { return text_.text().substr(span.begin, span.end - span.begin); }

  /// In the order of the text.
  std::span<const Span> skeleton() const { return skeleton_; }
  Span chunk(std::size_t index) const { return {chunks_[index].begin, chunks_[index].end, chunks_[index].line}; }

  struct ChunkRange {
    std::size_t first, count;
    std::size_t items;  ///< how many elements they hold
  };
  /// The chunks of the group whose start tag begins at an offset.
  ChunkRange chunks_of(std::size_t group) const;

  /// For messages: it counts lines.
  SourceLocation locate(std::size_t offset) const;

 private:
  void measure(int threads);

  TextBuffer text_;
  std::vector<TextChunk> chunks_;
  std::vector<Span> skeleton_;
};

}  // namespace raytrace
