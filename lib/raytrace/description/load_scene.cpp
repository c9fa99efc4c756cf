#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "raytrace/description/item_list.h"
#include "raytrace/description/name_table.h"
#include "raytrace/description/read_fields.h"
#include "raytrace/description/read_items.h"
#include "raytrace/description/refuse_content.h"
#include "raytrace/description/scene_description.h"
#include "raytrace/description/scene_layout.h"
#include "raytrace/description/variables.h"
#include "raytrace/parallel/worker_count.h"
#include "raytrace/text/nearest_name.h"
#include "raytrace/text/quoted.h"
#include "raytrace/xml/document.h"
#include "raytrace/xml/report.h"
#include "raytrace/xml/scene_text.h"
#include "raytrace/xml/text_file.h"

namespace raytrace {
namespace {

/// Where the text of a label stands.
Node label_text(Element item, std::string_view label) { return item.child(label).first_child(); }

class SceneReader {
 public:
  SceneReader(const SceneText& text, const Variables& variables, int threads, Diagnostics& diagnostics)
      : text_(text),
        variables_(variables),
        diagnostics_(diagnostics),
        frame_(text, variables),
        arena_(worker_count(threads)) {
    scene_.file = diagnostics.file();
  }

  void read() {
    frame_.parse_skeleton(diagnostics_);
    if (const Element root = frame_.root()) read(root);
  }

  SceneDescription take() { return std::move(scene_); }

 private:
  static constexpr std::string_view camera_key = "camera";

  void read(Element root) {
    if (root.name() != root_element) {
      const std::string_view nearest = nearest_name(root.name(), {&root_element, 1});
      report_error(diagnostics_, root,
                   [&] { return "the scene starts with " + tag(root.name()) + "; it must be " + tag(root_element); });
      if (nearest.empty()) return;
    }
    refuse_root_attributes(root);
    std::vector<Element> object_sections;
    for (Node node = root.first_child(); node; node = node.next()) {
      if (refuse_text(node, root, diagnostics_)) continue;
      const Element child = node.element();
      if (child.name() == lights_element)
        read_lights(child);
      else if (child.name() == materials_element)
        read_materials(child);
      else if (child.name() == objects_element)
        object_sections.push_back(child);
      else if (child.name() == ViewPlane::element)
        read_viewplane(child);
      else if (!read_camera(child))
        refuse_unknown(child, root_element);
    }
    // Objects name materials, which may come after them.
    report_taken("material", material_names_);
    for (const Element section : object_sections) read_objects(section);
    report_taken("object", object_names_);
    if (!has(ViewPlane::element)) report_missing(root, ViewPlane::element);
    if (!has(camera_key)) report_missing(root, camera_key);
  }

  void read_viewplane(Element element) {
    if (!is_first(ViewPlane::element, element)) return;
    FieldsReader<ViewPlane> reader(ViewPlane::fields());
    scene_.viewplane = read_item<ViewPlane>(element, reader, false, diagnostics_).parameters;
  }

  /// False if the element is no camera.
  bool read_camera(Element element) {
    bool found = false;
    for_each_type(Cameras{}, [&]<class Camera>(std::type_identity<Camera>) {
      if (found || element.name() != Camera::element) return;
      found = true;
      if (!is_first(camera_key, element)) return;
      FieldsReader<typename Camera::Parameters> reader(Camera::fields());
      scene_.camera = read_item<Camera>(element, reader, false, diagnostics_).parameters;
    });
    return found;
  }

  void read_lights(Element section) {
    const auto convert = []<class T>(Item<T>& item, Diagnostics&) { return LightItem<T>{item.parameters, item.line}; };
    read_section(section, Lights{}, scene_.lights, {}, true, convert,
                 []<class T>(auto&& light, ItemPosition, auto& items) {
                   if (light.usable) items.push_back(std::move(light.item));
                 });
  }

  void read_materials(Element section) {
    const auto convert = []<class T>(Item<T>& item, Diagnostics&) {
      return MaterialItem<T>{item.parameters, std::string(item.labels[0]), item.line};
    };
    const auto accept = [&]<class T>(auto&& material, ItemPosition place, auto& items) {
      // A faulty material keeps its name, so that the objects that use it are not reported too.
      if (!material.item.name.empty()) {
        material_names_.add(material.item.name, place);
        materials_.push_back(
            {static_cast<std::uint32_t>(index_of<T>(Materials{})), static_cast<std::uint32_t>(items.size())});
      } else {
        material_names_missing_ = true;
      }
      if (material.usable) items.push_back(std::move(material.item));
    };
    read_section(section, Materials{}, scene_.materials, {{"name"}}, false, convert, accept);
  }

