#include "raytrace/description/scene_hash.h"

#include <type_traits>

#include "raytrace/math/content_hash.h"

namespace raytrace {

namespace {

class SceneHash {
 public:
  std::string of(const SceneDescription& scene) {
    Fields<ViewPlane> viewplane_fields = ViewPlane::fields();
    std::erase_if(viewplane_fields, [](const auto& field) { return field.name == "samples"; });
    add_parameters(viewplane_fields, scene.viewplane);
    for_each_type(Cameras{}, [&]<class Camera>(std::type_identity<Camera>) {
      if (const auto* parameters = std::get_if<typename Camera::Parameters>(&scene.camera)) {
        add(Camera::element);
        add_parameters(Camera::fields(), *parameters);
      }
    });
    add_items(Lights{}, scene.lights, [](const auto&) {});
    add_items(Materials{}, scene.materials, [&](const auto& item) { add(item.name); });
    add_items(Shapes{}, scene.objects, [&](const auto& item) {
      add(item.name);
      add(item.material.kind);
      add(item.material.index);
    });
    return hash_.digits();
  }

 private:
  template <class List, class Tuple, class AddOthers>
  void add_items(List list, const Tuple& tuple, AddOthers add_others) {
    for_each_type(list, [&]<class T>(std::type_identity<T>) {
      const auto& items = std::get<index_of<T>(List{})>(tuple);
      add(T::element);
      add(static_cast<std::uint64_t>(items.size()));
      const auto fields = T::fields();
      for (const auto& item : items) {
        add_parameters(fields, item.parameters);
        add_others(item);
      }
    });
  }

  template <class Parameters>
  void add_parameters(const Fields<Parameters>& fields, const Parameters& parameters) {
    for (const auto& field : fields) std::visit([&](auto member) { add(parameters.*member); }, field.member);
  }

  void add(std::string_view text) {
    add(static_cast<std::uint64_t>(text.size()));
    hash_.add(text.data(), text.size());
  }
  void add(const std::string& text) { add(std::string_view(text)); }
  void add(const Vec3d& v) {
    for (const double value : {v.x, v.y, v.z}) add(value);
  }
  void add(const Rgb<double>& color) {
    for (const double value : {color.red, color.green, color.blue}) add(value);
  }
  template <class Number>
    requires std::is_arithmetic_v<Number>
  void add(Number number) {
    number += Number(0);  // -0 is 0
    hash_.add(&number, sizeof number);
  }

  ContentHash hash_;
};

}  // namespace

std::string scene_hash(const SceneDescription& description) { return SceneHash().of(description); }

}  // namespace raytrace
