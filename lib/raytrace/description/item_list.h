// The items of one type that a thread reads from a chunk of a scene's text, before they go into the description.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "raytrace/description/item_pattern.h"
#include "raytrace/description/read_fields.h"
#include "raytrace/parameters/fields.h"
#include "raytrace/xml/diagnostics.h"
#include "raytrace/xml/document.h"
#include "raytrace/xml/report.h"

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
      if (const std::optional<ParameterDiagnostic> diagnostic = T::check(item.parameters)) {
        const auto message = [&] { return diagnostic->message; };
        if (diagnostic->effect == ParameterDiagnostic::Effect::skip && may_skip)
          report_warning(diagnostics, element, message);
        else
          report_error(diagnostics, element, message);
        item.usable = false;
      }
    }
  }
  return item;
}

/// What the loop over a group's items (read_items.h) knows of them: the same for all types, so that it is compiled
/// once.
class ItemList {
 public:
  ItemList() = default;
  virtual ~ItemList() = default;
  ItemList(const ItemList&) = delete;
  ItemList& operator=(const ItemList&) = delete;

  virtual void clear() = 0;

  // number: of the item among the elements of its chunk.

  /// Appends what an element holds.
  virtual void read(Element element, std::uint32_t number, Diagnostics& diagnostics) = 0;

  /// Appends the item that `text`, whose line is `line`, starts with, if it has the pattern and there is nothing to say
  /// about it. The length of its text; 0 if it was not appended.
  virtual std::size_t read_alike(const ItemPattern& pattern, std::string_view text, std::uint32_t line,
                                 std::uint32_t number) = 0;

  /// That of an item which was read with nothing to say. (ItemPattern::of)
  virtual std::optional<ItemPattern> pattern_of(std::string_view text, Element item) = 0;
};

/// Of the type T, for what the description stores of them, such as LightItem.
template <class T, class Stored, class Convert>
class TypedItemList final : public ItemList {
 public:
  struct Entry {
    Stored item;
    std::uint32_t number;
    bool usable;
  };

  /// labels: what items have beside their parameters. convert(Item<T>&, diagnostics) makes what is stored, and may find
  /// an item not usable: with a report if it has an element. Several lists call it at once.
  TypedItemList(const std::vector<FieldInfo>& labels, bool may_skip, const Convert& convert)
      : fields_(T::fields(), labels), may_skip_(may_skip), convert_(convert) {}

  std::vector<Entry>& entries() { return entries_; }

  void clear() override { entries_.clear(); }

  void read(Element element, std::uint32_t number, Diagnostics& diagnostics) override {
    Item<T> item = read_item<T>(element, fields_, may_skip_, diagnostics);
    Stored stored = convert_(item, diagnostics);
    entries_.push_back({std::move(stored), number, item.usable});
  }

  std::size_t read_alike(const ItemPattern& pattern, std::string_view text, std::uint32_t line,
                         std::uint32_t number) override {
    Item<T> item;
    item.line = line;
    const std::size_t length = pattern.read(text, fields_.targets(item.parameters, item.labels));
    if (length == 0) return 0;
    if constexpr (requires { T::check(item.parameters); })
      if (T::check(item.parameters)) return 0;
    item.usable = true;
    Diagnostics none = Diagnostics::counter();  // without an element, there is nothing to report
    Stored stored = convert_(item, none);
    if (!item.usable) return 0;
    entries_.push_back({std::move(stored), number, true});
    return length;
  }

  std::optional<ItemPattern> pattern_of(std::string_view text, Element item) override {
    typename T::Parameters parameters;
    std::array<std::string_view, 2> labels;
    return ItemPattern::of(text, item, fields_.infos(), fields_.targets(parameters, labels));
  }

 private:
  FieldsReader<typename T::Parameters> fields_;
  bool may_skip_;
  const Convert& convert_;
  std::vector<Entry> entries_;
};

}  // namespace raytrace
