#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "raytrace/description/document.h"
#include "raytrace/description/name_table.h"
#include "raytrace/description/nearest_name.h"
#include "raytrace/description/quoted.h"
#include "raytrace/description/read_fields.h"
#include "raytrace/description/refuse_content.h"
#include "raytrace/description/report.h"
#include "raytrace/description/scene_description.h"
#include "raytrace/description/scene_layout.h"
#include "raytrace/description/text_file.h"

namespace raytrace {
namespace {

/// An element with its parameters read.
template <class T>
struct Item {
  Element element;
  typename T::Parameters parameters;
  std::array<std::string_view, 2> labels;  ///< the section's labels; empty where absent
  bool usable = false;                     ///< free of errors, and not to be left out
};

/// Where the text of a label stands.
Node label_text(Element item, std::string_view label) { return item.child(label).first_child(); }

class SceneReader {
 public:
  explicit SceneReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) { scene_.file = diagnostics.file(); }

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
        refuse_misplaced(child, root_element);
    }
    // Objects name materials, which may come after them.
    report_taken("material", material_names_);
    for (const Element section : object_sections) read_objects(section);
    report_taken("object", object_names_);
    if (!first_of(ViewPlane::element)) report_missing(root, ViewPlane::element);
    if (!first_of(camera_key)) report_missing(root, camera_key);
  }

  SceneDescription take() { return std::move(scene_); }

 private:
  static constexpr std::string_view camera_key = "camera";

  void read_viewplane(Element element) {
    if (!is_first(ViewPlane::element, element)) return;
    FieldsReader<ViewPlane> reader(ViewPlane::fields());
    read_item<ViewPlane>(
        element, reader, [&](const Item<ViewPlane>& item) { scene_.viewplane = item.parameters; }, false);
  }

  /// False if the element is no camera.
  bool read_camera(Element element) {
    bool found = false;
    for_each_type(Cameras{}, [&]<class Camera>(std::type_identity<Camera>) {
      if (found || element.name() != Camera::element) return;
      found = true;
      if (!is_first(camera_key, element)) return;
      FieldsReader<typename Camera::Parameters> reader(Camera::fields());
      read_item<Camera>(element, reader, [&](const Item<Camera>& item) { scene_.camera = item.parameters; }, false);
    });
    return found;
  }

  void read_lights(Element section) {
    read_section(section, Lights{}, scene_.lights, {}, true, [](auto&& item, auto& items) {
      if (item.usable) items.push_back({item.parameters, item.element.line()});
    });
  }

  void read_materials(Element section) {
    read_section(section, Materials{}, scene_.materials, {{"name"}}, false, [&]<class T>(Item<T>&& item, auto& items) {
      const std::string_view name = item.labels[0];
      // A faulty material keeps its name, so that the objects that use it are not reported too.
      if (!name.empty()) {
        material_names_.add(name, item.element);
        materials_.push_back(
            {static_cast<std::uint32_t>(index_of<T>(Materials{})), static_cast<std::uint32_t>(items.size())});
      }
      if (item.usable) items.push_back({item.parameters, std::string(name), item.element.line()});
    });
  }

  void read_objects(Element section) {
    read_section(section, Shapes{}, scene_.objects, {{"name", false}, {"material"}}, true,
                 [&](auto&& item, auto& items) {
                   const auto [name, material_name] = item.labels;
                   if (!name.empty()) object_names_.add(name, item.element);
                   if (material_name.empty()) return;
                   const std::optional<std::size_t> material = material_names_.find(material_name);
                   if (!material)
                     report_unknown_material(item.element, material_name);
                   else if (item.usable)
                     items.push_back({item.parameters, std::string(name), materials_[*material], item.element.line()});
                 });
  }

  /// Reads the groups of a section. tuple: its vectors of items, one for each type of the list. labels: what its items
  /// have beside their parameters. accept(Item<T>&&, the vector): stores an item.
  template <class List, class Tuple, class Accept>
  void read_section(Element section, List list, Tuple& tuple, const std::vector<FieldInfo>& labels, bool may_skip,
                    Accept accept) {
    refuse_attributes(section, {}, diagnostics_);
    for (Node node = section.first_child(); node; node = node.next()) {
      if (refuse_text(node, section, diagnostics_)) continue;
      const Element child = node.element();
      bool found = false;
      for_each_type(list, [&]<class T>(std::type_identity<T>) {
        if (found || child.name() != (T::group.empty() ? T::element : T::group)) return;
        found = true;
        auto& items = std::get<index_of<T>(List{})>(tuple);
        FieldsReader<typename T::Parameters> reader(T::fields(), labels);
        const auto store = [&](Item<T>&& item) { accept(std::move(item), items); };
        if constexpr (T::group.empty()) {
          if (is_first(T::element, child)) read_item<T>(child, reader, store, may_skip);
        } else {
          reserve_for(child, items);
          read_group<T>(child, reader, store, may_skip);
        }
      });
      if (!found) refuse_misplaced(child, section.name());
    }
  }

  template <class T, class Reader, class Store>
  void read_group(Element group, Reader& reader, Store&& store, bool may_skip) {
    refuse_attributes(group, {}, diagnostics_);
    for (Node node = group.first_child(); node; node = node.next()) {
      if (refuse_text(node, group, diagnostics_)) continue;
      const Element child = node.element();
      if (child.name() == T::element)
        read_item<T>(child, reader, store, may_skip);
      else
        refuse_misplaced(child, group.name());
    }
  }

  /// may_skip: whether the item may be left out where its type says so; otherwise that is an error.
  template <class T, class Reader, class Store>
  void read_item(Element element, Reader& reader, Store&& store, bool may_skip) {
    Item<T> item;
    item.element = element;
    item.usable = reader.read(element, item.parameters, item.labels, diagnostics_);
    if constexpr (requires { T::check(item.parameters); }) {
      if (item.usable) {
        if (const std::optional<Problem> problem = T::check(item.parameters)) {
          const auto message = [&] { return problem->message; };
          if (problem->kind == Problem::Kind::skip && may_skip)
            report_warning(diagnostics_, element, message);
          else
            report_error(diagnostics_, element, message);
          item.usable = false;
        }
      }
    }
    store(std::move(item));
  }

  template <class Items>
  static void reserve_for(Element group, Items& items) {
    std::size_t count = items.size();
    for (Node node = group.first_child(); node; node = node.next()) ++count;
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

  Element first_of(std::string_view key) const {
    for (const auto& [first_key, element] : firsts_) {
      if (first_key == key) return element;
    }
    return Element();
  }

  void report_taken(const char* what, NameTable& names) {
    names.finish([&](std::string_view name, Element first, Element other) {
      report_error(diagnostics_, label_text(other, "name"), [&] {
        return "the " + std::string(what) + " name " + in_quotes(name) + " is taken by the " + tag(first.name()) +
               " in line " + std::to_string(first.line()) + "; choose another";
      });
    });
  }

  void report_unknown_material(Element object, std::string_view name) {
    report_error(diagnostics_, label_text(object, "material"), [&] {
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

  void refuse_misplaced(Element element, std::string_view parent) {
    report_error(diagnostics_, element, [&] { return explain_misplaced(element.name(), parent); });
  }

  void report_missing(Element root, std::string_view section) {
    report_error(diagnostics_, root, [&] { return "the scene has no " + tag(section) + "; add one"; });
  }

  Diagnostics& diagnostics_;
  SceneDescription scene_;
  std::vector<std::pair<std::string_view, Element>> firsts_;
  NameTable material_names_, object_names_;
  std::vector<MaterialReference> materials_;  // in the order of material_names_
};

}  // namespace

std::optional<SceneDescription> parse_scene(std::string text, Diagnostics& diagnostics) {
  const Document document(std::move(text), diagnostics);
  if (!document.root()) return std::nullopt;
  SceneReader reader(diagnostics);
  reader.read(document.root());
  if (diagnostics.has_errors()) return std::nullopt;
  return reader.take();
}

std::optional<SceneDescription> load_scene(const std::string& file, Diagnostics& diagnostics) {
  std::optional<std::string> text = read_text_file(file, diagnostics);
  if (!text) return std::nullopt;
  std::optional<SceneDescription> scene = parse_scene(std::move(*text), diagnostics);
  if (scene) scene->file = file;
  return scene;
}

}  // namespace raytrace
