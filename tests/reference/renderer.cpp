#include "renderer.h"

#include <algorithm>

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

}  // namespace

std::optional<Hit> nearest_hit(const Scene& scene, const Ray& ray) {
  std::optional<Hit> nearest;
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Crossings crossings = scene.objects[i].shape->crossings(ray);
    for (int k = 0; k < crossings.count; ++k) {
      const Real t = crossings.distances[static_cast<unsigned>(k)];
      if (t > 0 && (!nearest || t < nearest->distance)) nearest = Hit{i, t};
    }
  }
  return nearest;
}

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

Ray camera_ray(const Scene& scene, int column, int row, Real px, Real py) {
  const Vector w = unit(scene.eye - scene.look_at);
  const Vector u = unit(cross(scene.up, w));
  const Vector v = cross(w, u);
  const Real xv = scene.pixel_size * (column - scene.hres / Real(2) + px);
  const Real yv = scene.pixel_size * (row - scene.vres / Real(2) + py);
  return {scene.eye, xv * u + yv * v - scene.view_distance * w};
}

Vector radiance(const Scene& scene, const Ray& ray) {
  const std::optional<Hit> hit = nearest_hit(scene, ray);
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
      picture.push_back(radiance(scene, camera_ray(scene, column, row, 0.5L, 0.5L)));
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
