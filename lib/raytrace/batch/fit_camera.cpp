#include "raytrace/batch/fit_camera.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>

#include "raytrace/batch/settings_error.h"

namespace raytrace {

namespace {

constexpr double no_reach = -1e300;

/// A direction in which it is measured how far points reach: the largest of(p).
struct SightLine {
  Vec3d along;
  double offset = 0;

  double of(const Vec3d& p) const { return dot(along, p) + offset; }
  template <class Shape>
  double of(const typename Shape::Parameters& shape) const {
    return Shape::reach(shape, along) + offset;
  }
  /// The same direction in the space that the map leaves.
  SightLine before(const Affine& map) const {
    return {{dot(along, map.x), dot(along, map.y), dot(along, map.z)}, offset + dot(along, map.origin)};
  }
};

/// How far a scene reaches in six directions.
using SightLines = std::array<SightLine, 6>;
using Reaches = std::array<double, 6>;

const SightLines along_axes{{{{1, 0, 0}}, {{0, 1, 0}}, {{0, 0, 1}}, {{-1, 0, 0}}, {{0, -1, 0}}, {{0, 0, -1}}}};

/// Shapes without end have no reach(); models are meshes by now.
template <class T>
constexpr bool has_end() {
  if constexpr (has_type<T>(Shapes{}))
    return requires(const typename T::Parameters& shape) { T::reach(shape, Vec3d()); };
  else
    return !std::is_same_v<T, Model>;
}

class Measurer {
 public:
  /// lamps: whether they count.
  Measurer(const SceneDescription& scene, bool lamps) : scene_(scene), lamps_(lamps) {
    for (const Group& group : scene.groups) groups_.emplace(group.name, &group);
  }

  Reaches measure(const SightLines& directions) {
    Reaches reaches = none();
    add(scene_.objects, lamps_, directions, reaches);
    return reaches;
  }

 private:
  static Reaches none() {
    Reaches reaches;
    reaches.fill(no_reach);
    return reaches;
  }
  static SightLines before(const Transform& transform, const SightLines& directions) {
    return transform.empty() ? directions : before(transform.affine(), directions);
  }
  static SightLines before(const Affine& map, const SightLines& directions) {
    SightLines result;
    for (std::size_t i = 0; i < 6; ++i) result[i] = directions[i].before(map);
    return result;
  }
  template <class Reach>
  static void add_each(const SightLines& directions, Reaches& reaches, const Reach& reach) {
    for (std::size_t i = 0; i < 6; ++i) reaches[i] = std::max(reaches[i], reach(directions[i]));
  }
  static bool is_lamp(const MaterialReference& material) { return material.type == index_of<Emissive>(Materials{}); }

  void add(const ObjectLists& objects, bool lamps, const SightLines& directions, Reaches& reaches) {
    for_each_type(Objects{}, [&]<class T>(std::type_identity<T>) {
      if constexpr (has_end<T>())
        for (const auto& item : std::get<ObjectItems<T>>(objects))
          if (lamps || (item.visible && !is_lamp(item.material)))
            add_item(item, lamps, before(item.transform, directions), reaches);
    });
  }

  template <class Shape>
  static void add_item(const ObjectItem<Shape>& item, bool, const SightLines& directions, Reaches& reaches) {
    add_each(directions, reaches, [&](const SightLine& line) { return line.of<Shape>(item.parameters); });
  }

