#include "raytrace/description/check_solids.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "raytrace/description/default_integrator.h"
#include "raytrace/import/mesh_data.h"
#include "raytrace/math/bounds.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

/// Of a material. Paths draw light behind what is lit; what is dark lets no light through that is drawn.
enum class Clear { not_solid, lit, dark };

Clear clearness(const SceneDescription& scene, const MaterialReference& material) {
  Clear result = Clear::not_solid;
  for_each_type(Materials{}, [&]<class T>(std::type_identity<T>) {
    const auto& items = std::get<MaterialItems<T>>(scene.materials);
    if (material.type != index_of<T>(Materials{}) || material.index >= items.size()) return;
    if constexpr (requires { T::refracts(items[0].parameters); }) {
      const auto& parameters = items[material.index].parameters;
      if (!T::refracts(parameters) || T::values(parameters).thin > 0) return;
      const bool is_lit = T::scatters_through(parameters, [](std::string_view) { return false; });
      result = is_lit ? Clear::lit : Clear::dark;
    }
  });
  return result;
}

/// A box of such edges, under a transform, whose thickness is small, but not 0.
bool is_flat(const Vec3d& size, const Affine& affine) {
  std::array edges{length(affine.vector({size.x, 0, 0})), length(affine.vector({0, size.y, 0})),
                   length(affine.vector({0, 0, size.z}))};
  std::ranges::sort(edges);
  return edges[0] > 0 && edges[0] < 0.1 * edges[1];
}

struct Solid {
  const ObjectItem<Mesh>* mesh;
  Bounds box;  ///< after its transform
  bool is_flat = false, is_inside_out = false;
};

bool is_within(const Bounds& inner, const Bounds& outer) {
  const auto from = [](const Vec3f& a, const Vec3f& b) { return a.x <= b.x && a.y <= b.y && a.z <= b.z; };
  return from(outer.lower, inner.lower) && from(inner.upper, outer.upper);
}

Solid solid_of(const ObjectItem<Mesh>& mesh) {
  const MeshData& data = *mesh.data;
  const auto position = [&](std::size_t corner) {
    const float* const p = &data.positions.data()[std::size_t{3} * data.indices.data()[corner]];
    return Vec3d{p[0], p[1], p[2]};
  };
  Solid solid{&mesh, empty_bounds};
  Bounds own_box = empty_bounds;
  const Affine affine = mesh.transform.affine();
  for (std::size_t i = 0; i < data.indices.size(); ++i) {
    const Vec3f own(position(i)), p(affine.point(position(i) + data.origin));
    own_box = join(own_box, {own, own});
    solid.box = join(solid.box, {p, p});
  }
  // By the divergence theorem: the areas of what is closed add up to nothing, and the volume is positive if they point
  // outwards. Of triangles and of quads' halves, twice the area and six times the volume each.
  const Vec3d middle = position(0);
  Vec3d area{};
  double area_size = 0, volume = 0;
  const auto corners = static_cast<std::size_t>(data.corners);
  for (std::size_t first = 0; first < data.indices.size(); first += corners)
    for (std::size_t half = 2; half < corners; ++half) {
      const Vec3d a = position(first) - middle, b = position(first + half - 1) - middle,
                  c = position(first + half) - middle;
      const Vec3d normal = cross(b - a, c - a);
      area += normal;
      area_size += length(normal);
      volume += dot(a, normal);
    }
  const bool is_closed = length(area) < 1e-4 * area_size;
  solid.is_flat = is_closed && is_flat(Vec3d(own_box.upper) - Vec3d(own_box.lower), affine);
  // A flat one, whose volume is rounding, has no inside.
  solid.is_inside_out = is_closed && volume < -1e-6 * std::pow(area_size, 1.5);
  return solid;
}

/// Of lights that no ray meets by chance.
bool has_lights_without_size(const SceneDescription& scene) {
  const auto has = [&]<class... Light>() { return (... || !std::get<LightItems<Light>>(scene.lights).empty()); };
  return has.operator()<DirectionalLight, PointLight, SpotLight, SkyLight>();
}

bool has_path_without_caustics(const SceneDescription& scene) {
  const IntegratorParameters integrator = integrator_of(scene);
  const auto* const path = std::get_if<Path::Parameters>(&integrator);
  return path != nullptr && path->caustics == Caustics::none;
}

class SolidChecker {
 public:
  explicit SolidChecker(const SceneDescription& scene) : scene_(scene) {
    add(scene.objects);
    for (const Group& group : scene.groups) add(group.objects);
  }

  void report(Diagnostics& diagnostics) const {
    for (const std::vector<Solid>& solids : solids_)
      for (const Solid& solid : solids) {
        const auto is_around = [&](const Solid& other) {
          return is_within(solid.box, other.box) && !is_within(other.box, solid.box);
        };
        // What others of the scene enclose may be their hollow.
        if (!solid.is_inside_out || count_ > solids.size() || std::ranges::any_of(solids, is_around)) continue;
        diagnostics.warning(
            location_of(*solid.mesh),
            std::string("the fronts of the mesh's faces are inside: as glass it is inside out; give its faces the "
                        "other order of corners, counter-clockwise where they are looked at from outside"));
      }
    if (!pane_ || !has_lights_without_size(scene_) || !has_path_without_caustics(scene_)) return;
    diagnostics.warning(*pane_, std::string("suns, points and spots do not shine through what is flat and of solid "
                                            "glass; let the material of a pane be thin-walled, or give <path> "
                                            "<caustics>light</caustics>"));
  }

 private:
  Clear clear(const MaterialReference& material) const { return clearness(scene_, material); }

  void add(const ObjectLists& lists) {
    for_each_type(Objects{}, [&]<class T>(std::type_identity<T>) {
      if constexpr (!std::is_same_v<T, Mesh>)
        for (const auto& item : std::get<ObjectItems<T>>(lists)) count_ += clear(item.material) != Clear::not_solid;
    });
    for (const auto& box : std::get<ObjectItems<Box>>(lists))
      if (!pane_ && clear(box.material) == Clear::dark &&
          is_flat(box.parameters.max - box.parameters.min, box.transform.affine()))
        pane_ = location_of(box);
    std::vector<Solid>& solids = solids_.emplace_back();
    for (const auto& mesh : std::get<ObjectItems<Mesh>>(lists)) {
      const auto all_are = [&](const auto& good) {
        return std::ranges::all_of(mesh.materials, [&](const MaterialReference& one) { return good(clear(one)); });
      };
      if (mesh.data == nullptr || !mesh.data->copies.empty() || mesh.data->indices.empty()) continue;
      if (!all_are([](Clear one) { return one != Clear::not_solid; })) continue;
      ++count_;
      solids.push_back(solid_of(mesh));
      if (!pane_ && solids.back().is_flat && all_are([](Clear one) { return one == Clear::dark; }))
        pane_ = location_of(mesh);
    }
  }

  const SceneDescription& scene_;
  std::size_t count_ = 0;                   ///< of clear solids
  std::vector<std::vector<Solid>> solids_;  ///< those that are meshes, of the scene and of each group
  std::optional<SourceLocation> pane_;      ///< the first
};

}  // namespace

void check_solids(const SceneDescription& scene, Diagnostics& diagnostics) { SolidChecker(scene).report(diagnostics); }

}  // namespace raytrace