  void read_objects(Element section) {
    const auto convert = [this]<class T>(Item<T>& item, Diagnostics& diagnostics) {
      const auto [name, material_name] = item.labels;
      ObjectItem<T> object{item.parameters, std::string(name), {}, item.line};
      // Without one it has been reported.
      if (material_name.empty()) return object;
      if (const std::optional<std::size_t> material = material_names_.find(material_name)) {
        object.material = materials_[*material];
      } else {
        if (item.element && !material_names_missing_) report_unknown_material(item.element, material_name, diagnostics);
        item.usable = false;
      }
      return object;
    };
    const auto accept = [&]<class T>(auto&& object, ItemPosition place, auto& items) {
      if (!object.item.name.empty()) object_names_.add(object.item.name, place);
      if (object.usable) items.push_back(std::move(object.item));
    };
    read_section(section, Shapes{}, scene_.objects, {{"name", false}, {"material"}}, true, convert, accept);
  }

  /// Reads the groups of a section. tuple: its vectors of items, one for each type of the list. labels: what its items
  /// have beside their parameters. convert(Item<T>&, diagnostics): gives what the vector holds, and may find the item
  /// not usable; called by several threads at once. accept<T>(TypedItemList::Entry, its place, the vector): stores an
  /// item.
  template <class List, class Tuple, class Convert, class Accept>
  void read_section(Element section, List list, Tuple& tuple, const std::vector<FieldInfo>& labels, bool may_skip,
                    const Convert& convert, const Accept& accept) {
    refuse_attributes(section, {}, diagnostics_);
    for (Node node = section.first_child(); node; node = node.next()) {
      if (refuse_text(node, section, diagnostics_)) continue;
      const Element child = node.element();
      bool found = false;
      for_each_type(list, [&]<class T>(std::type_identity<T>) {
        if (found || child.name() != (T::group.empty() ? T::element : T::group)) return;
        found = true;
        auto& items = std::get<index_of<T>(List{})>(tuple);
        using Typed = TypedItemList<T, typename std::remove_reference_t<decltype(items)>::value_type, Convert>;
        if constexpr (T::group.empty()) {
          if (!is_first(T::element, child)) return;
          Typed one(labels, may_skip, convert);
          one.read(child, 0, diagnostics_);
          accept.template operator()<T>(std::move(one.entries().front()), ItemPosition{}, items);
        } else {
          refuse_group_content(child);
          const std::size_t elements = text_.chunks_of(child.offset()).items;
          reserve_more(items, elements);
          std::size_t read_elements = 0;
          read_items(
              {text_, variables_, child, T::element}, arena_, diagnostics_,
              [&] { return std::make_unique<Typed>(labels, may_skip, convert); },
              [&](std::size_t chunk, ItemList& read) {
                for (auto& entry : static_cast<Typed&>(read).entries()) {
                  ++read_elements;
                  const ItemPosition place{static_cast<std::uint32_t>(chunk), entry.number};
                  accept.template operator()<T>(std::move(entry), place, items);
                }
              });
          if (read_elements < elements && section.name() == materials_element) material_names_missing_ = true;
        }
      });
      if (!found) refuse_unknown(child, section.name());
    }
  }

  /// One slip, one message: what was only misspelt, or stands in the wrong place, is not reported as missing, too.
  void refuse_unknown(Element child, std::string_view parent) {
    if (diagnostics_.keeps_another(Severity::error)) {
      const std::string_view meant = meant_element(child.name(), parent);
      for_each_type(Cameras{}, [&]<class Camera>(std::type_identity<Camera>) {
        if (meant == Camera::element) meant_.push_back(camera_key);
      });
      meant_.push_back(meant);
      if (parent == materials_element || belongs_to_section(meant, materials_element)) material_names_missing_ = true;
    }
    refuse_misplaced(child, parent, diagnostics_);
  }

  void refuse_group_content(Element group) {
    refuse_attributes(group, {}, diagnostics_);
    // What stands before the first item; that one and the rest are in the chunks.
    for (Node node = group.first_child(); node; node = node.next()) refuse_text(node, group, diagnostics_);
  }

  template <class Items>
  static void reserve_more(Items& items, std::size_t more) {
    const std::size_t count = items.size() + more;
    // No less than vectors grow by themselves: there may be a million groups of one item each.
    if (count > items.capacity()) items.reserve(std::max(count, 2 * items.capacity()));
  }

  /// For elements that a scene has once: remembers the first and reports the others.
  bool is_first(std::string_view key, Element element) {
    const Element first = first_of(key);
    if (!first) {
      firsts_.emplace_back(key, element);
      return true;
    }
    report_error(diagnostics_, element, [&] {
      return "a second " + tag(element.name()) + "; a scene has one, and the first is in line " +
             std::to_string(first.line());
    });
    return false;
  }