  void add_item(const ObjectItem<Mesh>& item, bool, const SightLines& directions, Reaches& reaches) {
    const MeshData& data = *item.data;
    add_if_farther(box_of(&data, [&](Reaches& box) { add_vertices(data, along_axes, box); }), directions, reaches,
                   [&] { add_vertices(data, directions, reaches); });
    for (const MeshCopies& copies : data.copies) {
      const MeshData& copied = *copies.mesh;
      const Reaches& box = box_of(&copied, [&](Reaches& to) { add_vertices(copied, along_axes, to); });
      for (const MeshCopies::Place& place : copies.places) {
        const SightLines here = before(place.affine, directions);
        add_if_farther(box, here, reaches, [&] { add_vertices(copied, here, reaches); });
      }
    }
  }
  void add_item(const ObjectItem<SphereCloud>& item, bool, const SightLines& directions, Reaches& reaches) {
    const auto add = [&](const SightLines& in, Reaches& to) { add_spheres(item, in, to); };
    add_if_farther(box_of(&item, [&](Reaches& box) { add(along_axes, box); }), directions, reaches,
                   [&] { add(directions, reaches); });
  }
  void add_item(const ObjectItem<Curve>& item, bool, const SightLines& directions, Reaches& reaches) {
    const auto add = [&](const SightLines& in, Reaches& to) { add_points(*item.data, in, to); };
    add_if_farther(box_of(&item, [&](Reaches& box) { add(along_axes, box); }), directions, reaches,
                   [&] { add(directions, reaches); });
  }
  void add_item(const ObjectItem<Instance>& item, bool lamps, const SightLines& directions, Reaches& reaches) {
    const Group& group = *groups_.at(item.parameters.group.name);
    const bool all = lamps || item.material != no_material;  // which is that of its lamps, too
    const auto add_all = [&](const SightLines& in, Reaches& to) { add(group.objects, all, in, to); };
    auto& boxes = all ? whole_boxes_ : boxes_;
    const Reaches& box = box_of(&group, [&](Reaches& to) { add_all(along_axes, to); }, boxes);
    add_if_farther(box, directions, reaches, [&] { add_all(directions, reaches); });
  }

  /// Vertices of faces: others are not in the picture.
  static void add_vertices(const MeshData& data, const SightLines& directions, Reaches& reaches) {
    const float* const p = data.positions.data();
    for (const std::uint32_t index : data.indices) {
      const std::size_t i = std::size_t{3} * index;
      const Vec3d vertex = Vec3d{double{p[i]}, double{p[i + 1]}, double{p[i + 2]}} + data.origin;
      add_each(directions, reaches, [&](const SightLine& line) { return line.of(vertex); });
    }
  }
  static void add_spheres(const ObjectItem<SphereCloud>& item, const SightLines& directions, Reaches& reaches) {
    const PointCloud& data = *item.data;
    const float* const p = data.positions.data();
    for (std::size_t i = 0; i < data.size(); ++i) {
      const Vec3d center = Vec3d{double{p[3 * i]}, double{p[3 * i + 1]}, double{p[3 * i + 2]}} + data.origin;
      const double radius = data.radii.empty() ? item.parameters.radius : double{data.radii[i]};
      add_each(directions, reaches, [&](const SightLine& line) { return line.of<Sphere>({center, radius}); });
    }
  }

  static void add_points(const CurveData& data, const SightLines& directions, Reaches& reaches) {
    for (std::size_t i = 0; i < data.size(); ++i) {
      const float* const p = data.points.data() + 4 * i;
      const Vec3d center = Vec3d{double{p[0]}, double{p[1]}, double{p[2]}} + data.origin;
      add_each(directions, reaches, [&](const SightLine& line) { return line.of<Sphere>({center, double{p[3]}}); });
    }
  }

  /// How far it reaches along the axes, which is measured once.
  template <class Measure>
  const Reaches& box_of(const void* key, const Measure& measure, std::map<const void*, Reaches>& boxes) {
    const auto known = boxes.find(key);
    if (known != boxes.end()) return known->second;
    Reaches box = none();
    measure(box);
    return boxes.emplace(key, box).first->second;
  }
  template <class Measure>
  const Reaches& box_of(const void* key, const Measure& measure) {
    return box_of(key, measure, boxes_);
  }

  /// add(), where the box reaches beyond what is there: of a forest's trees, few do.
  template <class Add>
  static void add_if_farther(const Reaches& box, const SightLines& directions, const Reaches& reaches, const Add& add) {
    if (box[0] == no_reach) return;
    const Box::Parameters corners{{-box[3], -box[4], -box[5]}, {box[0], box[1], box[2]}};
    for (std::size_t i = 0; i < 6; ++i)
      if (directions[i].of<Box>(corners) > reaches[i]) return add();
  }

