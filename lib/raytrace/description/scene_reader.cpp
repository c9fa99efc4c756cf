#include "raytrace/description/scene_reader.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "raytrace/description/check_environment.h"
#include "raytrace/description/check_fibres.h"
#include "raytrace/description/check_fogs.h"
#include "raytrace/description/check_groups.h"
#include "raytrace/description/include.h"
#include "raytrace/description/read_items.h"
#include "raytrace/description/scene_files.h"
#include "raytrace/parallel/worker_count.h"

namespace raytrace {
namespace {

class SceneReader {
 public:
  SceneReader(const Variables& variables, Diagnostics& diagnostics, int threads, const KeyedObjects* only)
      : variables_(variables),
        diagnostics_(diagnostics),
        only_(only),
        files_(variables, diagnostics, threads),
        arena_(worker_count(threads)) {
    scene_.file = diagnostics_.file();
  }

  void read(TextBuffer text, const std::string& file) {
    file_ = files_.open(std::move(text), file);
    if (file_ == nullptr) return;
    const Element root = file_->skeleton.root();
    read_root(root);
    resolve_field_of_view();
    // Objects name materials, and those textures, which may come after them.
    report_taken(TexturesSection::item, names_.textures.names);
    read_all(material_sections_, [&](Element section) { read_section<MaterialsSection>(section); });
    report_taken(MaterialsSection::item, names_.materials.names);
    read_all(object_sections_, [&](Element section) { read_section<ObjectsSection>(section); });
    report_taken(ObjectsSection::item, object_names_);
    read_all(group_sections_, [&](Element section) { read_groups(section); });
    if (groups_complete_) check_groups(scene_, diagnostics_);
    check_environment(scene_, diagnostics_);
    check_fogs(scene_, diagnostics_);
    check_fibres(scene_, diagnostics_);
    for (const std::string_view key : {ViewPlane::element, camera_key})
      if (!firsts_.contains(key))
        diagnostics_.error(root, [&] { return "the scene has no " + tag(key) + "; add one"; });
  }

  ReadScene take() {
    scene_.included = files_.included();
    return {std::move(scene_), variables_.moment_was_asked(), std::move(keyed_)};
  }

 private:
  static constexpr std::string_view camera_key = "camera", integrator_key = "integrator type";

  /// A section that is read when all files are known.
  struct LaterSection {
    const SceneFile* file;
    Element element;
  };

  void read_root(Element root) {
    for (Node node = root.first_child(); node; node = node.next()) {
      if (refuse_text(node, root, diagnostics_)) continue;
      const Element child = node.element();
      if (child.name() == LightsSection::element)
        read_section<LightsSection>(child);
      else if (child.name() == TexturesSection::element)
        read_section<TexturesSection>(child);
      else if (child.name() == MaterialsSection::element)
        material_sections_.push_back({file_, child});
      else if (child.name() == ObjectsSection::element)
        object_sections_.push_back({file_, child});
      else if (child.name() == groups_element)
        group_sections_.push_back({file_, child});
      else if (child.name() == ViewPlane::element)
        read_single<ViewPlane>(ViewPlane::element, child, scene_.viewplane);
      else if (child.name() == integrator_element)
        read_integrator(child);
      else if (child.name() == Include::element)
        read_include(child);
      else if (read_one_of(Cameras{}, camera_key, child, scene_.camera))
        scene_.camera_location = child.location();
      else
        refuse_unknown(child, root_element);
    }
  }

  void read_include(Element element) {
    Include::Parameters parameters;
    const bool is_fine = FieldsReader(element_type<Include>()).read(element, &parameters, {}, file_->context);
    const SceneFile* const included = is_fine ? files_.include(parameters.file) : nullptr;
    if (included == nullptr) return expect_anything();
    const SceneFile* const outer = std::exchange(file_, included);
    read_root(included->skeleton.root());
    file_ = outer;
    files_.leave();
  }

