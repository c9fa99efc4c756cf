#include "raytrace/scene/patch_geometry.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace raytrace {

namespace {

/// From the unit sphere.
Affine ellipsoid_map(const LightPatch& patch) {
  const Vec3d &a = patch.a, &b = patch.b;
  return {{a.x, b.z, b.y}, {b.z, a.y, b.x}, {b.y, b.x, a.z}, patch.origin};
}

/// How large the hole is.
double hole_of(const LightPatch& ellipse) { return dot(ellipse.a, ellipse.b) / dot(ellipse.a, ellipse.a); }

/// A disk or an annulus becomes an ellipse.
std::optional<LightPatch> stretched_ring(const LightPatch& ring, const Affine& affine) {
  const double first = ring.b.x, last = ring.b.y, radius = std::max(first, last);
  const Vec3d across = normalize(cross(ring.a, std::abs(ring.a.x) < 0.5 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0)));
  // Two radii that were at right angles, turned so far that they are so again.
  const Vec3d x = affine.vector(across) * radius, y = affine.vector(cross(ring.a, across)) * radius;
  const double turn = 0.5 * std::atan2(2 * dot(x, y), dot(x, x) - dot(y, y));
  const double sine = std::sin(turn), cosine = std::cos(turn);
  const Vec3d a = x * cosine + y * sine;
  Vec3d b = y * cosine - x * sine;
  constexpr double least = 1e-4;  // of what is added to the size of a hole, for what floats make of the sum
  if (std::min(first, last) > 0 && !(length(b) >= least * length(a))) return std::nullopt;
  if (dot(cross(a, b), affine.vector(ring.a)) * (first - last) < 0) b = -b;  // its front stays
  return LightPatch{PatchShape::ellipse, affine.point(ring.origin), a, b + a * (std::min(first, last) / radius)};
}

std::optional<LightPatch> stretched_sphere(const LightPatch& sphere, const Affine& affine) {
  const double size = length(affine.x) + length(affine.y) + length(affine.z), scale = 1 / size;
  const Affine map{affine.x * scale, affine.y * scale, affine.z * scale};
  constexpr double least = 6e-5;  // of the determinant, for what floats make of it
  if (!(std::abs(map.determinant()) >= least)) return std::nullopt;
  // A turn that leaves the sphere as it is, and then the symmetric map: the polar decomposition (Higham, "Computing the
  // Polar Decomposition", 1986).
  Affine turn = map;
  for (int i = 0; i < 40; ++i) {
    const double half = 0.5 / turn.determinant();
    turn = {turn.x * 0.5 + cross(turn.y, turn.z) * half, turn.y * 0.5 + cross(turn.z, turn.x) * half,
            turn.z * 0.5 + cross(turn.x, turn.y) * half};
  }
  const auto element = [&](double Vec3d::* row, double Vec3d::* column) {
    return sphere.a.x * size *
           (map.x.*row * turn.x.*column + map.y.*row * turn.y.*column + map.z.*row * turn.z.*column);
  };
  constexpr auto x = &Vec3d::x, y = &Vec3d::y, z = &Vec3d::z;
  return LightPatch{PatchShape::ellipsoid,
                    affine.point(sphere.origin),
                    {element(x, x), element(y, y), element(z, z)},
                    {element(y, z), element(z, x), element(x, y)}};
}

}  // namespace

bool is_flat(const LightPatch& patch) {
  return patch.shape == PatchShape::parallelogram || patch.shape == PatchShape::triangle;
}

std::optional<LightPatch> transformed(const LightPatch& patch, const Affine& affine, double scale) {
  if (is_flat(patch)) {
    LightPatch result{patch.shape, affine.point(patch.origin), affine.vector(patch.a), affine.vector(patch.b)};
    if (affine.determinant() < 0) std::swap(result.a, result.b);  // its front stays
    return result;
  }
  if (scale == 0) {
    if (patch.shape == PatchShape::sphere) return stretched_sphere(patch, affine);
    if (patch.shape == PatchShape::band && patch.b.z == 0) return stretched_ring(patch, affine);
    return std::nullopt;
  }
  const Vec3d origin = affine.point(patch.origin);
  if (patch.shape == PatchShape::sphere) return LightPatch{patch.shape, origin, patch.a * scale, patch.b};
  return LightPatch{patch.shape, origin, normalize(affine.vector(patch.a)), patch.b * scale};
}

double area_of(const LightPatch& patch) {
  constexpr double pi = std::numbers::pi;
  const Vec3d& sizes = patch.b;
  switch (patch.shape) {
    case PatchShape::parallelogram:
      return length(cross(patch.a, patch.b));
    case PatchShape::triangle:
      return length(cross(patch.a, patch.b)) / 2;
    case PatchShape::sphere:
      return 4 * pi * patch.a.x * patch.a.x;
    case PatchShape::band:
      return pi * (sizes.x + sizes.y) * std::hypot(sizes.y - sizes.x, sizes.z);
    case PatchShape::torus:
      return 4 * pi * pi * sizes.x * sizes.y;
    case PatchShape::ellipsoid: {
      // A root mean square in place of the mean, over the unit sphere, of how much areas grow.
      const Affine map = ellipsoid_map(patch);
      const Vec3d x = cross(map.y, map.z), y = cross(map.z, map.x), z = cross(map.x, map.y);
      return 4 * pi * std::sqrt((dot(x, x) + dot(y, y) + dot(z, z)) / 3);
    }
    case PatchShape::ellipse: {
      const double hole = hole_of(patch);
      return pi * (1 - hole * hole) * length(cross(patch.a, patch.b));
    }
  }
  return 0;
}

Bounds box_of(const LightPatch& patch) {
  const auto around = [](const Vec3d& center, double reach) { return bounds_around(center, {reach, reach, reach}); };
  const Vec3d &a = patch.a, &b = patch.b;
  if (patch.shape == PatchShape::sphere) return around(patch.origin, a.x);
  if (patch.shape == PatchShape::ellipsoid) {
    const Affine map = ellipsoid_map(patch);
    return bounds_around(patch.origin, {length(map.x), length(map.y), length(map.z)});
  }
  if (patch.shape == PatchShape::ellipse) {
    const Vec3d other = b - a * hole_of(patch);
    return bounds_around(patch.origin, {std::hypot(a.x, other.x), std::hypot(a.y, other.y), std::hypot(a.z, other.z)});
  }
  if (patch.shape == PatchShape::torus) return around(patch.origin, b.x + b.y);
  const auto ring = [&](double height, double radius) {
    const auto reach = [&](double axis_i) { return radius * std::sqrt(std::max(0.0, 1 - axis_i * axis_i)); };
    return bounds_around(patch.origin + a * height, {reach(a.x), reach(a.y), reach(a.z)});
  };
  if (patch.shape == PatchShape::band) return join(ring(0, b.x), ring(b.z, b.y));
  const Bounds three = join(join(around(patch.origin, 0), around(patch.origin + a, 0)), around(patch.origin + b, 0));
  return patch.shape == PatchShape::triangle ? three : join(three, around(patch.origin + a + b, 0));
}

}  // namespace raytrace
