#include "raytrace/description/check_solids.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "raytrace/import/mesh_data.h"
#include "raytrace/math/bounds.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

bool is_clear_solid(const SceneDescription& scene, const MaterialReference& material) {
  bool result = false;
  for_each_type(Materials{}, [&]<class T>(std::type_identity<T>) {
    const auto& items = std::get<MaterialItems<T>>(scene.materials);
    if (material.type != index_of<T>(Materials{}) || material.index >= items.size()) return;
    if constexpr (requires { T::refracts(items[0].parameters); }) {
      const auto& parameters = items[material.index].parameters;
      result = T::refracts(parameters) && !(T::values(parameters).thin > 0);
    }
  });
  return result;
}

struct Solid {
  const ObjectItem<Mesh>* mesh;
  Bounds box;  ///< after its transform
  bool is_inside_out;
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
  Solid solid{&mesh, empty_bounds, false};
  const Affine affine = mesh.transform.affine();
  for (std::size_t i = 0; i < data.indices.size(); ++i) {
    const Vec3f p(affine.point(position(i) + data.origin));
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
  // A flat one, whose volume is rounding, has no inside.
  solid.is_inside_out = is_closed && volume < -1e-6 * std::pow(area_size, 1.5);
  return solid;
}

}  // namespace

void check_solids(const SceneDescription& scene, Diagnostics& diagnostics) {
  const auto add = [&](const ObjectLists& lists) {
    std::vector<Solid> solids;
    for (const auto& mesh : std::get<ObjectItems<Mesh>>(lists)) {
      if (mesh.data == nullptr || !mesh.data->copies.empty() || mesh.data->indices.empty()) continue;
      const auto clear = [&](const MaterialReference& material) { return is_clear_solid(scene, material); };
      if (std::ranges::all_of(mesh.materials, clear)) solids.push_back(solid_of(mesh));
    }
    for (const Solid& solid : solids) {
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
}

}  // namespace raytrace