  /// What a file that is not read may have is not reported as missing, too.
  void expect_anything() {
    names_.textures.complete = names_.materials.complete = groups_complete_ = false;
    firsts_.try_emplace(ViewPlane::element);
    firsts_.try_emplace(camera_key);
  }

  template <class Read>
  void read_all(const std::vector<LaterSection>& sections, const Read& read) {
    for (const auto& [file, element] : sections) {
      file_ = file;
      read(element);
    }
  }

  /// An element that a scene has once. key: the same for all of which it has one together.
  template <class T, class Target>
  void read_single(std::string_view key, Element element, Target& target) {
    if (!is_first(key, element)) return;
    typename T::Parameters parameters;
    FieldsReader(element_type<T>()).read(element, &parameters, {}, file_->context);
    target = parameters;
  }

  /// False if the element is of no type in the list.
  template <class List, class Target>
  bool read_one_of(List list, std::string_view key, Element element, Target& target) {
    bool found = false;
    for_each_type(list, [&]<class T>(std::type_identity<T>) {
      if (found || element.name() != T::element) return;
      found = true;
      read_single<T>(key, element, target);
    });
    return found;
  }

  /// A camera's angle of view becomes its view distance, and leaves no size of pixels open.
  void resolve_field_of_view() {
    std::visit(
        [&]<class Parameters>(Parameters& camera) {
          if constexpr (requires { camera.fov; }) {
            if (camera.fov == 0) return;
            const auto plane = firsts_.find(ViewPlane::element);  // an entry would say that the scene has one
            if (plane != firsts_.end() && plane->second)
              if (const Element pixelsize = plane->second.child("pixelsize"))
                diagnostics_.error(pixelsize, [&] {
                  return tag(pixelsize.name()) +
                         " beside the camera's <fov>, which says how large pixels are; remove one of them";
                });
            camera.viewdistance = view_distance(camera.fov, scene_.viewplane);
            camera.fov = 0;
          }
        },
        scene_.camera);
  }

  void read_integrator(Element element) {
    if (!is_first(integrator_element, element)) return;
    refuse_attributes(element, {}, diagnostics_);
    const std::size_t errors_before = diagnostics_.error_count();
    for (Node node = element.first_child(); node; node = node.next()) {
      if (refuse_text(node, element, diagnostics_)) continue;
      if (!read_one_of(Integrators{}, integrator_key, node.element(), scene_.integrator))
        refuse_unknown(node.element(), integrator_element);
    }
    if (scene_.integrator || diagnostics_.error_count() > errors_before) return;
    diagnostics_.error(element, [&] {
      return tag(integrator_element) +
             " is empty; write one of its elements into it: " + list_of_tags(elements_in(integrator_element));
    });
  }

  void read_groups(Element section) {
    refuse_attributes(section, {}, diagnostics_);
    for (Node node = section.first_child(); node; node = node.next()) {
      if (refuse_text(node, section, diagnostics_)) continue;
      if (node.element().name() == group_element)
        read_group_of_objects(node.element());
      else
        refuse_unknown(node.element(), groups_element);
    }
  }

  void read_group_of_objects(Element element) {
    Group group;
    const SourceLocation location = element.location();
    group.line = location.line;
    group.column = location.column;
    refuse_attributes(element, {}, diagnostics_);
    objects_ = &group.objects;
    object_names_ = {};
    Reference name;
    for (Node node = element.first_child(); node; node = node.next()) {
      if (refuse_text(node, element, diagnostics_)) continue;
      const Element child = node.element();
      if (child.name() == "name") {
        if (name.name.empty() && read_value(child, {"name"}, &name, file_->context)) group.name = name.name;
      } else if (child.name() == ObjectsSection::element) {
        read_section<ObjectsSection>(child);
      } else {
        refuse_unknown(child, group_element);
      }
    }
    report_taken(ObjectsSection::item, object_names_);
    objects_ = &scene_.objects;
    groups_complete_ = groups_complete_ && !group.name.empty();
    if (!element.child("name"))
      diagnostics_.error(element, [&] { return "missing <name> in <group>; add <name>...</name>"; });
    const auto [first, is_first] = group_lines_.try_emplace(group.name, group.line);
    if (!is_first && !group.name.empty())
      diagnostics_.error(location_of(name), "the group name " + in_quotes(group.name) + " is taken by the <group> in " +
                                                diagnostics_.line_name(first->second, name.line) + "; choose another");
    scene_.groups.push_back(std::move(group));
  }

