#include "raytrace/description/read_items.h"

#include <algorithm>
#include <deque>

#include "raytrace/parallel/in_order.h"
#include "raytrace/xml/xml_scanner.h"

namespace raytrace {

namespace {

/// What one thread reads chunks with.
class ChunkReader {
 public:
  ChunkReader(const ItemGroup& group, std::unique_ptr<ItemList> items)
      : group_(group), document_(group.text), items_(std::move(items)) {}

  ItemList& items() { return *items_; }

  void read(std::size_t chunk, Diagnostics& diagnostics) {
    items_->clear();
    number_ = 0;
    const Span span = group_.text.chunk(chunk);
    here_ = span.mark();
    end_ = span.end;
    while (true) {
      const std::uint32_t number_before = number_;
      if (pattern_) read_alike();
      if (here_.offset == end_) return;
      // Alone, an item takes longer to parse than among others. So that must be rare, or lead to the next pattern.
      constexpr std::uint32_t many = 8;
      const std::uint32_t alike = number_ - number_before;
      const bool wants_pattern = alike == 0 && patterns_left_ > 0;
      const std::size_t length = wants_pattern || alike >= many ? first_length() : 0;
      const Span parsed{here_.offset, length > 0 ? here_.offset + length : end_, here_.line, here_.line_start};
      const std::size_t reports_before = diagnostics.error_count() + diagnostics.warning_count();
      read_parsed(parsed, diagnostics);
      if (length == 0) return;
      const std::string_view text = group_.text.of(parsed);
      if (wants_pattern) {
        --patterns_left_;
        if (diagnostics.error_count() + diagnostics.warning_count() == reports_before)
          pattern_ = items_->pattern_of(text, document_.root().first_child().element());
      }
      here_.pass(text);
      skip_space();
    }
  }

 private:
  /// As many as have the pattern, off the beginning of what is left.
  void read_alike() {
    while (here_.offset < end_) {
      const std::string_view text = rest();
      const std::size_t length = items_->read_alike(*pattern_, text, here_.location(), number_);
      if (length == 0) return;
      ++number_;
      if (pattern_->line_ends() > 0) here_.line_start = here_.offset + text.rfind('\n', length - 1) + 1;
      here_.line += pattern_->line_ends();
      here_.offset += length;
      skip_space();
    }
  }

  void read_parsed(const Span& span, Diagnostics& diagnostics) {
    document_.parse_items(span, diagnostics);
    const Element root = document_.root();
    if (!root) return;
    for (Node node = root.first_child(); node; node = node.next()) {
      if (refuse_text(node, group_.element, diagnostics)) continue;
      const Element child = node.element();
      if (child.name() == group_.item_name)
        items_->read(child, number_, {group_.variables, diagnostics, group_.folder});
      else
        diagnostics.error(child, [&] { return explain_misplaced(child.name(), group_.element.name()); });
      ++number_;
    }
  }

  /// Of the item that comes next; 0 if there is something else.
  std::size_t first_length() const {
    const std::string_view text = rest();
    return text.size() > 1 && text[0] == '<' && xml::is(text[1], xml::name_start) ? element_length(text) : 0;
  }

  void skip_space() {
    const std::string_view text = rest();
    std::size_t size = 0;
    while (size < text.size() && xml::is(text[size], xml::space)) ++size;
    here_.pass(text.substr(0, size));
  }

  /// What of the chunk has not been read.
  std::string_view rest() const { return group_.text.of({here_.offset, end_, here_.line, here_.line_start}); }

  const ItemGroup& group_;
  Document document_;
  std::unique_ptr<ItemList> items_;
  std::optional<ItemPattern> pattern_;  // that items had lately
  int patterns_left_ = 8;               // so many may be tried: items may all differ
  std::uint32_t number_ = 0;            // of the next item
  LineMark here_;                       // in the chunk
  std::size_t end_ = 0;                 // of the chunk
};

}  // namespace

void read_items(const ItemGroup& group, tbb::task_arena& arena, Diagnostics& diagnostics,
                const std::function<std::unique_ptr<ItemList>()>& make,
                const std::function<void(std::size_t chunk, ItemList& items)>& take) {
  struct Worker {
    Worker(const ItemGroup& group, std::unique_ptr<ItemList> items) : reader(group, std::move(items)) {}

    ChunkReader reader;
    Diagnostics diagnostics = Diagnostics::counter();
  };
  const SceneText::ChunkRange chunks = group.text.chunks_of(group.element.offset());
  // Chunks are read without a message at first. Where there is something to say, the chunk is read once more when all
  // before it have been taken: so no more messages are composed than are kept, and they do not depend on the threads.
  const auto read_quietly = [&](std::size_t i, Worker& worker) {
    worker.diagnostics = Diagnostics::counter();
    worker.reader.read(chunks.first + i, worker.diagnostics);
  };
  const auto report_and_take = [&](std::size_t i, Worker& worker) {
    const Diagnostics& of_chunk = worker.diagnostics;
    const bool more_errors = of_chunk.error_count() > 0 && diagnostics.keeps_another(Severity::error);
    const bool more_warnings = of_chunk.warning_count() > 0 && diagnostics.keeps_another(Severity::warning);
    if (more_errors || more_warnings)
      worker.reader.read(chunks.first + i, diagnostics);
    else
      diagnostics.count(of_chunk);
    take(chunks.first + i, worker.reader.items());
  };

  // Enough that no thread waits for one that has a longer chunk.
  const std::size_t enough = 4 * static_cast<std::size_t>(arena.max_concurrency());
  std::deque<Worker> workers;  // no vector, since they cannot be moved
  for (std::size_t i = 0; i < std::min(chunks.count, enough); ++i) workers.emplace_back(group, make());
  in_order(chunks.count, workers, arena, read_quietly, report_and_take);
}

std::string NamedItems::explain_unknown(std::string_view name, Element user) const {
  const std::string_view nearest = nearest_name(name, names.names());
  return "unknown " + std::string(item) + " " + in_quotes(name) + " in " + tag(user.name()) + "; " +
         (nearest.empty() ? "add one of that name to " + tag(section) : "did you mean " + in_quotes(nearest) + "?");
}

}  // namespace raytrace