  const SceneDescription& scene_;
  bool lamps_;
  std::map<std::string_view, const Group*> groups_;
  std::map<const void*, Reaches> boxes_, whole_boxes_;  ///< whole: with lamps
};

Reaches measured(const SceneDescription& scene, const SightLines& directions) {
  Reaches reaches = Measurer(scene, false).measure(directions);
  if (reaches[0] == no_reach) reaches = Measurer(scene, true).measure(directions);
  if (reaches[0] == no_reach) throw SettingsError("--fit: the scene has no object with an end, to be in view");
  return reaches;
}

}  // namespace

double reach_along(const SceneDescription& scene, const Vec3d& along) {
  SightLines directions;
  directions.fill({along});
  return measured(scene, directions).front();
}

void fit_camera(const SceneDescription& shown, SceneDescription& scene) {
  if (!scene.moving_camera.empty())
    throw SettingsError("--fit: the scene's camera moves while its shutter is open; it cannot be moved as well");
  ViewPlane& picture = scene.viewplane;
  std::visit(
      [&]<class Parameters>(Parameters& camera) {
        constexpr bool has_view_plane = requires { camera.viewdistance; };
        if constexpr (!has_view_plane && !std::is_same_v<Parameters, OrthographicCamera::Parameters>) {
          throw SettingsError("--fit: the scene's camera sees all around; it cannot be moved to have more in view");
        } else {
          const ViewFrame frame(camera.eye, camera.lookat, camera.up);
          Reach across{0}, upwards{0};
          if constexpr (has_view_plane) {
            const double half = part_in_view * picture.pixelsize / (2 * camera.viewdistance);
            across.tangent = half * picture.hres;
            upwards.tangent = half * picture.vres;
            const Vec2d shift = shift_in_pixels(camera, picture);
            across.shift = shift.x * picture.pixelsize / camera.viewdistance;
            upwards.shift = shift.y * picture.pixelsize / camera.viewdistance;
          }
          const Vec3d &u = frame.u, &v = frame.v, &w = frame.w;
          const Reaches reaches = measured(shown, {{{w * (across.tangent + across.shift) + u},
                                                    {w * (across.tangent - across.shift) - u},
                                                    {w * (upwards.tangent + upwards.shift) + v},
                                                    {w * (upwards.tangent - upwards.shift) - v},
                                                    {w},
                                                    {-w}}});
          std::tie(across.right, across.left, upwards.right, upwards.left) =
              std::tuple(reaches[0], reaches[1], reaches[2], reaches[3]);
          const double nearest = reaches[4], depth = nearest + reaches[5], middle = nearest - depth / 2;
          double distance = 0;  // of the eye, along w
          if constexpr (has_view_plane) {
            const double wanted = std::max(across.distance(), upwards.distance());
            // What is a point, or lies behind another point, is not at the eye.
            const double least = wanted > middle ? (wanted - middle) * 1e-3 : 1;
            distance = std::max(wanted, nearest + least);
          } else {
            const double width = across.right + across.left, height = upwards.right + upwards.left;
            const double needed = std::max(width / picture.hres, height / picture.vres) / part_in_view;
            if (needed > 0) picture.pixelsize = needed;
            distance = nearest + std::max({width, height, depth, smallest_size});
          }
          // What is cut away stays the same.
          if (camera.nearclip > 0) camera.nearclip = std::max(camera.nearclip + distance - dot(camera.eye, w), 0.0);
          const Vec3d beside = u * across.eye(distance) + v * upwards.eye(distance);
          camera.lookat = beside + w * middle;
          camera.eye = beside + w * distance;
          if constexpr (requires { camera.focaldistance; }) camera.focaldistance = distance - middle;
        }
      },
      scene.camera);
}

}  // namespace raytrace