  /// Of the scene, or of the group at hand.
  template <class Section, class T>
  auto& items() {
    if constexpr (std::is_same_v<Section, ObjectsSection>)
      return std::get<ObjectItems<T>>(*objects_);
    else
      return items_of<Section, T>(scene_);
  }

  template <class Section>
  void read_section(Element section) {
    refuse_attributes(section, {}, diagnostics_);
    for (Node node = section.first_child(); node; node = node.next()) {
      if (refuse_text(node, section, diagnostics_)) continue;
      const Element child = node.element();
      bool found = false;
      for_each_type(typename Section::Types{}, [&]<class T>(std::type_identity<T>) {
        if (found || child.name() != (T::group.empty() ? T::element : T::group)) return;
        found = true;
        if constexpr (T::group.empty())
          read_only_item<Section, T>(child);
        else
          read_group<Section, T>(child);
      });
      if (!found) refuse_unknown(child, Section::element);
    }
  }

  /// Of a type that a scene has one item of, which stands in the section itself.
  template <class Section, class T>
  void read_only_item(Element element) {
    if (!is_first(T::element, element)) return;
    TypedItemList<Section, T> items(names_);
    items.read(element, 0, file_->context);
    store<Section, T>(items.entries().front(), {});
  }

  template <class Section, class T>
  void read_group(Element group) {
    constexpr bool is_object = std::is_same_v<Section, ObjectsSection>;
    if (is_object && only_ != nullptr && !only_->contains(T::element)) return;
    using Items = TypedItemList<Section, T>;
    refuse_attributes(group, {}, diagnostics_);
    // What stands before the first item; that one and the rest are in the chunks.
    for (Node node = group.first_child(); node; node = node.next()) refuse_text(node, group, diagnostics_);
    const std::size_t elements = file_->text.chunks_of(group.offset()).items;
    reserve_more(items<Section, T>(), elements);
    std::size_t read_elements = 0;
    read_items(
        {file_->text, file_->context.variables, file_->context.folder, group, T::element}, arena_, diagnostics_,
        [&] { return std::make_unique<Items>(names_); },
        [&](std::size_t chunk, ItemList& items) {
          for (auto& entry : static_cast<Items&>(items).entries()) {
            ++read_elements;
            store<Section, T>(entry, {static_cast<std::uint32_t>(file_->first_chunk + chunk), entry.number});
          }
        });
    if constexpr (is_named<Section>)
      if (read_elements < elements) named<Section>().complete = false;
    if (is_object && variables_.moment_was_asked() && may_have_keys(*file_, group)) keyed_.insert(T::element);
  }

  template <class Section>
  static constexpr bool is_named =
      std::is_same_v<Section, TexturesSection> || std::is_same_v<Section, MaterialsSection>;
  template <class Section>
  NamedItems& named() {
    return std::is_same_v<Section, TexturesSection> ? names_.textures : names_.materials;
  }

  template <class Section, class T>
  void store(typename TypedItemList<Section, T>::Entry& entry, ItemPosition position) {
    auto& items = this->items<Section, T>();
    if constexpr (is_named<Section>) {
      // A faulty one keeps its name, so that what uses it is not reported too.
      NamedItems& all = named<Section>();
      all.complete = all.complete && !entry.item.name.empty();
      if (!entry.item.name.empty()) {
        all.names.add(entry.item.name, position);
        all.references.push_back({static_cast<std::uint32_t>(index_of<T>(typename Section::Types{})),
                                  static_cast<std::uint32_t>(items.size())});
      }
    }
    if constexpr (std::is_same_v<Section, ObjectsSection>)
      if (!entry.item.name.empty()) object_names_.add(entry.item.name, position);
    if (entry.usable) items.push_back(std::move(entry.item));
  }

