// Reads the items of a group from the chunks that it was cut into, on several threads.
#pragma once

#include <tbb/task_arena.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "raytrace/description/item_pattern.h"
#include "raytrace/description/name_table.h"
#include "raytrace/description/read_fields.h"
#include "raytrace/description/scene_layout.h"
#include "raytrace/xml/scene_text.h"

namespace raytrace {

/// The items of one type that a thread reads from a chunk, before they go into the description: what the loop over a
/// group's items knows of them. It is the same for all types, so that it is compiled once.
class ItemList {
 public:
  ItemList() = default;
  virtual ~ItemList() = default;
  ItemList(const ItemList&) = delete;
  ItemList& operator=(const ItemList&) = delete;

  virtual void clear() = 0;

  // number: of the item among the elements of its chunk.

  /// Appends what an element holds.
  virtual void read(Element element, std::uint32_t number, const ReadContext& context) = 0;

  /// Appends the item that `text`, which stands at `location`, starts with, if it has the pattern and there is nothing
  /// to say about it. The length of its text; 0 if it was not appended.
  virtual std::size_t read_alike(const ItemPattern& pattern, std::string_view text, SourceLocation location,
                                 std::uint32_t number) = 0;

  /// That of an item which was read with nothing to say. (ItemPattern::of)
  virtual std::optional<ItemPattern> pattern_of(std::string_view text, Element item) = 0;
};

struct ItemGroup {
  const SceneText& text;
  const Variables& variables;
  std::string_view folder;     ///< as ReadContext has it
  Element element;             ///< the group's
  std::string_view item_name;  ///< of its items' elements
};

/// For each chunk, in their order: take(the chunk's index, the items that were read from it). Several threads read at
/// once, each into a list that make() made for it; take is called by one at a time. Diagnostics do not depend on the
/// threads.
void read_items(const ItemGroup& group, tbb::task_arena& arena, Diagnostics& diagnostics,
                const std::function<std::unique_ptr<ItemList>()>& make,
                const std::function<void(std::size_t chunk, ItemList& items)>& take);

/// The textures that materials may name, or the materials that objects may name.
struct NamedItems {
  std::string_view section, item;  ///< "textures", "texture"
  NameTable names{};
  std::vector<ItemReference> references{};  ///< in the order of names
  bool complete = true;                     ///< false: one was refused before its name was read

  std::optional<ItemReference> find(std::string_view name) const {
    const std::optional<std::size_t> i = names.find(name);
    return i ? std::optional(references[*i]) : std::nullopt;
  }

  /// at(): where the name is in what has it.
  template <class At>
  void report_unknown(std::string_view name, Element user, const At& at, Diagnostics& diagnostics) const {
    // A missing one has been reported, and an unknown one may be among those that were refused.
    if (!name.empty() && complete) diagnostics.error(at(), [&] { return explain_unknown(name, user); });
  }

 private:
  std::string explain_unknown(std::string_view name, Element user) const;
};

struct SceneNames {
  NamedItems textures{TexturesSection::element, TexturesSection::item};
  NamedItems materials{MaterialsSection::element, MaterialsSection::item};
};

/// Items of the type T in one of the Sections.
template <class Section, class T>
class TypedItemList final : public ItemList {
 public:
  using Item = std::remove_cvref_t<decltype(items_of<Section, T>(std::declval<SceneDescription&>()).front())>;
  struct Entry {
    Item item;
    std::uint32_t number = 0;
    bool usable = false;  ///< free of errors, and not to be left out
  };

  explicit TypedItemList(const SceneNames& names) : names_(names) {}

  std::vector<Entry>& entries() { return entries_; }

  void clear() override { entries_.clear(); }

