#include "raytrace/scene/patch_emission.h"

#include <cmath>
#include <cstddef>
#include <optional>

#include "raytrace/scene/instance_table.h"
#include "raytrace/scene/patch_geometry.h"

namespace raytrace {

namespace {

/// The normal of all of the patch, if it has one; its length means nothing.
std::optional<Vec3d> axis_of(const LightPatch& patch) {
  if (is_flat(patch) || patch.shape == PatchShape::ellipse) return cross(patch.a, patch.b);
  if (patch.shape == PatchShape::band && patch.b.z == 0) return patch.a * (patch.b.x - patch.b.y);
  return std::nullopt;
}

/// The columns of what turns normals (Affine::normal()), which are products of two of the map's columns.
struct MapOfNormals {
  Vec3d x, y, z;

  Vec3d operator()(const Vec3d& n) const { return x * n.x + y * n.y + z * n.z; }
};

MapOfNormals map_of_normals(const Affine& a, const Affine& b) {
  return {cross(a.y, b.z), cross(a.z, b.x), cross(a.x, b.y)};
}

}  // namespace

LightEmission emission_of(const LightPatch& patch, float radiance, bool two_sided) {
  LightEmission emission{box_of(patch)};
  emission.power = static_cast<float>(area_of(patch) * static_cast<double>(radiance));
  const std::optional<Vec3d> axis = axis_of(patch);
  if (axis && length(*axis) > 0 && !two_sided) {
    emission.axis = Vec3f(normalize(*axis));
  } else {
    emission.cosine = -1;
  }
  if (two_sided) emission.power *= 2;
  return emission;
}

double area_under(const LightPatch& patch, const Affine& affine) {
  if (is_flat(patch)) return area_of(*transformed(patch, affine, 0));
  const double scale = std::cbrt(std::abs(affine.determinant()));
  return area_of(patch) * scale * scale;
}

LightEmission emission_of(const LightPatch& patch, std::span<const Affine> moments, float radiance, bool two_sided) {
  const Bounds box = box_of(patch);
  const std::optional<Vec3d> axis = two_sided ? std::nullopt : axis_of(patch);
  LightEmission all;
  const auto add = [&](const Bounds& here, const Vec3d& normal) {
    LightEmission one{here};
    if (length(normal) > 0)
      one.axis = Vec3f(normalize(normal));
    else
      one.cosine = -1;
    all = join(all, one);
  };
  double area = 0;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const Affine& map = moments[i];
    // All points move straight between two moments: they stay in the box around both.
    const Bounds here = is_flat(patch) ? box_of(*transformed(patch, map, 0)) : transformed_bounds(map, box);
    const double side = map.determinant() < 0 ? -1 : 1;
    area += area_under(patch, map) / static_cast<double>(moments.size());
    add(here, axis ? map_of_normals(map, map)(*axis) * side : Vec3d(0, 0, 0));
    if (!axis || i == 0) continue;
    // The normal goes from one to the other as a Bezier curve of degree 2 does, whose middle control point this is.
    const Affine& before = moments[i - 1];
    add(here, (map_of_normals(before, map)(*axis) + map_of_normals(map, before)(*axis)) * side);
  }
  // What is between them is in a cone around them, if that is no wider than a half space.
  if (all.cosine <= 0) all.cosine = -1;
  all.power = static_cast<float>(area * static_cast<double>(radiance) * (two_sided ? 2 : 1));
  return all;
}

}  // namespace raytrace