  /// One slip, one message: what was only misspelt, or is in the wrong element, is not reported as missing, too.
  void refuse_unknown(Element child, std::string_view parent) {
    if (parent == groups_element) groups_complete_ = false;
    if (diagnostics_.keeps_another(Severity::error)) {
      const std::string_view meant = meant_element(child.name(), parent);
      bool is_camera = false;
      for_each_type(Cameras{}, [&]<class T>(std::type_identity<T>) { is_camera |= meant == T::element; });
      firsts_.try_emplace(is_camera ? camera_key : meant);
      if (meant == Include::element) expect_anything();
      for (NamedItems* const all : {&names_.textures, &names_.materials})
        if (parent == all->section || belongs_to_section(meant, all->section)) all->complete = false;
    }
    diagnostics_.error(child, [&] { return explain_misplaced(child.name(), parent); });
  }

  template <class Items>
  static void reserve_more(Items& items, std::size_t more) {
    const std::size_t count = items.size() + more;
    // No less than vectors grow by themselves: there may be a million groups of one item each.
    if (count > items.capacity()) items.reserve(std::max(count, 2 * items.capacity()));
  }

  /// For elements that a scene has once: remembers the first and reports the others.
  bool is_first(std::string_view key, Element element) {
    Element& first = firsts_[key];
    if (!first) {
      first = element;
      return true;
    }
    diagnostics_.error(element, [&] {
      return "a second " + tag(element.name()) + "; a scene has one, and the first is in " +
             diagnostics_.line_name(first.line(), element.line());
    });
    return false;
  }

  void report_taken(std::string_view what, NameTable& names) {
    std::unique_ptr<Document> first_document, other_document;
    names.finish(
        arena_.max_concurrency(), [&](std::string_view name, ItemPosition first_position, ItemPosition other_position) {
          if (!diagnostics_.keeps_another(Severity::error)) return diagnostics_.error({}, {});
          const Element first = files_.item_at(first_position, first_document);
          const Element other = files_.item_at(other_position, other_document);
          diagnostics_.error(other.child("name").first_child(), [&] {
            return "the " + std::string(what) + " name " + in_quotes(name) + " is taken by the " + tag(first.name()) +
                   " in " + diagnostics_.line_name(first.line(), other.line()) + "; choose another";
          });
        });
  }

  const Variables& variables_;
  Diagnostics& diagnostics_;
  const KeyedObjects* only_;
  KeyedObjects keyed_;
  SceneFiles files_;
  const SceneFile* file_ = nullptr;  // at hand
  tbb::task_arena arena_;
  SceneDescription scene_;
  std::map<std::string_view, Element> firsts_;  // by key; false for what was meant by an element that was refused
  std::vector<LaterSection> material_sections_, object_sections_, group_sections_;
  SceneNames names_;
  NameTable object_names_;                  // of the scene, or of the group at hand
  ObjectLists* objects_ = &scene_.objects;  // likewise
  std::map<std::string, std::uint32_t> group_lines_;
  bool groups_complete_ = true;  // false: one was refused before its name was read
};

}  // namespace

ReadScene read_scene(TextBuffer text, const std::string& file, Diagnostics& diagnostics, int threads,
                     const SceneSettings& settings, const KeyedObjects* only) {
  const Variables variables(settings);
  SceneReader reader(variables, diagnostics, threads, only);
  reader.read(std::move(text), file);
  // Where there are errors, not all that stands in the scene has been read.
  if (only == nullptr && !diagnostics.has_errors())
    for (const std::string_view name : variables.unused())
      diagnostics.error({},
                        "no value of the scene uses $" + printable(name) + "; remove -D " + printable(name) + "=...");
  return reader.take();
}

}  // namespace raytrace
