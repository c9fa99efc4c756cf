#include "raytrace/description/warn_of_materials.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "raytrace/description/parse_value.h"
#include "raytrace/text/message.h"

namespace raytrace {
namespace {

class MaterialWarner {
 public:
  MaterialWarner(const SceneDescription& scene, Diagnostics& diagnostics) : scene_(scene), diagnostics_(diagnostics) {}

  void warn() {
    for (const auto& item : std::get<MaterialItems<Matte>>(scene_.materials))
      check_reflectance(item, "kd", item.parameters.kd, "cd", item.parameters.cd);
    for (const auto& item : std::get<MaterialItems<Phong>>(scene_.materials))
      check_reflectance(item, "kd", item.parameters.kd, "cd", item.parameters.cd);
    for (const auto& item : std::get<MaterialItems<OpenPbr>>(scene_.materials)) {
      check_reflectance(item, "base_weight", item.parameters.base_weight, "base_color", item.parameters.base_color);
      check_film(item);
    }
    check_fogs(scene_.objects);
    for (const Group& group : scene_.groups) check_fogs(group.objects);
  }

 private:
  template <class Item>
  void check_reflectance(const Item& item, std::string_view weight_name, double weight, std::string_view color_name,
                         const Rgb<double>& color) {
    const double most = weight * std::max({color.red, color.green, color.blue});
    // 0.7 times 1 / 0.7 is fine.
    if (most <= 1 + 1e-6) return;
    diagnostics_.warning({item.line, 0}, tag(weight_name) + " times " + tag(color_name) + " of the material " +
                                             in_quotes(item.name) + " is " + formatted("%.4g", most) +
                                             ", above 1: light grows where it is reflected");
  }

  void check_film(const MaterialItem<OpenPbr>& item) {
    constexpr double thickest = 20;  // none with colours is thicker
    const double thickness = item.parameters.thin_film_thickness;
    if (thickness > thickest)
      diagnostics_.warning({item.line, 0}, "<thin_film_thickness> of the material " + in_quotes(item.name) +
                                               " is in micrometres: " + number_text(thickness) + " nanometres are " +
                                               number_text(thickness / 1000));
  }

  /// Triangles, rectangles and open cylinders may be parts of what is closed.
  void check_fogs(const ObjectLists& objects) {
    check_fogs<Plane>(objects);
    check_fogs<Disk>(objects);
  }
  template <class Shape>
  void check_fogs(const ObjectLists& objects) {
    for (const auto& item : std::get<ObjectItems<Shape>>(objects))
      if (item.material.type == index_of<Fog>(Materials{}))
        diagnostics_.warning({item.line, 0},
                             "a <fog> on a " + tag(Shape::element) +
                                 ", which has no inside; fill an object with it that is closed, such as a <box>");
  }

  const SceneDescription& scene_;
  Diagnostics& diagnostics_;
};

}  // namespace

void warn_of_materials(const SceneDescription& scene, Diagnostics& diagnostics) {
  MaterialWarner(scene, diagnostics).warn();
}

}  // namespace raytrace
