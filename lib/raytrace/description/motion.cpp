#include "raytrace/description/motion.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "raytrace/description/motion_values.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

/// Of those that have one, such as a fog, whose density it moves.
template <class Item>
bool has_same_transform(const Item& item, const Item& then) {
  if constexpr (requires { item.transform; }) return !(item.transform != then.transform);
  return true;
}

constexpr const char* slower = "; let the shutter be open for less time";

class MotionFinder {
 public:
  MotionFinder(SceneDescription& scene, Diagnostics& diagnostics) : scene_(scene), diagnostics_(diagnostics) {}

  /// then: the scene as it is at moment number `moment`, which come one after the other.
  void add(std::size_t moment, SceneDescription then) {
    moment_ = moment;
    take_pixel_size(then);
    add_camera(then.camera);
    compare_objects(0, scene_.objects, then.objects);
    for (std::size_t group = 0; group < scene_.groups.size(); ++group)
      compare_objects(group + 1, scene_.groups[group].objects, then.groups[group].objects);
    warn_of_others(then);
  }

  /// All stands still as it is at the only moment; what has keys that count at the frame, as it is there.
  void move_to(SceneDescription then) {
    take_pixel_size(then);
    warn_of_others(then);
    scene_.camera = then.camera;
    move_objects_to(then.objects, scene_.objects);
    for (std::size_t group = 0; group < scene_.groups.size(); ++group)
      move_objects_to(then.groups[group].objects, scene_.groups[group].objects);
  }

  /// After the last moment.
  void finish() {
    if (!camera_moves_) scene_.moving_camera.clear();
    const auto* const path = scene_.integrator ? std::get_if<Path::Parameters>(&*scene_.integrator) : nullptr;
    if (camera_moves_ && path != nullptr && path->caustics != Caustics::none)
      diagnostics_.error(scene_.camera_location,
                         std::string("the camera moves while its shutter is open, and light paths (<caustics>) cannot "
                                     "reach it; let it stand still, or remove <caustics>"));
    for (const Group& group : scene_.groups) group_names_.insert(group.name);
    move_objects(0, scene_.objects);
    const std::size_t groups = scene_.groups.size();
    for (std::size_t group = 0; group < groups; ++group) {
      // Where groups are added, those before them move in memory.
      ObjectLists lists = std::move(scene_.groups[group].objects);
      move_objects(group + 1, lists);
      scene_.groups[group].objects = std::move(lists);
    }
  }

 private:
  /// An object: of the scene (0) or a group (its number + 1), the type's and its own number there.
  struct Place {
    std::size_t list, type, item;
    friend auto operator<=>(const Place&, const Place&) = default;
  };

  /// A pixel that grows is as a view plane that comes nearer.
  void take_pixel_size(SceneDescription& then) const {
    std::visit(
        [&](auto& camera) {
          if constexpr (requires { camera.viewdistance; })
            camera.viewdistance *=
                scene_.viewplane.pixelsize / std::exchange(then.viewplane.pixelsize, scene_.viewplane.pixelsize);
        },
        then.camera);
  }

  void add_camera(const CameraParameters& then) {
    for_each_type(Cameras{}, [&]<class Camera>(std::type_identity<Camera>) {
      const auto* const now = std::get_if<typename Camera::Parameters>(&scene_.camera);
      if (now == nullptr) return;
      const auto& at_moment = std::get<typename Camera::Parameters>(then);
      camera_moves_ = camera_moves_ || !have_same_values(Camera::fields(), now, &at_moment);
      if (!scene_.moving_camera.empty())
        check_turn(std::get<typename Camera::Parameters>(scene_.moving_camera.back()), at_moment);
    });
    scene_.moving_camera.push_back(then);
  }

  template <class Parameters>
  void check_turn(const Parameters& from, const Parameters& to) {
    const ViewFrame a(from.eye, from.lookat, from.up), b(to.eye, to.lookat, to.up);
    // A rotation has the trace 1 + 2 cos(angle): more than 1 is less than 90 degrees.
    if (dot(a.u, b.u) + dot(a.v, b.v) + dot(a.w, b.w) > 1) return;
    diagnostics_.error(scene_.camera_location,
                       std::string("the camera turns too fast to be followed while the shutter is open") + slower);
  }

