#include "raytrace/description/motion.h"

#include <algorithm>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace raytrace {

namespace {

template <class Value>
bool is_same(const Value& a, const Value& b) {
  if constexpr (HasComponents<Value>)
    return std::all_of(Components<Value>::members.begin(), Components<Value>::members.end(),
                       [&](const auto member) { return a.*member == b.*member; });
  else
    return a == b;
}

/// Where the values are written does not count.
bool have_same_values(const Fields& fields, const void* a, const void* b) {
  return std::all_of(fields.begin(), fields.end(), [&](const Field& field) {
    const FieldValue of_a = field.value(const_cast<void*>(a)), of_b = field.value(const_cast<void*>(b));
    return std::visit(
        [&]<class Any>(const Any& value) {
          const Any& other = std::get<Any>(of_b);
          if constexpr (std::is_same_v<Any, ChoiceReference>)
            return value.index() == other.index();
          else
            return is_same(*value, *other);
        },
        of_a);
  });
}

/// By what all points of `to` lie beside those of `from`; nothing if not all do, or other values differ.
std::optional<Vec3d> shift_between(const Fields& fields, const void* from, const void* to) {
  std::optional<Vec3d> shift;
  double size = 0;
  for (const Field& field : fields) {
    if (!field.is_point) {
      if (!have_same_values({field}, from, to)) return std::nullopt;
      continue;
    }
    const Vec3d a = field.get<Vec3d>(const_cast<void*>(from)), b = field.get<Vec3d>(const_cast<void*>(to));
    size = std::max({size, length(a), length(b)});
    if (!shift) shift = b - a;
    // Keys round each point by itself.
    if (length(b - a - *shift) > 1e-12 * size) return std::nullopt;
  }
  return shift.value_or(Vec3d{0, 0, 0});
}

/// The same list of any scene.
using ListsOf = const ObjectLists& (*)(const SceneDescription& scene, std::size_t group);

class MotionFinder {
 public:
  MotionFinder(SceneDescription& scene, const std::vector<SceneDescription>& moments, Diagnostics& diagnostics)
      : scene_(scene), moments_(moments), diagnostics_(diagnostics) {}

  void find() {
    set_camera();
    const std::size_t groups = scene_.groups.size();
    add_objects(scene_.objects, 0,
                [](const SceneDescription& scene, std::size_t) -> const ObjectLists& { return scene.objects; });
    for (std::size_t group = 0; group < groups; ++group) {
      // Where groups are added, those before move.
      ObjectLists lists = std::move(scene_.groups[group].objects);
      add_objects(lists, group, [](const SceneDescription& scene, std::size_t i) -> const ObjectLists& {
        return scene.groups[i].objects;
      });
      scene_.groups[group].objects = std::move(lists);
    }
    warn_of_others();
  }

 private:
  void set_camera() {
    std::visit(
        [&]<class Parameters>(const Parameters& camera) {
          bool moves = false;
          for (const SceneDescription& moment : moments_) {
            const auto* then = std::get_if<Parameters>(&moment.camera);
            moves = moves || (then != nullptr && !have_same_values(fields_of(camera), &camera, then));
          }
          if (!moves) return;
          for (const SceneDescription& moment : moments_) scene_.moving_camera.push_back(moment.camera);
        },
        scene_.camera);
  }
  template <class Parameters>
  static const Fields& fields_of(const Parameters& /*of the type*/) {
    static const Fields fields = [] {
      Fields found;
      for_each_type(Cameras{}, [&]<class Camera>(std::type_identity<Camera>) {
        if constexpr (std::is_same_v<typename Camera::Parameters, Parameters>) found = Camera::fields();
      });
      return found;
    }();
    return fields;
  }

  void add_objects(ObjectLists& lists, std::size_t group, ListsOf lists_of) {
    std::vector<ObjectItem<Instance>> added;
    for_each_type(Objects{}, [&]<class T>(std::type_identity<T>) {
      auto& items = std::get<ObjectItems<T>>(lists);
      const bool all_there = std::all_of(moments_.begin(), moments_.end(), [&](const SceneDescription& moment) {
        return std::get<ObjectItems<T>>(lists_of(moment, group)).size() == items.size();
      });
      if (!all_there) {
        diagnostics_.error(
            SourceLocation{items.empty() ? 0 : items.front().line, 0},
            "not every <" + std::string(T::element) + "> is there all the time while the shutter is open");
        return;
      }
      std::vector<bool> gone(items.size());
      for (std::size_t i = 0; i < items.size(); ++i) {
        std::vector<const ObjectItem<T>*> then;
        for (const SceneDescription& moment : moments_)
          then.push_back(&std::get<ObjectItems<T>>(lists_of(moment, group))[i]);
        if (!moves(items[i], then)) continue;
        auto motion = motion_of(items[i], then);
        if (motion.empty()) continue;
        if constexpr (std::is_same_v<T, Instance>) {
          items[i].motion = std::move(motion);
        } else {
          added.push_back(in_group(std::move(items[i]), std::move(motion)));
          gone[i] = true;
        }
      }
      std::size_t kept = 0;
      for (std::size_t i = 0; i < items.size(); ++i)
        if (!gone[i]) {
          if (kept != i) items[kept] = std::move(items[i]);
          ++kept;
        }
      items.erase(items.begin() + static_cast<std::ptrdiff_t>(kept), items.end());
    });
    auto& instances = std::get<ObjectItems<Instance>>(lists);
    for (ObjectItem<Instance>& instance : added) instances.push_back(std::move(instance));
  }

