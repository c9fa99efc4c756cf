// A scene's text in memory, a whole file's or standard input's, and the parts of it that are parsed by themselves.
//
// Most of a large scene are the items of a few groups. They are cut into chunks, each parsed, read and forgotten by
// itself: several threads share the work, and the tree of the whole, eight times as large as the text, is never built.
// What is left when the chunks are taken out, the skeleton, is parsed as one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "raytrace/memory/large_array.h"
#include "raytrace/xml/diagnostics.h"
#include "raytrace/xml/item_chunks.h"

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

/// A part of the text; `line` is that of its first character, which starts at `line_start`.
struct Span {
  std::size_t begin, end;
  std::uint32_t line;
  std::size_t line_start;

  LineMark mark() const { return {begin, line, line_start}; }
};

class SceneText {
 public:
  /// Checks the text. If it is not well-formed XML, the reason goes to `diagnostics`, and there are no parts.
  /// threads: how many may share the work on a large one; 0: all processors. first_line: the number of its first line.
  SceneText(TextBuffer text, std::span<const std::string_view> groups, int threads, Diagnostics& diagnostics,
            std::uint32_t first_line = 1);

  bool well_formed() const { return !skeleton_.empty(); }

  /// The text of a part.
  std::string_view of(const Span& span) const { return text_.text().substr(span.begin, span.end - span.begin); }

  /// In the order of the text.
  std::span<const Span> skeleton() const { return skeleton_; }
  std::size_t chunk_count() const { return chunks_.size(); }
  Span chunk(std::size_t index) const { return chunk_spans_[index]; }

  struct ChunkRange {
    std::size_t first, count;
    std::size_t items;  ///< how many elements they hold
  };
  /// The chunks of the group whose start tag begins at an offset.
  ChunkRange chunks_of(std::size_t group) const;

  /// near: of another byte, which becomes that of this one. Lines are counted from there, or from where the part
  /// starts: to locate bytes in their order takes a single pass through the text, however long its lines are.
  SourceLocation locate(std::size_t offset, LineMark& near) const;
  std::uint32_t last_line() const { return last_line_; }

 private:
  void measure(int threads);

  TextBuffer text_;
  std::uint32_t first_line_, last_line_;
  std::vector<TextChunk> chunks_;
  std::vector<Span> chunk_spans_;  ///< of the chunks
  std::vector<Span> skeleton_;
};

/// The message for a text that is no XML: "this seems to be a PLY model; ..."; none if nobody knows. It goes by the
/// first bytes of what people have beside their scenes: models, pictures, packed files, and scenes of other renderers.
std::optional<std::string> explain_file_type(std::string_view text);

}  // namespace raytrace
