#include <map>
#include <string>
#include <string_view>
#include <type_traits>

#include "raytrace/description/read_transform.h"
#include "raytrace/description/read_value.h"
#include "raytrace/description/scene_description.h"
#include "raytrace/description/scene_layout.h"
#include "raytrace/xml/xml_writer.h"

namespace raytrace {
namespace {

/// The text with what XML would take for markup written as entities, and what the reader would take for a variable as a
/// dollar.
std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : with_dollars_doubled(text)) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

class ScenePrinter : private XmlWriter {
 public:
  std::string print(const SceneDescription& scene) {
    element(root_element, [&] {
      for_each_single(scene, [&]<class T>(std::type_identity<T>, const auto& parameters) {
        const auto print = [&] { element(T::element, [&] { print_parameters(element_type<T>(), &parameters); }); };
        if constexpr (has_type<T>(Integrators{}))
          element(integrator_element, print);
        else
          print();
      });
      for_each_type(Sections{}, [&]<class Section>(std::type_identity<Section>) {
        print_section<Section>(scene, scene.*Section::items);
      });
      if (!scene.groups.empty()) element(groups_element, [&] { print_groups(scene); });
    });
    return take();
  }

 private:
  template <class Section, class Lists>
  void print_section(const SceneDescription& scene, const Lists& lists) {
    element(Section::element, [&] {
      for_each_type(typename Section::Types{}, [&]<class T>(std::type_identity<T>) {
        print_group<T>(scene, std::get<index_of<T>(typename Section::Types{})>(lists));
      });
    });
  }

  void print_groups(const SceneDescription& scene) {
    for (const Group& group : scene.groups)
      element(group_element, [&] {
        print_value("name", group.name);
        print_section<ObjectsSection>(scene, group.objects);
      });
  }

  template <class T, class Items>
  void print_group(const SceneDescription& scene, const Items& items) {
    const auto print_items = [&] {
      for (const auto& item : items)
        if (!is_imported(item)) element(T::element, [&] { print_item<T>(scene, item); });
    };
    if (T::group.empty())
      print_items();
    else if (!items.empty())
      element(T::group, print_items);
  }

  template <class Item>
  static bool is_imported(const Item& item) {
    if constexpr (requires { item.imported; }) return item.imported;
    return false;
  }

  template <class T, class Item>
  void print_item(const SceneDescription& scene, const Item& item) {
    if constexpr (requires { item.name; })
      if (!item.name.empty()) print_value("name", item.name);
    if constexpr (requires { item.textures; })
      print_parameters(element_type<T>(), &item.parameters,
                       texture_attributes(scene, element_type<T>().fields, item.textures));
    else
      print_parameters(element_type<T>(), &item.parameters);
    if constexpr (requires { item.transform; })
      if (!item.transform.empty()) print_transform(item.transform);
    if constexpr (requires { item.material; })
      if (item.material != no_material) print_value("material", name_of<MaterialsSection>(scene, item.material));
    if constexpr (requires { item.shadowcatcher; }) {
      if (item.shadowcatcher) print_value(shadowcatcher_element, true);
      if (!item.visible) print_value(visible_element, false);
    }
  }

  void print_transform(const Transform& transform) {
    element(transform_element, [&] {
      for (const TransformStep& step : transform.steps) {
        const std::string_view name = TransformStep::elements[step.type];
        const auto attributes = step_attributes(step.type);
        std::string text = "<" + std::string(name);
        for (std::size_t i = 0; i < attributes.size(); ++i)
          text.append(" ").append(attributes[i]).append("=\"").append(number_text(step.values[i])).append("\"");
        if (attributes.empty()) {
          text += ">";
          for (const double value : step.values) text.append(text.back() == '>' ? "" : " ").append(number_text(value));
          text += closing_tag(name);
        } else {
          text += "/>";
        }
        line(text);
      }
    });
  }

  template <class Section>
  static std::string name_of(const SceneDescription& scene, ItemReference item) {
    return with_type(typename Section::Types{}, item.type,
                     [&]<class T>(std::type_identity<T>) { return items_of<Section, T>(scene).at(item.index).name; });
  }

  /// By field.
  using AttributeTexts = std::map<std::size_t, std::string>;

  static AttributeTexts texture_attributes(const SceneDescription& scene, const Fields& fields,
                                           const std::vector<TextureUse>& textures) {
    AttributeTexts attributes;
    for (const TextureUse& use : textures) {
      std::string& text = attributes[use.field];
      const auto add = [&](std::string_view name, std::string_view value) {
        text.append(" ").append(name).append("=\"").append(value).append("\"");
      };
      add(texture_attribute, escaped(name_of<TexturesSection>(scene, use.texture)));
      if (use.channel != channel_of(fields[use.field], TextureChannel::automatic))
        add(channel_attribute, Choices<TextureChannel>::words[static_cast<std::size_t>(use.channel)]);
    }
    return attributes;
  }

  void print_parameters(const ElementType& type, const void* parameters, const AttributeTexts& attributes = {}) {
    const Fields& fields = type.fields;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      const auto more = attributes.find(i);
      fields[i].visit(parameters, [&](const auto& value) {
        if (fields[i].is_of_texture())
          print_number_of_texture(fields[i], value, more != attributes.end() ? more->second : std::string());
        else if (!is_absent(value))
          print_value(fields[i].name, value, more != attributes.end() ? more->second : std::string());
      });
    }
  }

  void print_number_of_texture(const FieldInfo& info, double value, const std::string& texture) {
    if (texture.empty()) return;
    const std::string number = std::string(info.number_attribute) + "=\"" + number_text(value) + "\"";
    line("<" + std::string(info.name) + texture + (info.number_attribute.empty() ? "" : " " + number) + "/>");
  }
  template <class Value>
  void print_number_of_texture(const FieldInfo&, const Value&, const std::string&) {}

  // No element is written without a value.
  static bool is_absent(const FileName& value) { return value.path.empty(); }
  static bool is_absent(const Reference& value) { return value.name.empty(); }
  static bool is_absent(const NumberGroups& value) { return value.empty(); }
  template <class Value>
  static bool is_absent(const Value&) {
    return false;
  }

  template <class Value>
  void print_value(std::string_view name, const Value& value, const std::string& attributes = {}) {
    std::string text = "<" + std::string(name);
    if constexpr (HasComponents<Value>) {
      using Parts = Components<Value>;
      for (std::size_t i = 0; i < Parts::names.size(); ++i)
        text.append(" ")
            .append(Parts::names[i])
            .append("=\"")
            .append(number_text(value.*Parts::members[i]))
            .append("\"");
      text += attributes + "/>";
    } else {
      text.append(attributes).append(">").append(escaped(value_text(value))).append("</").append(name).append(">");
    }
    line(text);
  }
};

}  // namespace

std::string print_scene(const SceneDescription& scene) { return ScenePrinter().print(scene); }

}  // namespace raytrace
