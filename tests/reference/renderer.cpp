#include "renderer.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace reference {

namespace {

Vector times(Vector a, Vector b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

Real largest_component(Vector v) { return std::fmax(std::fabs(v.x), std::fmax(std::fabs(v.y), std::fabs(v.z))); }

/// Whether anything stands between a point of object `own` and the place `light_distance` (in multiples of direction)
/// away.
bool is_shadowed(const Scene& scene, std::size_t own, const Ray& ray, Real light_distance) {
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Shape& shape = *scene.objects[i].shape;
    const Crossings crossings = i == own ? crossings_leaving(shape, ray) : shape.crossings(ray);
    for (int k = 0; k < crossings.count; ++k) {
      const Real t = crossings.distances[static_cast<unsigned>(k)];
      if (t > 0 && t < light_distance) return true;
    }
  }
  return false;
}

/// The point of a lens of radius 1 that belongs to a point of the unit square: the square's halves, and its quarters
/// between the diagonals, become those of the disk; a polygon's sides take equal strips of it.
std::array<Real, 2> lens_point(int blades, Real rotation, Real u1, Real u2) {
  if (blades == 0) {
    const Real a = 2 * u1 - 1, b = 2 * u2 - 1;
    if (a == 0 && b == 0) return {0, 0};
    const bool wide = std::fabs(a) > std::fabs(b);
    const Real radius = wide ? a : b, angle = wide ? pi / 4 * b / a : pi / 2 - pi / 4 * a / b;
    return {radius * std::cos(angle), radius * std::sin(angle)};
  }
  const Real side = std::floor(u1 * blades), outwards = std::sqrt(u1 * blades - side);
  const auto corner = [&](Real number) {
    const Real angle = 2 * pi * number / blades + rotation / 180 * pi;
    return std::array<Real, 2>{std::cos(angle), std::sin(angle)};
  };
  const auto first = corner(side), second = corner(side + 1);
  return {outwards * ((1 - u2) * first[0] + u2 * second[0]), outwards * ((1 - u2) * first[1] + u2 * second[1])};
}

}  // namespace

namespace {

/// The nearest behind that distance, of all objects or of those that are visible to the camera.
std::optional<Hit> nearest_hit(const Scene& scene, const Ray& ray, Real begin, bool seen) {
  std::optional<Hit> nearest;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    if (seen && !scene.objects[i].visible) continue;
    const Crossings crossings = scene.objects[i].shape->crossings(ray);
    for (int k = 0; k < crossings.count; ++k) {
      const Real t = crossings.distances[static_cast<unsigned>(k)];
      if (t > begin && (!nearest || t < nearest->distance)) nearest = Hit{i, t};
    }
  }
  return nearest;
}

std::optional<Hit> seen_hit(const Scene& scene, const Ray& ray) {
  const Vector eye = scene.now ? scene.eye + *scene.now * scene.eye_way : scene.eye;
  const Real along_view = dot(ray.direction, unit(scene.look_at - eye));
  return nearest_hit(scene, ray, scene.near_clip > 0 ? scene.near_clip / along_view : 0, true);
}

}  // namespace

std::optional<Hit> nearest_hit(const Scene& scene, const Ray& ray) { return nearest_hit(scene, ray, 0, false); }

Crossings crossings_leaving(const Shape& shape, const Ray& ray) {
  const Crossings all = shape.crossings(ray);
  int own = -1;
  for (int k = 0; k < all.count; ++k) {
    const auto size = [&](int i) { return std::fabs(all.distances[static_cast<unsigned>(i)]); };
    if (own < 0 || size(k) < size(own)) own = k;
  }
  // The crossing at the origin is the one that is no farther than rounding may have moved it.
  const Real rounding = 1e-9L * (largest_component(ray.origin) + shape.largest_extent());
  Crossings result;
  result.clearance = all.clearance;
  for (int k = 0; k < all.count; ++k) {
    const Real t = all.distances[static_cast<unsigned>(k)];
    const bool is_origin = k == own && std::fabs(t) * length(ray.direction) < rounding;
    if (t > 0 && !is_origin) result.add(t);
  }
  return result;
}

bool has_ray(const Scene& scene, int column, int row, Real px, Real py) {
  if (scene.projection != Scene::Projection::fisheye) return true;
  return std::hypot(column - scene.hres / Real(2) + px, row - scene.vres / Real(2) + py) <=
         std::min(scene.hres, scene.vres) / Real(2);
}

