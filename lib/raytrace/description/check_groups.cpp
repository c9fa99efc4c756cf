#include "raytrace/description/check_groups.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>

#include "raytrace/description/parse_value.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

/// As far as any number of a scene, and as much more as reaches are overestimated.
constexpr double most_reach = 10 * largest_number;

class GroupChecker {
 public:
  GroupChecker(const SceneDescription& scene, Diagnostics& diagnostics) : scene_(scene), diagnostics_(diagnostics) {
    for (const Group& group : scene.groups) {
      names_.push_back(group.name);
      states_.try_emplace(group.name, State{&group});
    }
  }

  void check() {
    for (const Group& group : scene_.groups)
      for (const auto& plane : std::get<ObjectItems<Plane>>(group.objects))
        diagnostics_.error(
            location_of(plane),
            std::string("a plane has no end, so it cannot be in a group; put it into the scene's <objects>"));
    check_count();
  }

  void check_count() {
    std::uint64_t count = copies_in(scene_.objects);
    // Where it is said: at the last that has any.
    SourceLocation last;
    for (const auto& mesh : std::get<ObjectItems<Mesh>>(scene_.objects)) last = location_of(mesh);
    for (const Group& group : scene_.groups) count_of(states_.at(group.name));
    for (const auto& instance : std::get<ObjectItems<Instance>>(scene_.objects)) {
      count += count_of(instance, nullptr);
      last = location_of(instance);
    }
    if (count > most_instances)
      diagnostics_.error(last, "the scene has " + std::to_string(count) +
                                   " instances, those in groups counted each time; the most is " +
                                   std::to_string(most_instances));
  }

  /// Of meshes that have been read.
  static std::uint64_t copies_in(const ObjectLists& objects) {
    std::uint64_t count = 0;
    for (const auto& mesh : std::get<ObjectItems<Mesh>>(objects))
      if (mesh.data != nullptr)
        for (const MeshCopies& copies : mesh.data->copies) count += copies.places.size();
    return count;
  }

 private:
  /// What instances within each other make of a point near (0, 0, 0): how far it gets at most.
  struct Reach {
    double scale = 1;   ///< by which lengths grow
    double origin = 0;  ///< the distance of where (0, 0, 0) goes
  };

  struct State {
    const Group* group;
    enum { unknown, at_hand, known } progress = unknown;
    std::uint64_t count = 0;  ///< of instances that one of the group is
    Reach reach{};
  };

  std::uint64_t count_of(const ObjectItem<Instance>& instance, Reach* reach) {
    const Reference& name = instance.parameters.group;
    const SourceLocation location = name.line > 0 ? location_of(name) : location_of(instance);
    const auto found = states_.find(name.name);
    if (found == states_.end()) {
      const std::string_view nearest = nearest_name(name.name, names_);
      diagnostics_.error(location, "unknown group " + in_quotes(name.name) + " in <instance>; " +
                                       (nearest.empty() ? "add one of that name to <groups>"
                                                        : "did you mean " + in_quotes(nearest) + "?"));
      return 0;
    }
    if (found->second.progress == State::at_hand) {
      diagnostics_.error(location, "the group " + in_quotes(name.name) + " would have itself in it");
      return 0;
    }
    const std::uint64_t count = count_of(found->second);
    add_reach(instance, found->second.reach, reach);
    return count;
  }

  /// Of an instance of what has the reach `inner`, to that of the group that it is in; null: it is in the scene itself.
  void add_reach(const ObjectItem<Instance>& instance, const Reach& inner, Reach* reach) {
    const bool is_of_scene = reach == nullptr;
    if (is_of_scene && inner.scale == 1 && inner.origin == 0) return;  // most, and each is fine by itself
    const Affine affine = instance.transform.affine();
    // By what lengths grow; or, where that is not the same in all directions, up to twice as much.
    const double scale =
        affine.uniform_scale().value_or(length(Vec3d(length(affine.x), length(affine.y), length(affine.z))));
    const Reach outer{scale * inner.scale, scale * inner.origin + length(affine.origin)};
    if (!std::isfinite(outer.scale + outer.origin)) return;  // no good transform by itself, which others say
    // What is wrong is said once, not at all that it is in.
    if (std::max(outer.scale, outer.origin) <= most_reach) {
      if (!is_of_scene) *reach = {std::max(reach->scale, outer.scale), std::max(reach->origin, outer.origin)};
    } else {
      diagnostics_.error(location_of(instance),
                         "the <instance>, with those in its group " + in_quotes(instance.parameters.group.name) +
                             ", makes objects too large, or moves them too far: beyond the largest "
                             "number that a scene may have, " +
                             number_text(largest_number));
    }
  }

  std::uint64_t count_of(State& state) {
    if (state.progress != State::unknown) return state.count;
    state.progress = State::at_hand;
    std::uint64_t count = 1 + copies_in(state.group->objects);
    for_each_type(Shapes{}, [&]<class Shape>(std::type_identity<Shape>) {
      for (const auto& item : std::get<ObjectItems<Shape>>(state.group->objects))
        count += item.transform.empty() ? 0 : 1;
    });
    for (const auto& inner : std::get<ObjectItems<Instance>>(state.group->objects))
      count = std::min(count + count_of(inner, &state.reach), std::uint64_t{1} << 40U);
    state.count = count;
    state.progress = State::known;
    return count;
  }

  const SceneDescription& scene_;
  Diagnostics& diagnostics_;
  std::vector<std::string_view> names_;
  std::map<std::string_view, State> states_;
};

}  // namespace

void check_groups(const SceneDescription& scene, Diagnostics& diagnostics) { GroupChecker(scene, diagnostics).check(); }

std::optional<std::string> too_many_copies(const SceneDescription& scene) {
  std::uint64_t copies = GroupChecker::copies_in(scene.objects);
  for (const Group& group : scene.groups) copies += GroupChecker::copies_in(group.objects);
  if (copies == 0) return std::nullopt;
  Diagnostics found("");
  GroupChecker(scene, found).check_count();
  if (!found.has_errors()) return std::nullopt;
  return found.kept().back().message;
}

}  // namespace raytrace