  void compare_objects(std::size_t list, const ObjectLists& lists, const ObjectLists& then) {
    for_each_type(Objects{}, [&]<class T>(std::type_identity<T>) {
      const auto& items = std::get<ObjectItems<T>>(lists);
      const auto& items_then = std::get<ObjectItems<T>>(then);
      if (items_then.empty()) return;  // they have no keys
      if (items.size() != items_then.size())
        return diagnostics_.error(
            location_of(items_then.front()),
            "not every <" + std::string(T::element) + "> is there all the time while the shutter is open");
      const Fields fields = T::fields();
      for (std::size_t i = 0; i < items.size(); ++i) {
        if constexpr (requires { items[i].parameters.animation; })
          if (items[i].parameters.time != items_then[i].parameters.time) {
            add_at_rest({list, index_of<T>(Objects{}), i}, fields, items[i], items_then[i]);
            continue;
          }
        if (items[i].transform != items_then[i].transform ||
            !have_same_values(fields, &items[i].parameters, &items_then[i].parameters))
          add_place({list, index_of<T>(Objects{}), i}, fields, items[i], items_then[i]);
      }
    });
  }

  template <class T>
  void keep_animation(const ObjectItem<T>& item, ObjectItem<T>& then) {
    if (!item.parameters.animation.name.empty() && warned_.insert({item.line, item.column}).second)
      diagnostics_.warning(location_of(item),
                           "the animation of this <" + std::string(T::element) +
                               "> stands still while the shutter is open: its <time> counts at the frame");
    then.parameters.time = item.parameters.time;
  }

  void move_objects_to(ObjectLists& then, ObjectLists& lists) {
    for_each_type(Objects{}, [&]<class T>(std::type_identity<T>) {
      auto& items = std::get<ObjectItems<T>>(lists);
      auto& items_then = std::get<ObjectItems<T>>(then);
      if (items_then.empty()) return;  // they have no keys
      if constexpr (requires { items[0].parameters.animation; })
        for (std::size_t i = 0; i < std::min(items.size(), items_then.size()); ++i)
          if (items[i].parameters.time != items_then[i].parameters.time) keep_animation<T>(items[i], items_then[i]);
      items = std::move(items_then);
    });
  }

  /// A file has its form of the frame all the time, wherever it moves.
  template <class T>
  void add_at_rest(const Place& object, const Fields& fields, const ObjectItem<T>& item, ObjectItem<T> then) {
    keep_animation<T>(item, then);
    if (item.transform != then.transform || !have_same_values(fields, &item.parameters, &then.parameters))
      add_place(object, fields, item, then);
  }

  /// Where the object that the item would be without its transform is at this moment.
  template <class T>
  void add_place(const Place& object, const Fields& fields, const ObjectItem<T>& item, const ObjectItem<T>& then) {
    const std::optional<Vec3d> shift = shift_between(fields, &item.parameters, &then.parameters);
    if (!shift)
      return diagnostics_.error(
          location_of(item),
          "this <" + std::string(T::element) +
              "> changes its form while the shutter is open; let the keys of a <transform> move, turn and scale it");
    std::vector<Affine>& motion = motions_[object];
    if (motion.empty()) motion.assign(shutter_moments, item.transform.affine());
    motion[moment_] = then.transform.affine() * Affine{.origin = *shift};
    const auto [last, is_first] = last_.try_emplace(object, moment_, then.transform);
    if (is_first && moment_ == 0) return;
    const bool was_elsewhere = !is_first && last->second.first + 1 == moment_;
    check_turn(item, was_elsewhere ? last->second.second : item.transform, then.transform);
    last->second = {moment_, then.transform};
  }