namespace {

Ray camera_ray_from(const Scene& scene, Vector eye, int column, int row, Real px, Real py) {
  const Vector w = unit(eye - scene.look_at);
  const Vector u = unit(cross(scene.up, w));
  const Vector v = cross(w, u);
  const Real x = column - scene.hres / Real(2) + px, y = row - scene.vres / Real(2) + py;
  const Vector through = scene.pixel_size * x * u + scene.pixel_size * y * v - scene.view_distance * w;
  switch (scene.projection) {
    case Scene::Projection::thin_lens: {
      const auto [u1, u2] = scene.lens_sample(column, row);
      const auto [right, up] = lens_point(scene.blades, scene.blade_rotation, u1, u2);
      const Vector start = eye + scene.lens_radius * (right * u + up * v);
      return {start, eye + scene.focal_distance / scene.view_distance * through - start};
    }
    case Scene::Projection::fisheye: {
      const Real from_axis = scene.angle / 180 * pi * std::hypot(x, y) / std::min(scene.hres, scene.vres);
      const Real around = std::atan2(y, x);
      return {eye, std::sin(from_axis) * (std::cos(around) * u + std::sin(around) * v) - std::cos(from_axis) * w};
    }
    case Scene::Projection::spherical: {
      const Real longitude = 2 * pi * x / scene.hres, latitude = pi * y / scene.vres;
      const Vector level = std::sin(longitude) * u - std::cos(longitude) * w;
      return {eye, std::cos(latitude) * level + std::sin(latitude) * v};
    }
    case Scene::Projection::pinhole:
      break;
  }
  return {eye, through};
}

}  // namespace

Ray camera_ray(const Scene& scene, int column, int row, Real px, Real py) {
  if (!scene.now) return camera_ray_from(scene, scene.eye, column, row, px, py);
  const int before = *scene.now < 1 ? static_cast<int>(*scene.now * 16) : 15;
  const Real part = *scene.now * 16 - before;
  const auto at = [&](int moment) {
    return camera_ray_from(scene, scene.eye + Real(moment) / 16 * scene.eye_way, column, row, px, py);
  };
  const Ray a = at(before), b = at(before + 1);
  return {(1 - part) * a.origin + part * b.origin, (1 - part) * unit(a.direction) + part * unit(b.direction)};
}

Vector radiance(const Scene& scene, const Ray& ray) {
  const std::optional<Hit> hit = seen_hit(scene, ray);
  if (!hit) return scene.background;
  const Object& object = scene.objects[hit->object];
  const Material& material = scene.materials[object.material];
  const Vector point = ray.at(hit->distance);
  const Vector wo = unit(-ray.direction);
  Vector n = object.shape->normal(point);
  if (dot(n, wo) < 0) n = -n;

  Vector result;
  if (scene.has_ambient) result = material.ka * scene.ambient_scale * times(material.cd, scene.ambient_color);
  for (const Light& light : scene.lights) {
    const bool is_point = light.kind == Light::Kind::point;
    const Vector to_light = is_point ? light.place - point : light.place;
    const Vector wi = unit(to_light);
    const Real cosine = dot(n, wi);
    if (cosine <= 0) continue;
    const Real light_distance = is_point ? 1 : std::numeric_limits<Real>::infinity();
    if (light.shadows && is_shadowed(scene, hit->object, {point, to_light}, light_distance)) continue;
    Vector reflected = material.kd / pi * material.cd;
    const Real mirror = dot(2 * cosine * n - wi, wo);
    if (material.phong && mirror > 0)
      reflected = reflected + material.ks * std::pow(mirror, material.exponent) * material.cs;
    result = result + cosine * light.scale * times(reflected, light.color);
  }
  return result;
}

std::vector<Vector> render(const Scene& scene) {
  std::vector<Vector> picture;
  for (int row = scene.vres - 1; row >= 0; --row) {
    for (int column = 0; column < scene.hres; ++column) {
      if (scene.time) *scene.now = scene.time(column, row);
      const bool black = !has_ray(scene, column, row, 0.5L, 0.5L);
      picture.push_back(black ? Vector{} : radiance(scene, camera_ray(scene, column, row, 0.5L, 0.5L)));
    }
  }
  return picture;
}

Vector supersampled_pixel(const Scene& scene, int x, int y, int side) {
  Vector sum;
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const Real px = (i + 0.5L) / side, py = (j + 0.5L) / side;
      sum = sum + radiance(scene, camera_ray(scene, x, scene.vres - 1 - y, px, py));
    }
  }
  return 1 / (Real(side) * side) * sum;
}

}  // namespace reference
