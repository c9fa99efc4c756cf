#include "raytrace/description/check_scene.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "raytrace/description/check_environment.h"
#include "raytrace/description/check_fibres.h"
#include "raytrace/description/check_fogs.h"
#include "raytrace/description/check_groups.h"
#include "raytrace/description/check_mesh_data.h"
#include "raytrace/description/motion.h"
#include "raytrace/description/parse_value.h"
#include "raytrace/description/read_fields.h"
#include "raytrace/description/read_transform.h"
#include "raytrace/description/scene_layout.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

class SceneChecker {
 public:
  explicit SceneChecker(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  void check(const SceneDescription& scene) {
    check_groups(scene, diagnostics_);
    check_environment(scene, diagnostics_);
    check_fogs(scene, diagnostics_);
    check_fibres(scene, diagnostics_);
    for (const Group& group : scene.groups) {
      location_ = location_of(group);
      item_ = {group_element, static_cast<std::size_t>(&group - scene.groups.data())};
      check_field("name", group.name, Range::any);
      for_each_type(Objects{}, [&]<class T>(std::type_identity<T>) {
        std::size_t i = 0;
        for (const auto& item : std::get<ObjectItems<T>>(group.objects)) {
          item_ = {T::element, i++};
          location_ = location_of(item);
          check_references(scene, item);
          check_values<T>(item, true);
        }
      });
    }

    check_moments(scene);
    for_each_single(scene,
                    [&]<class T>(std::type_identity<T>, const auto& parameters) { check_single<T>(parameters); });
    for_each_item_type([&]<class Section, class T>(std::type_identity<Section>, std::type_identity<T>) {
      std::size_t i = 0;
      for (const auto& item : items_of<Section, T>(scene)) {
        item_ = {T::element, i++};
        location_ = location_of(item);
        if (T::group.empty() && i > 1) error("is a second one; a scene has one");
        check_labels<Section>(scene, item);
        if constexpr (requires {
                        item.image;
                        item.parameters.file;
                      })
          if (!item.parameters.file.path.empty() && item.image.hash.empty())
            error("has a file that has not been loaded (load_images.h)");
        if constexpr (requires { item.photometry; })
          if (!item.parameters.iesfile.path.empty() && item.photometry.hash.empty())
            error("has an IES file that has not been loaded (load_images.h)");
        check_values<T>(item, Section::may_skip);
      }
    });
  }

  /// Of the view plane or a camera.
  template <class T>
  void check_single(const typename T::Parameters& parameters) {
    item_ = {T::element, std::nullopt};
    location_ = {};
    check_parameters(element_type<T>(), &parameters, false);
  }

 private:
  struct ItemName {
    std::string_view element;
    std::optional<std::size_t> index;

    std::string text() const {
      return tag(element) + (index ? " [" + std::to_string(*index) + "]" : "");
    }  // <sphere> [2]
  };

  /// Parameters and their textures.
  template <class T, class Item>
  void check_values(const Item& item, bool may_skip) {
    if constexpr (requires { item.textures; }) check_textured_fields(element_type<T>().fields, item.textures);
    if (!check_parameters(element_type<T>(), &item.parameters, may_skip)) return;
    report_warnings(
        element_type<T>(), &item.parameters, [&](std::string_view field) { return is_textured<T>(item, field); },
        [&](const ParameterWarning& warning) {
          diagnostics_.warning(location_, item_.text() + ": " + warning.message);
        });
  }

  void error(const std::string& message) { diagnostics_.error(location_, item_.text() + " " + message); }

  template <class Section, class Item>
  void check_labels(const SceneDescription& scene, const Item& item) {
    if constexpr (requires { item.name; }) {
      if (Section::labels[0].required || !item.name.empty()) {
        check_field("name", item.name, Range::any);
        check_taken<Section>(item.name);
      }
    }
    check_references(scene, item);
  }

  void check_moment_count(std::size_t moments) {
    if (moments != 0 && moments != shutter_moments)
      error("moves, with " + std::to_string(moments) + " moments; it takes " + std::to_string(shutter_moments) +
            " (motion.h), or none");
  }

  /// Of a camera that moves while the shutter is open.
  void check_moments(const SceneDescription& scene) {
    item_ = {"camera", std::nullopt};
    location_ = scene.camera_location;
    check_moment_count(scene.moving_camera.size());
    for (const CameraParameters& moment : scene.moving_camera) {
      if (moment.index() != scene.camera.index())
        return error("is of another type at a moment of its motion than at rest");
      visit_one_of(Cameras{}, moment, [&]<class T>(std::type_identity<T>, const auto& parameters) {
        item_ = {T::element, std::nullopt};
        check_parameters(element_type<T>(), &parameters, false);
      });
    }
  }

  void check_transform(const Transform& transform) {
    bool fine = true;
    for (const TransformStep& step : transform.steps) {
      if (const OptionalMessage message = check_step(step)) {
        fine = false;
        error("has a transform whose " + tag(TransformStep::elements[step.type]) + " " + *message);
      }
    }
    if (!fine || transform.empty()) return;
    if (const OptionalMessage message = check_affine(transform.affine())) error("has a transform that " + *message);
  }

  void check_data(const ObjectItem<Mesh>& mesh) {
    if (const OptionalMessage message = check_mesh_data(*mesh.data, mesh.materials.size()))
      error("has data that " + *message);
  }

  void check_data(const ObjectItem<SphereCloud>& cloud) {
    if (const OptionalMessage message = check_point_cloud(*cloud.data)) return error("has data that " + *message);
    if (cloud.data->radii.empty() && cloud.parameters.radius < smallest_size)
      error("has data without radii; set its <radius>");
  }

  void check_data(const ObjectItem<Curve>& curve) {
    if (const OptionalMessage message = check_curve_data(*curve.data)) error("has data that " + *message);
  }

  template <class Item>
  void check_references(const SceneDescription& scene, const Item& item) {
    if constexpr (requires { item.transform; }) check_transform(item.transform);
    if constexpr (requires { item.motion; }) {
      check_moment_count(item.motion.size());
      for (const Affine& affine : item.motion)
        if (const OptionalMessage message = check_affine(affine)) error("has a motion that " + *message);
    }
    if constexpr (requires { item.materials; }) {
      if (item.material != no_material) check_reference<MaterialsSection>(scene, item.material);
      if (item.data == nullptr || item.materials.empty()) return error("has not been loaded (load_meshes())");
      for (const MaterialReference& material : item.materials) check_reference<MaterialsSection>(scene, material);
      check_data(item);
    } else if constexpr (std::is_same_v<Item, ObjectItem<Model>>) {
      error("has not been loaded (load_meshes())");
    } else if constexpr (std::is_same_v<Item, ObjectItem<Instance>>) {
      if (item.material != no_material) check_reference<MaterialsSection>(scene, item.material);
    } else if constexpr (requires { item.material; }) {
      check_reference<MaterialsSection>(scene, item.material);
    }
    if constexpr (requires { item.grid; })
      if (!item.parameters.densityfile.path.empty() && !item.grid.grid)
        error("has a <densityfile> that has not been loaded (load_images())");
    if constexpr (requires { item.textures; })
      for (const TextureUse& use : item.textures) check_reference<TexturesSection>(scene, use.texture);
  }

  template <class T, class Item>
  static bool is_textured(const Item& item, std::string_view field) {
    if constexpr (requires { item.textures; }) {
      const Fields& fields = element_type<T>().fields;
      return std::any_of(item.textures.begin(), item.textures.end(), [&](const TextureUse& use) {
        return use.field < fields.size() && fields[use.field].name == field;
      });
    }
    return false;
  }

  /// Whether they are fine.
  bool check_parameters(const ElementType& type, const void* parameters, bool may_skip) {
    const std::size_t errors_before = diagnostics_.error_count();
    for (const Field& field : type.fields)
      field.visit(parameters, [&](const auto& value) { check_field(field.name, value, field.range); });
    if (diagnostics_.error_count() > errors_before) return false;
    return check_together(type, parameters, may_skip, [&](Severity severity, const std::string& message) {
      diagnostics_.add(severity, location_, item_.text() + ": " + message);
    });
  }

  template <class Value>
  void check_field(std::string_view name, const Value& value, Range range) {
    if constexpr (HasComponents<Value>) {
      for (const auto member : Components<Value>::members) check_field(name, value.*member, range_of_components(range));
    } else if (const OptionalMessage message = check_value(value, range)) {
      error("has " + in_quotes(value_text(value)) + " as " + tag(name) + ", which " + *message);
    }
    if constexpr (std::is_same_v<Value, Vec3d>)
      if (range == Range::nonzero && !is_direction(value))
        error("has a " + tag(name) + " of length 0; it is a direction");
  }

  template <class Section>
  void check_taken(std::string_view name) {
    const auto [bearer, added] = names_[Section::element].try_emplace(name, item_);
    if (added) return;
    error("has the " + std::string(Section::item) + " name " + in_quotes(name) + " of " + bearer->second.text() +
          "; choose another");
  }

  template <class Section>
  void check_reference(const SceneDescription& scene, const ItemReference& item) {
    using Types = typename Section::Types;
    const bool is_type = item.type < Types::size;
    const std::size_t count =
        is_type ? with_type(Types{}, item.type,
                            [&]<class T>(std::type_identity<T>) { return items_of<Section, T>(scene).size(); })
                : 0;
    if (item.index < count) return;
    error("refers to " + std::string(Section::item) + " " + std::to_string(item.index) + " of type " +
          std::to_string(item.type) + ", which is not there" + (is_type ? "" : "; nor is that type"));
  }

  /// Each a number or a colour, and none twice.
  void check_textured_fields(const Fields& fields, const std::vector<TextureUse>& uses) {
    std::vector<bool> textured(fields.size());
    for (const TextureUse& use : uses) {
      const bool fine = use.field < fields.size() && !textured[use.field] && fields[use.field].may_be_textured();
      if (!fine)
        error("has a texture for field " + std::to_string(use.field) + ", which takes none, or has another");
      else
        textured[use.field] = true;
      if (use.channel > TextureChannel::automatic ||
          (use.channel == TextureChannel::automatic && !(fine && fields[use.field].prefers_alpha)))
        error("has a texture of channel " + std::to_string(static_cast<int>(use.channel)) + "; there are 4");
    }
  }

  Diagnostics& diagnostics_;
  ItemName item_;  // at hand
  SourceLocation location_;
  /// Of each section, each with its bearer.
  std::map<std::string_view, std::map<std::string_view, ItemName>> names_;
};

void throw_errors(const Diagnostics& diagnostics) {
  if (!diagnostics.has_errors()) return;
  std::ostringstream printed;
  diagnostics.print(printed);
  std::string text = printed.str();
  text.pop_back();  // the last line's end
  throw SceneError(text);
}

}  // namespace

void check_scene(const SceneDescription& scene, Diagnostics& diagnostics) { SceneChecker(diagnostics).check(scene); }

void require_good_scene(const SceneDescription& scene) {
  Diagnostics diagnostics(scene.file.empty() ? "scene" : scene.file);
  diagnostics.add_files(scene.included);
  check_scene(scene, diagnostics);
  throw_errors(diagnostics);
}

void require_good_viewplane(const ViewPlane& viewplane) {
  Diagnostics diagnostics("scene");
  SceneChecker(diagnostics).check_single<ViewPlane>(viewplane);
  throw_errors(diagnostics);
}

}  // namespace raytrace
