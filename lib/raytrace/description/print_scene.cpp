#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>

#include "raytrace/description/parse_value.h"
#include "raytrace/description/scene_description.h"
#include "raytrace/description/scene_layout.h"
#include "raytrace/description/variables.h"

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
      default:
        result += c;
    }
  }
  return result;
}

class ScenePrinter {
 public:
  std::string print(const SceneDescription& scene) {
    open(root_element);
    print_element<ViewPlane>(ViewPlane::element, scene.viewplane, {}, {});
    std::size_t camera = 0;
    for_each_type(Cameras{}, [&]<class Camera>(std::type_identity<Camera>) {
      if (camera++ != scene.camera.index()) return;
      print_element<Camera>(Camera::element, *std::get_if<index_of<Camera>(Cameras{})>(&scene.camera), {}, {});
    });
    print_section(lights_element, Lights{}, scene.lights, [&]<class T>(std::type_identity<T>, const auto& item) {
      print_element<T>(T::element, item.parameters, {}, {});
    });
    print_section(materials_element, Materials{}, scene.materials,
                  [&]<class T>(std::type_identity<T>, const auto& item) {
                    print_element<T>(T::element, item.parameters, item.name, {});
                  });
    print_section(objects_element, Shapes{}, scene.objects, [&]<class T>(std::type_identity<T>, const auto& item) {
      print_element<T>(T::element, item.parameters, item.name, material_name(scene, item.material));
    });
    close(root_element);
    return std::move(text_);
  }

 private:
  static std::string_view material_name(const SceneDescription& scene, MaterialReference reference) {
    std::string_view name;
    for_each_type(Materials{}, [&]<class T>(std::type_identity<T>) {
      constexpr std::size_t kind = index_of<T>(Materials{});
      if (kind == reference.kind) name = std::get<kind>(scene.materials).at(reference.index).name;
    });
    return name;
  }

  template <class List, class Tuple, class PrintItem>
  void print_section(std::string_view section, List list, const Tuple& tuple, PrintItem print_item) {
    open(section);
    for_each_type(list, [&]<class T>(std::type_identity<T> type) {
      const auto& items = std::get<index_of<T>(List{})>(tuple);
      if (items.empty()) return;
      if (!T::group.empty()) open(T::group);
      for (const auto& item : items) print_item(type, item);
      if (!T::group.empty()) close(T::group);
    });
    close(section);
  }

  template <class T>
  void print_element(std::string_view element, const typename T::Parameters& parameters, std::string_view name,
                     std::string_view material) {
    open(element);
    if (!name.empty()) print_value("name", name);
    for (const auto& field : T::fields()) {
      std::visit([&](auto member) { print_value(field.name, parameters.*member); }, field.member);
    }
    if (!material.empty()) print_value("material", material);
    close(element);
  }

  void print_value(std::string_view name, double value) { print_leaf(name, number_text(value)); }
  void print_value(std::string_view name, int value) { print_leaf(name, std::to_string(value)); }
  void print_value(std::string_view name, bool value) { print_leaf(name, value ? "true" : "false"); }
  void print_value(std::string_view name, std::string_view value) { print_leaf(name, escaped(value)); }
  void print_value(std::string_view name, const std::string& value) { print_value(name, std::string_view(value)); }
  void print_value(std::string_view name, const Vec3d& value) {
    print_attributes(name, {{{"x", value.x}, {"y", value.y}, {"z", value.z}}});
  }
  void print_value(std::string_view name, const Rgb<double>& value) {
    print_attributes(name, {{{"red", value.red}, {"green", value.green}, {"blue", value.blue}}});
  }

  void print_leaf(std::string_view name, std::string_view value) {
    indent();
    text_.append("<").append(name).append(">").append(value).append("</").append(name).append(">\n");
  }

  void print_attributes(std::string_view name, const std::array<std::pair<std::string_view, double>, 3>& components) {
    indent();
    text_.append("<").append(name);
    for (const auto& [component, value] : components) {
      text_.append(" ").append(component).append("=\"").append(number_text(value)).append("\"");
    }
    text_.append("/>\n");
  }

  void open(std::string_view name) {
    indent();
    text_.append("<").append(name).append(">\n");
    ++depth_;
  }

  void close(std::string_view name) {
    --depth_;
    indent();
    text_.append("</").append(name).append(">\n");
  }

  void indent() { text_.append(2 * depth_, ' '); }

  std::string text_;
  std::size_t depth_ = 0;
};

}  // namespace

std::string print_scene(const SceneDescription& scene) { return ScenePrinter().print(scene); }

}  // namespace raytrace
