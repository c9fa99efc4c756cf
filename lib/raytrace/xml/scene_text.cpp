#include "raytrace/xml/scene_text.h"

#include <algorithm>
#include <utility>

#include "raytrace/parallel/for_each_index.h"
#include "raytrace/xml/file_kind.h"

namespace raytrace {

SceneText::SceneText(TextBuffer text, std::span<const std::string_view> groups, int threads, Diagnostics& diagnostics)
    : text_(std::move(text)) {
  if (const auto diagnostic = find_xml_error(text_.text(), groups, chunks_, threads)) {
    if (const auto kind = explain_file_kind(text_.text()))
      diagnostics.error({1, 1}, *kind);
    else
      diagnostics.error(locate(diagnostic->offset), diagnostic->message);
    chunks_.clear();
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
  chunk_lines_.resize(chunks_.size());
  for_each_index(static_cast<int>(chunks_.size()), threads, [&](int i) {
    const auto chunk = static_cast<std::size_t>(i);
    chunk_lines_[chunk] = line_ends(chunks_[chunk].begin, chunks_[chunk].end);
  });
  // From how many lines each has to its first.
  Span rest{0, 0, 1};  // what of the skeleton stands before the chunk at hand
  std::uint32_t line = 1;
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    const TextChunk& chunk = chunks_[i];
    if (rest.begin != chunk.begin) {
      line += line_ends(rest.begin, chunk.begin);
      skeleton_.push_back({rest.begin, chunk.begin, rest.line});
    }
    const std::uint32_t lines = chunk_lines_[i];
    chunk_lines_[i] = line;
    line += lines;
    rest = {chunk.end, chunk.end, line};
  }
  skeleton_.push_back({rest.begin, text.size(), rest.line});
}

SceneText::ChunkRange SceneText::chunks_of(std::size_t group) const {
  const auto [first, last] = std::equal_range(chunks_.begin(), chunks_.end(), TextChunk{group, 0, 0},
                                              [](const TextChunk& a, const TextChunk& b) { return a.group < b.group; });
  std::size_t items = 0;
  for (auto chunk = first; chunk != last; ++chunk) items += chunk->items;
  return {static_cast<std::size_t>(first - chunks_.begin()), static_cast<std::size_t>(last - first), items};
}

SourceLocation SceneText::locate(std::size_t offset) const {
  if (!lines_) lines_.emplace(text_.text());
  return lines_->locate(offset);
}

}  // namespace raytrace