  void read(Element element, std::uint32_t number, const ReadContext& context) override {
    Entry& entry = append(element.location(), number);
    Labels labels;
    textures_.clear();
    entry.usable = fields_.read(element, &entry.item.parameters, targets_of(labels, entry.item), context,
                                has_textures ? &textures_ : nullptr);
    if constexpr (has_textures) entry.usable &= take_textures(entry.item, context.diagnostics);
    if (take_labels(labels, entry.item)) return;
    entry.usable = false;
    if constexpr (has_material)
      names_.materials.report_unknown(
          labels[1], element, [&] { return element.child("material").first_child(); }, context.diagnostics);
  }

  std::size_t read_alike(const ItemPattern& pattern, std::string_view text, SourceLocation location,
                         std::uint32_t number) override {
    Entry& entry = append(location, number);
    Labels labels;
    const std::size_t length =
        pattern.read(text, fields_.targets(&entry.item.parameters, targets_of(labels, entry.item)));
    const auto ignore = [](Severity, const std::string&) {};
    entry.usable = length > 0 && check_together(element_type<T>(), &entry.item.parameters, true, ignore) &&
                   take_labels(labels, entry.item);
    const auto is_textured = [](std::string_view) { return false; };  // patterns have no textures
    if (entry.usable)
      report_warnings(element_type<T>(), &entry.item.parameters, is_textured,
                      [&](const ParameterWarning&) { entry.usable = false; });
    if (entry.usable) return length;
    entries_.pop_back();
    return 0;
  }

  std::optional<ItemPattern> pattern_of(std::string_view text, Element item) override {
    Item none;
    Labels labels;
    return ItemPattern::of(text, item, fields_.infos(), fields_.targets(&none.parameters, targets_of(labels, none)));
  }

 private:
  static constexpr bool has_material = requires(Item item) { item.material; };
  static constexpr bool has_textures = requires(Item item) { item.textures; };
  static constexpr auto labels_ = labels_of<Section, T>();
  /// The texts of a name and of a material.
  using Labels = std::array<std::string_view, labels_.size()>;

  /// Where they go; what is no text goes to the item at once.
  static auto targets_of(Labels& labels, Item& item) {
    std::array<FieldTarget, labels_.size()> targets;
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      targets[i] = &labels[i];
      if constexpr (requires { item.transform; })
        if (labels_[i].name == transform_element) targets[i] = &item.transform;
      if constexpr (requires { item.shadowcatcher; }) {
        if (labels_[i].name == shadowcatcher_element) targets[i] = &item.shadowcatcher;
        if (labels_[i].name == visible_element) targets[i] = &item.visible;
      }
    }
    return targets;
  }

  Entry& append(SourceLocation location, std::uint32_t number) {
    Entry& entry = entries_.emplace_back();
    entry.item.line = location.line;
    entry.item.column = location.column;
    entry.number = number;
    return entry;
  }

  /// False if there is no material of that name.
  bool take_labels(const Labels& labels, Item& item) const {
    if constexpr (requires { item.name; }) item.name = labels[0];
    if constexpr (has_material) {
      if (labels[1].empty()) return true;  // it is optional
      const std::optional<ItemReference> material = names_.materials.find(labels[1]);
      if (!material) return false;
      item.material = *material;
    }
    return true;
  }

  /// False, with an error, if there is no texture of a name.
  bool take_textures(Item& item, Diagnostics& diagnostics) const {
    bool fine = true;
    for (const FieldTexture& use : textures_) {
      const auto& [name, channel] = use.attributes;
      if (const std::optional<ItemReference> texture = names_.textures.find(name)) {
        const std::size_t field = use.field - labels_.size();
        item.textures.push_back(
            {static_cast<std::uint32_t>(field), *texture, channel_of(element_type<T>().fields[field], channel)});
        continue;
      }
      fine = false;
      names_.textures.report_unknown(
          name, use.element, [&] { return find_attribute(use.element, texture_attribute); }, diagnostics);
    }
    return fine;
  }

  const SceneNames& names_;
  FieldsReader fields_{element_type<T>(), labels_, Section::may_skip};
  std::vector<FieldTexture> textures_;  // of the item at hand
  std::vector<Entry> entries_;
};

}  // namespace raytrace