  /// By the angles of the keys: whole turns leave no trace in the maps.
  template <class T>
  void check_turn(const ObjectItem<T>& item, const Transform& before, const Transform& now) {
    constexpr double most = 90, smooth = 22.5;
    const double turn = largest_turn(before, now);
    if (turn <= smooth) return;
    const std::string fact = "this <" + std::string(T::element) + "> turns by " + number_text(turn) +
                             " degrees from one of the shutter's " + std::to_string(shutter_moments) +
                             " moments to the next";
    if (turn > most)
      diagnostics_.error(location_of(item),
                         fact + ", too fast to be followed: " + number_text(most) + " is the most" + slower);
    else if (warned_.insert({item.line, item.column}).second)
      diagnostics_.warning(location_of(item), fact + ", and straight on in between: its blur has corners" + slower);
  }

  template <class T>
  void check_speed(const ObjectItem<T>& item, const std::vector<Affine>& motion) {
    for (std::size_t i = 1; i < motion.size(); ++i)
      if (collapses_between(motion[i - 1], motion[i]))
        return diagnostics_.error(location_of(item),
                                  "this <" + std::string(T::element) +
                                      "> turns, or is turned inside out, too fast to be followed while the shutter "
                                      "is open" +
                                      slower);
  }

  /// What moves becomes an instance with that motion.
  void move_objects(std::size_t list, ObjectLists& lists) {
    std::vector<ObjectItem<Instance>> added;
    for_each_type(Objects{}, [&]<class T>(std::type_identity<T>) {
      auto& items = std::get<ObjectItems<T>>(lists);
      std::size_t kept = 0;
      for (std::size_t i = 0; i < items.size(); ++i) {
        const auto motion = motions_.find({list, index_of<T>(Objects{}), i});
        if (motion != motions_.end()) check_speed(items[i], motion->second);
        if constexpr (std::is_same_v<T, Plane>) {
          if (motion != motions_.end())
            diagnostics_.error(location_of(items[i]),
                               std::string("a plane has no end, so it cannot move while the shutter is open"));
        } else if constexpr (std::is_same_v<T, Instance>) {
          if (motion != motions_.end()) items[i].motion = std::move(motion->second);
        } else if (motion != motions_.end()) {
          added.push_back(in_group(std::move(items[i]), std::move(motion->second)));
          continue;
        }
        if (kept != i) items[kept] = std::move(items[i]);
        ++kept;
      }
      items.erase(items.begin() + static_cast<std::ptrdiff_t>(kept), items.end());
    });
    auto& instances = std::get<ObjectItems<Instance>>(lists);
    for (ObjectItem<Instance>& instance : added) instances.push_back(std::move(instance));
  }

  /// The item as a group of its own, and what moves: an instance of that.
  template <class T>
  ObjectItem<Instance> in_group(ObjectItem<T> item, std::vector<Affine> motion) {
    ObjectItem<Instance> instance;
    instance.parameters.group.name = free_group_name();
    instance.name = std::exchange(item.name, {});
    instance.line = item.line;
    instance.column = item.column;
    instance.transform = std::exchange(item.transform, {});
    instance.motion = std::move(motion);
    Group group;
    group.name = instance.parameters.group.name;
    group.line = item.line;
    group.column = item.column;
    std::get<ObjectItems<T>>(group.objects).push_back(std::move(item));
    scene_.groups.push_back(std::move(group));
    return instance;
  }

  std::string free_group_name() {
    while (true)
      if (std::string name = "moving#" + std::to_string(++groups_made_); group_names_.insert(name).second) return name;
  }