  template <class T>
  static bool moves(const ObjectItem<T>& item, const std::vector<const ObjectItem<T>*>& then) {
    static const Fields fields = T::fields();
    return std::any_of(then.begin(), then.end(), [&](const ObjectItem<T>* at_moment) {
      return at_moment->transform != item.transform ||
             !have_same_values(fields, &item.parameters, &at_moment->parameters);
    });
  }

  /// Where the object that the item would be without its transform is at each moment; empty: there is an error.
  template <class T>
  std::vector<Affine> motion_of(const ObjectItem<T>& item, const std::vector<const ObjectItem<T>*>& then) {
    static const Fields fields = T::fields();
    std::vector<Affine> motion;
    for (const ObjectItem<T>* const at_moment : then) {
      const std::optional<Vec3d> shift = shift_between(fields, &item.parameters, &at_moment->parameters);
      if (!shift) {
        diagnostics_.error(
            SourceLocation{item.line, 0},
            "this <" + std::string(T::element) +
                "> changes its form while the shutter is open; let the keys of a <transform> move, turn and scale it");
        return {};
      }
      motion.push_back(at_moment->transform.affine() * Affine{.origin = *shift});
    }
    return motion;
  }

  /// The item as a group of its own, and what moves: an instance of that.
  template <class T>
  ObjectItem<Instance> in_group(ObjectItem<T> item, std::vector<Affine> motion) {
    ObjectItem<Instance> instance;
    instance.parameters.group.name = free_name();
    instance.name = std::exchange(item.name, {});
    instance.line = item.line;
    instance.transform = std::exchange(item.transform, {});
    instance.motion = std::move(motion);
    Group group;
    group.name = instance.parameters.group.name;
    group.line = item.line;
    std::get<ObjectItems<T>>(group.objects).push_back(std::move(item));
    scene_.groups.push_back(std::move(group));
    return instance;
  }

  std::string free_name() {
    while (true) {
      std::string name = "moving#" + std::to_string(++groups_made_);
      if (std::none_of(scene_.groups.begin(), scene_.groups.end(),
                       [&](const Group& group) { return group.name == name; }))
        return name;
    }
  }

  void warn_of_others() {
    const auto warn = [&](const char* what, std::uint32_t line) {
      diagnostics_.warning(SourceLocation{line, 0},
                           std::string(what) + " stands still while the shutter is open: its keys count at the frame");
    };
    const auto compare = [&]<class Item>(std::type_identity<Item>, const Fields& fields, const char* what, auto list) {
      const std::vector<Item>& items = list(scene_);
      for (std::size_t i = 0; i < items.size(); ++i)
        for (const SceneDescription& moment : moments_) {
          const std::vector<Item>& then = list(moment);
          if (then.size() == items.size() && have_same_values(fields, &items[i].parameters, &then[i].parameters))
            continue;
          return warn(what, items[i].line);
        }
    };
    for_each_type(Lights{}, [&]<class T>(std::type_identity<T>) {
      compare(std::type_identity<LightItem<T>>{}, T::fields(), "the light",
              [](const SceneDescription& scene) -> const auto& { return std::get<LightItems<T>>(scene.lights); });
    });
    for_each_type(Materials{}, [&]<class T>(std::type_identity<T>) {
      compare(std::type_identity<MaterialItem<T>>{}, T::fields(), "the material",
              [](const SceneDescription& scene) -> const auto& { return std::get<MaterialItems<T>>(scene.materials); });
    });
    for_each_type(Textures{}, [&]<class T>(std::type_identity<T>) {
      compare(std::type_identity<TextureItem<T>>{}, T::fields(), "the texture",
              [](const SceneDescription& scene) -> const auto& { return std::get<TextureItems<T>>(scene.textures); });
    });
  }

  SceneDescription& scene_;
  const std::vector<SceneDescription>& moments_;
  Diagnostics& diagnostics_;
  int groups_made_ = 0;
};

}  // namespace

void add_motion(SceneDescription& scene, const std::function<SceneDescription(double, Diagnostics&)>& read,
                Diagnostics& diagnostics) {
  const auto [open, close] =
      std::visit([](const auto& camera) { return std::pair(camera.shutteropen, camera.shutterclose); }, scene.camera);
  if (!(close > open)) return;
  std::vector<SceneDescription> moments;
  for (int i = 0; i < shutter_moments; ++i) {
    Diagnostics of_moment(diagnostics.file());
    moments.push_back(read(open + (close - open) * i / (shutter_moments - 1), of_moment));
    if (!of_moment.has_errors()) continue;
    const Diagnostic& first = of_moment.kept().front();
    return diagnostics.error(first.location, "while the shutter is open: " + first.message);
  }
  MotionFinder(scene, moments, diagnostics).find();
}

}  // namespace raytrace
