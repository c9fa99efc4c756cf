#include "raytrace/xml/scene_text.h"

#include <algorithm>
#include <utility>

#include "raytrace/parallel/for_each_index.h"
#include "raytrace/xml/file_type.h"
#include "raytrace/xml/xml_characters.h"
#include "raytrace/xml/xml_scanner.h"

namespace raytrace {

SceneText::SceneText(TextBuffer text, std::span<const std::string_view> groups, int threads, Diagnostics& diagnostics)
    : text_(std::move(text)) {
  if (const auto error = find_xml_error(text_.text(), groups, chunks_, threads)) {
    if (const auto type = explain_file_type(text_.text()))
      diagnostics.error({1, 1}, *type);
    else
      diagnostics.error(raytrace::locate(text_.text(), error->offset), error->message);
    chunks_.clear();
    return;
  }
  measure(threads);
}

void SceneText::measure(int threads) {
  const auto line_ends = [&](std::size_t begin, std::size_t end) {
    return xml::line_ends(text_.text().substr(begin, end - begin));
  };
  for_each_index(static_cast<int>(chunks_.size()), threads, [&](int i) {
    TextChunk& chunk = chunks_[static_cast<std::size_t>(i)];
    chunk.line = line_ends(chunk.begin, chunk.end);
  });
  // From how many lines each has to its first.
  Span rest{0, 0, 1};  // what of the skeleton stands before the chunk at hand
  for (TextChunk& chunk : chunks_) {
    std::uint32_t line = rest.line;
    if (rest.begin != chunk.begin) {
      line += line_ends(rest.begin, chunk.begin);
      skeleton_.push_back({rest.begin, chunk.begin, rest.line});
    }
    rest = {chunk.end, chunk.end, line + chunk.line};
    chunk.line = line;
  }
  skeleton_.push_back({rest.begin, text_.text().size(), rest.line});
}

SceneText::ChunkRange SceneText::chunks_of(std::size_t group) const {
  const auto [first, last] = std::equal_range(chunks_.begin(), chunks_.end(), TextChunk{group, 0, 0},
                                              [](const TextChunk& a, const TextChunk& b) { return a.group < b.group; });
  std::size_t items = 0;
  for (auto chunk = first; chunk != last; ++chunk) items += chunk->items;
  return {static_cast<std::size_t>(first - chunks_.begin()), static_cast<std::size_t>(last - first), items};
}

SourceLocation SceneText::locate(std::size_t offset) const {
  const auto next = std::upper_bound(chunks_.begin(), chunks_.end(), offset,
                                     [](std::size_t wanted, const TextChunk& chunk) { return wanted < chunk.begin; });
  if (next == chunks_.begin()) return raytrace::locate(text_.text(), offset);
  return raytrace::locate(text_.text(), offset, (next - 1)->begin, (next - 1)->line);
}

}  // namespace raytrace
