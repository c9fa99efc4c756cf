// Reads the items of a group from the pieces that it was cut into.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "raytrace/description/diagnostics.h"
#include "raytrace/description/document.h"
#include "raytrace/description/fields.h"
#include "raytrace/description/item_pattern.h"
#include "raytrace/description/read_fields.h"
#include "raytrace/description/refuse_content.h"
#include "raytrace/description/report.h"
#include "raytrace/description/scene_layout.h"
#include "raytrace/description/scene_text.h"
#include "raytrace/description/variables.h"
#include "raytrace/description/xml_characters.h"
#include "raytrace/description/xml_scanner.h"

namespace raytrace {

/// An element with its parameters read.
template <class T>
struct Item {
  Element element;  ///< false if it was never parsed, there being nothing to say about it
  std::uint32_t line = 0;
  typename T::Parameters parameters;
  std::array<std::string_view, 2> labels;  ///< the section's labels; empty where absent
  bool usable = false;                     ///< free of errors, and not to be left out
};

/// What remains of an item when the tree that it was read from is gone. Stored: of the description, such as LightItem.
template <class Stored>
struct Harvested {
  Stored item;
  std::uint32_t number;  ///< among the elements of its piece
  bool usable;
};

/// may_skip: whether the item may be left out where its type says so; otherwise that is an error.
template <class T>
Item<T> read_item(Element element, FieldsReader<typename T::Parameters>& reader, bool may_skip,
                  Diagnostics& diagnostics) {
  Item<T> item;
  item.element = element;
  item.line = element.line();
  item.usable = reader.read(element, item.parameters, item.labels, diagnostics);
  if constexpr (requires { T::check(item.parameters); }) {
    if (item.usable) {
      if (const std::optional<Problem> problem = T::check(item.parameters)) {
        const auto message = [&] { return problem->message; };
        if (problem->kind == Problem::Kind::skip && may_skip)
          report_warning(diagnostics, element, message);
        else
          report_error(diagnostics, element, message);
        item.usable = false;
      }
    }
  }
  return item;
}

inline void refuse_misplaced(Element element, std::string_view parent, Diagnostics& diagnostics) {
  report_error(diagnostics, element, [&] { return explain_misplaced(element.name(), parent); });
}

/// What items are read with, by one thread at a time.
struct ItemTools {
  ItemTools(const SceneText& text, const Variables& variables) : document(text, variables) {}

  Document document;
  std::optional<ItemPattern> pattern;  ///< that items had lately
  int patterns_left = 8;               ///< so many may be tried: items may all differ
};

/// Of the type T, for what the description stores of them. convert(Item<T>&, diagnostics) makes that, and may find an
/// item not usable: with a report if it has an element. It is called by several threads at once.
template <class T, class Stored, class Convert>
class ItemReader {
 public:
  using Harvest = std::vector<Harvested<Stored>>;

  /// group: the element that they are in. labels: what items have beside their parameters.
  ItemReader(const SceneText& text, Element group, const std::vector<FieldInfo>& labels, bool may_skip,
             const Convert& convert)
      : text_(text), group_(group), labels_(labels), may_skip_(may_skip), convert_(convert) {}

  Harvested<Stored> read(Element element, std::uint32_t number, FieldsReader<typename T::Parameters>& fields,
                         Diagnostics& diagnostics) const {
    Item<T> item = read_item<T>(element, fields, may_skip_, diagnostics);
    Stored stored = convert_(item, diagnostics);
    return {std::move(stored), number, item.usable};
  }

  void read_piece(std::size_t piece, ItemTools& tools, Harvest& harvest, Diagnostics& diagnostics) const {
    FieldsReader<typename T::Parameters> fields(T::fields(), labels_);
    std::uint32_t number = 0;
    Span rest = text_.piece(piece);
    while (true) {
      const std::uint32_t number_before = number;
      if (tools.pattern) read_alike(*tools.pattern, fields, rest, number, harvest, diagnostics);
      if (rest.begin == rest.end) return;
      // Alone, an item takes longer to parse than among others. So that must be rare, or lead to the next pattern.
      constexpr std::uint32_t many = 8;
      const std::uint32_t alike = number - number_before;
      const bool wants_pattern = alike == 0 && tools.patterns_left > 0;
      const std::size_t length = wants_pattern || alike >= many ? first_length(rest) : 0;
      Span parsed = rest;
      if (length > 0) parsed.end = parsed.begin + length;
      const std::size_t findings_before = diagnostics.error_count() + diagnostics.warning_count();
      read_parsed(parsed, tools.document, fields, number, harvest, diagnostics);
      if (length == 0) return;
      const std::string_view text = text_.of(parsed);
      if (wants_pattern) {
        --tools.patterns_left;
        if (diagnostics.error_count() + diagnostics.warning_count() == findings_before)
          tools.pattern = pattern_of(text, tools.document.root().first_child().element(), fields);
      }
      rest.line += static_cast<std::uint32_t>(std::count(text.begin(), text.end(), '\n'));
      rest.begin = parsed.end;
      skip_space(rest);
    }
  }

 private:
  /// As many as have the pattern, off the beginning of `rest`.
  void read_alike(const ItemPattern& pattern, FieldsReader<typename T::Parameters>& fields, Span& rest,
                  std::uint32_t& number, Harvest& harvest, Diagnostics& diagnostics) const {
    while (rest.begin < rest.end) {
      Item<T> item;
      item.line = rest.line;
      const std::size_t length = pattern.read(text_.of(rest), fields.targets(item.parameters, item.labels));
      if (length == 0) return;
      if constexpr (requires { T::check(item.parameters); })
        if (T::check(item.parameters)) return;
      item.usable = true;
      Stored stored = convert_(item, diagnostics);
      if (!item.usable) return;
      harvest.push_back({std::move(stored), number++, true});
      rest.line += pattern.line_ends();
      rest.begin += length;
      skip_space(rest);
    }
  }

  void read_parsed(const Span& items, Document& document, FieldsReader<typename T::Parameters>& fields,
                   std::uint32_t& number, Harvest& harvest, Diagnostics& diagnostics) const {
    document.parse_items(items, diagnostics);
    const Element root = document.root();
    if (!root) return;
    for (Node node = root.first_child(); node; node = node.next()) {
      if (refuse_text(node, group_, diagnostics)) continue;
      const Element child = node.element();
      if (child.name() == T::element)
        harvest.push_back(read(child, number, fields, diagnostics));
      else
        refuse_misplaced(child, group_.name(), diagnostics);
      ++number;
    }
  }

  static std::optional<ItemPattern> pattern_of(std::string_view text, Element item,
                                               FieldsReader<typename T::Parameters>& fields) {
    typename T::Parameters parameters;
    std::array<std::string_view, 2> labels;
    return ItemPattern::of(text, item, fields.infos(), fields.targets(parameters, labels));
  }

  /// Of the item that starts there; 0 if there is something else.
  std::size_t first_length(const Span& span) const {
    const std::string_view text = text_.of(span);
    return text.size() > 1 && text[0] == '<' && xml::is(text[1], xml::name_start) ? element_length(text) : 0;
  }

  void skip_space(Span& span) const {
    const std::string_view text = text_.of(span);
    std::size_t size = 0;
    for (; size < text.size() && xml::is(text[size], xml::space); ++size) span.line += text[size] == '\n' ? 1 : 0;
    span.begin += size;
  }

  const SceneText& text_;
  Element group_;
  const std::vector<FieldInfo>& labels_;
  bool may_skip_;
  const Convert& convert_;
};

}  // namespace raytrace
