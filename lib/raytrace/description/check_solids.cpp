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

enum class Clear { not_solid, smooth, rough };

Clear clearness(const SceneDescription& scene, const MaterialReference& material) {
  Clear result = Clear::not_solid;
  for_each_type(Materials{}, [&]<class T>(std::type_identity<T>) {
    const auto& items = std::get<MaterialItems<T>>(scene.materials);
    if (material.type != index_of<T>(Materials{}) || material.index >= items.size()) return;
    if constexpr (requires { T::refracts(items[0].parameters); }) {
      const auto& parameters = items[material.index].parameters;
      if (!T::refracts(parameters) || T::values(parameters).thin > 0) return;
      const bool is_smooth = T::focuses(parameters, [](std::string_view) { return false; });
      result = is_smooth ? Clear::smooth : Clear::rough;
    }
  });
  return result;
}

struct Solid {
  const ObjectItem<Mesh>* mesh;
  Bounds box;  ///< after its transform
  bool is_flat = false, is_inside_out = false;
};

/// By the size of its box.
bool is_flat(const Vec3d& size) {
  std::array sizes{size.x, size.y, size.z};
  std::ranges::sort(sizes);
  return sizes[0] < 0.1 * sizes[1];
}

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
  solid.is_flat = is_flat(Vec3d(own_box.upper) - Vec3d(own_box.lower));
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

}  // namespace

void check_solids(const SceneDescription& scene, Diagnostics& diagnostics) {
  std::optional<SourceLocation> pane;  // the first
  const auto add = [&](const ObjectLists& lists) {
    const auto is_clear = [&](const MaterialReference& material) {
      return clearness(scene, material) != Clear::not_solid;
    };
    // Light that is drawn behind rough ones comes through.
    const auto is_smooth = [&](const MaterialReference& material) {
      return clearness(scene, material) == Clear::smooth;
    };
    for (const auto& box : std::get<ObjectItems<Box>>(lists))
      if (!pane && is_flat(box.parameters.max - box.parameters.min) && is_smooth(box.material)) pane = location_of(box);
    std::vector<Solid> solids;
    for (const auto& mesh : std::get<ObjectItems<Mesh>>(lists)) {
      if (mesh.data == nullptr || !mesh.data->copies.empty() || mesh.data->indices.empty()) continue;
      if (std::ranges::all_of(mesh.materials, is_clear)) solids.push_back(solid_of(mesh));
    }
    for (const Solid& solid : solids) {
      if (!pane && solid.is_flat && std::ranges::all_of(solid.mesh->materials, is_smooth))
        pane = location_of(*solid.mesh);
      if (!solid.is_inside_out) continue;
      const auto is_around = [&](const Solid& other) { return &other != &solid && is_within(solid.box, other.box); };
      if (std::ranges::any_of(solids, is_around)) continue;
      const std::string message =
          "the fronts of the mesh's faces are inside: as glass it is inside out; give its faces the other order of "
          "corners, counter-clockwise where they are looked at from outside";
      diagnostics.warning(location_of(*solid.mesh), message);
    }
  };
  add(scene.objects);
  for (const Group& group : scene.groups) add(group.objects);
  if (!pane || !has_lights_without_size(scene) || !has_path_without_caustics(scene)) return;
  const std::string message =
      "suns, points and spots do not shine through a pane that is solid: let its material be thin-walled, or give "
      "<path> <caustics>light</caustics>";
  diagnostics.warning(*pane, message);
}

}  // namespace raytrace