  /// Whether the scene has that element, or what was meant for it.
  bool has(std::string_view key) const {
    return first_of(key) || std::find(meant_.begin(), meant_.end(), key) != meant_.end();
  }

  Element first_of(std::string_view key) const {
    for (const auto& [first_key, element] : firsts_) {
      if (first_key == key) return element;
    }
    return Element();
  }

  void report_taken(const char* what, NameTable& names) {
    Document first_document(text_, variables_), other_document(text_, variables_);
    names.finish(arena_.max_concurrency(),
                 [&](std::string_view name, ItemPosition first_place, ItemPosition other_place) {
                   if (!diagnostics_.keeps_another(Severity::error)) return diagnostics_.error({}, {});
                   const Element first = item_at(first_place, first_document);
                   const Element other = item_at(other_place, other_document);
                   report_error(diagnostics_, label_text(other, "name"), [&] {
                     return "the " + std::string(what) + " name " + in_quotes(name) + " is taken by the " +
                            tag(first.name()) + " in line " + std::to_string(first.line()) + "; choose another";
                   });
                 });
  }

  /// The item once more, parsed by `document`.
  Element item_at(ItemPosition place, Document& document) const {
    Diagnostics none = Diagnostics::counter();
    document.parse_items(text_.chunk(place.chunk), none);
    std::uint32_t number = 0;
    Node node = document.root().first_child();
    while (!node.element() || number++ < place.number) node = node.next();
    return node.element();
  }

  void report_unknown_material(Element object, std::string_view name, Diagnostics& diagnostics) const {
    report_error(diagnostics, label_text(object, "material"), [&] {
      const std::string_view nearest = nearest_name(name, material_names_.names());
      return "unknown material " + in_quotes(name) + " in " + tag(object.name()) + "; " +
             (nearest.empty() ? "add one of that name to " + tag(materials_element)
                              : "did you mean " + in_quotes(nearest) + "?");
    });
  }

  /// The root may name its schema, as editors like it.
  void refuse_root_attributes(Element root) {
    for (Attribute attribute = root.first_attribute(); attribute; attribute = attribute.next()) {
      const bool declaration =
          attribute.name() == "xmlns:xsi" && attribute.value() == "http://www.w3.org/2001/XMLSchema-instance";
      if (declaration || attribute.name() == "xsi:noNamespaceSchemaLocation") continue;
      report_error(diagnostics_, attribute, [&] {
        return "unexpected attribute " + in_quotes(attribute.name()) + " in " + tag(root.name()) + "; remove it";
      });
    }
  }

  void report_missing(Element root, std::string_view section) {
    report_error(diagnostics_, root, [&] { return "the scene has no " + tag(section) + "; add one"; });
  }

  const SceneText& text_;
  const Variables& variables_;
  Diagnostics& diagnostics_;
  Document frame_;
  tbb::task_arena arena_;
  SceneDescription scene_;
  std::vector<std::pair<std::string_view, Element>> firsts_;
  std::vector<std::string_view> meant_;  // of the layout, for elements that were refused
  bool material_names_missing_ = false;  // a material was refused before its name was read
  NameTable material_names_, object_names_;
  std::vector<MaterialReference> materials_;  // in the order of material_names_
};

void report_unused(const Variables& variables, Diagnostics& diagnostics) {
  for (const std::string_view name : variables.unused()) {
    diagnostics.error({}, "no value of the scene uses $" + printable(name) + "; remove -D " + printable(name) + "=...");
  }
}

std::optional<SceneDescription> read_scene(TextBuffer text, Diagnostics& diagnostics, int threads,
                                           const SceneSettings& settings) {
  const SceneText scene_text(std::move(text), group_elements(), threads, diagnostics);
  if (!scene_text.well_formed()) return std::nullopt;
  const Variables variables(settings);
  SceneReader reader(scene_text, variables, threads, diagnostics);
  reader.read();
  // Where there are errors, not all that stands in the scene has been read.
  if (!diagnostics.has_errors()) report_unused(variables, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  return reader.take();
}

}  // namespace

std::optional<SceneDescription> parse_scene(std::string_view text, Diagnostics& diagnostics, int threads,
                                            const SceneSettings& settings) {
  return read_scene(TextBuffer(text), diagnostics, threads, settings);
}

std::optional<SceneDescription> load_scene(const std::string& file, Diagnostics& diagnostics, int threads,
                                           const SceneSettings& settings) {
  std::optional<TextBuffer> text = read_text_file(file, threads, diagnostics);
  if (!text) return std::nullopt;
  std::optional<SceneDescription> scene = read_scene(std::move(*text), diagnostics, threads, settings);
  if (scene) scene->file = file;
  return scene;
}

}  // namespace raytrace