  void warn_of_others(const SceneDescription& then) {
    if (!have_same_values(ViewPlane::fields(), &scene_.viewplane, &then.viewplane) &&
        warned_.insert({scene_.camera_location.line, scene_.camera_location.column}).second)
      diagnostics_.warning(
          scene_.camera_location,
          std::string("the view plane stands still while the shutter is open: its keys count at the frame"));
    const auto compare = [&](const auto& items, const auto& items_then, const Fields& fields, const std::string& what) {
      for (std::size_t i = 0; i < items.size(); ++i) {
        if (items.size() == items_then.size() &&
            have_same_values(fields, &items[i].parameters, &items_then[i].parameters) &&
            has_same_transform(items[i], items_then[i]))
          continue;
        if (!warned_.insert({items[i].line, items[i].column}).second) continue;
        std::string which = "this " + what;
        if constexpr (requires { items[i].name; }) which = "the " + what + " " + in_quotes(items[i].name);
        diagnostics_.warning(location_of(items[i]),
                             which + " stands still while the shutter is open: its keys count at the frame");
      }
    };
    for_each_type(Lights{}, [&]<class T>(std::type_identity<T>) {
      compare(std::get<LightItems<T>>(scene_.lights), std::get<LightItems<T>>(then.lights), T::fields(), "light");
    });
    for_each_type(Materials{}, [&]<class T>(std::type_identity<T>) {
      compare(std::get<MaterialItems<T>>(scene_.materials), std::get<MaterialItems<T>>(then.materials), T::fields(),
              "material");
    });
    for_each_type(Textures{}, [&]<class T>(std::type_identity<T>) {
      compare(std::get<TextureItems<T>>(scene_.textures), std::get<TextureItems<T>>(then.textures), T::fields(),
              "texture");
    });
  }

  SceneDescription& scene_;
  Diagnostics& diagnostics_;
  std::size_t moment_ = 0;
  bool camera_moves_ = false;
  std::map<Place, std::vector<Affine>> motions_;
  std::map<Place, std::pair<std::size_t, Transform>> last_;  ///< the moment at which it was elsewhere than at the frame
  std::set<std::pair<std::uint32_t, std::uint32_t>> warned_;  ///< by line and column
  std::set<std::string> group_names_;
  int groups_made_ = 0;
};

struct Shutter {
  double opens, closes;
};

Shutter shutter_of(const SceneDescription& scene) {
  return std::visit([](const auto& camera) { return Shutter{camera.shutteropen, camera.shutterclose}; }, scene.camera);
}

/// What is wrong at a moment that is not the frame's.
void report_first_error(const SceneDescription& scene, const Diagnostics& of_moment, Diagnostics& diagnostics) {
  const auto first = std::find_if(of_moment.kept().begin(), of_moment.kept().end(),
                                  [](const Diagnostic& one) { return one.severity == Severity::error; });
  SourceLocation location = first->location;
  const auto file = std::find_if(scene.included.begin(), scene.included.end(),
                                 [&](const IncludedFile& one) { return on_one_line(one.name) == first->file; });
  if (file != scene.included.end()) location.line += file->first_line - 1;
  diagnostics.error(location, "while the shutter is open: " + first->message);
}

}  // namespace

bool is_open_for_an_instant(const SceneDescription& scene) {
  const auto [opens, closes] = shutter_of(scene);
  return opens == closes && opens != 0;
}

void add_motion(SceneDescription& scene, const std::function<SceneDescription(double, Diagnostics&)>& read,
                Diagnostics& diagnostics) {
  const auto [opens, closes] = shutter_of(scene);
  const bool at_one_moment = is_open_for_an_instant(scene);
  if (!(closes > opens) && !at_one_moment) return;
  MotionFinder finder(scene, diagnostics);
  for (std::size_t i = 0; i < (at_one_moment ? 1 : shutter_moments); ++i) {
    Diagnostics of_moment(diagnostics.file());
    SceneDescription then = read(opens + (closes - opens) * static_cast<double>(i) / (shutter_moments - 1), of_moment);
    if (of_moment.has_errors()) {
      report_first_error(scene, of_moment, diagnostics);
    } else if (at_one_moment) {
      return finder.move_to(std::move(then));
    } else {
      finder.add(i, std::move(then));
    }
    if (diagnostics.has_errors()) return;
  }
  finder.finish();
}

void warn_of_motion(const SceneDescription& scene, Diagnostics& diagnostics) {
  const auto [opens, closes] = shutter_of(scene);
  if (closes > opens)
    diagnostics.warning(
        scene.camera_location,
        std::string("the scene is as it stands at the frame: what moves while the shutter is open is not in it"));
}

}  // namespace raytrace
